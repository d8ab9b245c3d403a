// SPDX-License-Identifier: Apache-2.0
// Batches of the C interface: each simulation gives, bit for bit, what it gives alone, with any
// number of threads, and in a process that was forked.
#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

#include "c_support.h"

namespace stylet::test {
namespace {

TEST(CBatch, GivesWhatEachSimulationGivesAlone) {
  Draw draw(8);
  for (const std::uint32_t threads : {0U, 1U, 2U, 5U}) {
    const auto opened = block_organ(4, 3, 4);
    const OrganHandle organ = c_organ(*opened);
    std::vector<SimulationHandle> together, alone;
    std::vector<stylet_simulation*> all;
    std::vector<stylet_input> inputs;
    std::uint32_t needles = 0;
    constexpr std::uint32_t kTicks = 150;
    for (int i = 0; i < 5; ++i) {
      const DrawnConfig config = drawn_config(draw);
      together.push_back(c_simulation(organ.get(), config));
      alone.push_back(c_simulation(organ.get(), config));
      all.push_back(together.back().get());
      needles += config.cpp.needle_count;
      const std::size_t first = inputs.size();
      for (std::uint64_t t = 0; t < kTicks; ++t) {
        for (const Input& each : inputs_at(opened->organ, config.cpp, 500 + t)) {
          inputs.push_back(test::to_c(each));
        }
      }
      ASSERT_EQ(stylet_simulation_run(alone.back().get(), &inputs[first], nullptr, kTicks),
                STYLET_OK);
    }
    stylet_batch* made = nullptr;
    ASSERT_EQ(stylet_batch_create(all.data(), 5, threads, &made), STYLET_OK);
    const BatchHandle batch(made);
    EXPECT_EQ(stylet_batch_needles(made), needles);
    std::vector<stylet_output> outputs(inputs.size());
    outputs[0].struct_bytes = sizeof outputs[0];
    ASSERT_EQ(stylet_batch_run(made, inputs.data(), outputs.data(), kTicks), STYLET_OK);
    EXPECT_EQ(outputs.back().tick, kTicks);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(stylet_simulation_hash(together[i].get()), stylet_simulation_hash(alone[i].get()));
    }
    together.clear();  // the batch keeps the simulations
    ASSERT_EQ(stylet_batch_run(made, inputs.data(), nullptr, kTicks), STYLET_OK);
  }
}

// Calls are so short that threads come too late for one and meet the next.
TEST(CBatch, CallsOfOneTickAreThoseOfOneLongCall) {
  const auto opened = block_organ(3, 3, 3);
  const OrganHandle organ = c_organ(*opened);
  Draw draw(12);
  const DrawnConfig config = drawn_config(draw);
  std::vector<stylet_input> inputs;
  constexpr std::uint32_t kTicks = 600;
  for (std::uint64_t t = 0; t < kTicks; ++t) {
    for (const Input& each : inputs_at(opened->organ, config.cpp, t)) {
      inputs.push_back(test::to_c(each));
    }
  }
  const SimulationHandle alone = c_simulation(organ.get(), config);
  ASSERT_EQ(stylet_simulation_run(alone.get(), inputs.data(), nullptr, kTicks), STYLET_OK);
  constexpr std::size_t kSimulations = 3;
  std::vector<SimulationHandle> owned;
  std::vector<stylet_simulation*> all;
  for (std::size_t i = 0; i < kSimulations; ++i) {
    owned.push_back(c_simulation(organ.get(), config));
    all.push_back(owned.back().get());
  }
  stylet_batch* made = nullptr;
  ASSERT_EQ(stylet_batch_create(all.data(), kSimulations, 0, &made), STYLET_OK);
  const BatchHandle batch(made);
  const std::size_t needles = config.cpp.needle_count;
  std::vector<stylet_input> given(kSimulations * needles);
  std::vector<stylet_output> outputs(given.size());
  for (std::uint32_t t = 0; t < kTicks; ++t) {
    for (std::size_t i = 0; i < given.size(); ++i) given[i] = inputs[t * needles + i % needles];
    outputs[0].struct_bytes = sizeof outputs[0];
    ASSERT_EQ(stylet_batch_run(made, given.data(), outputs.data(), 1), STYLET_OK);
    for (const stylet_output& each : outputs) ASSERT_EQ(each.tick, t + 1);  // all are done
  }
  for (const stylet_simulation* each : all) {
    EXPECT_EQ(stylet_simulation_hash(each), stylet_simulation_hash(alone.get()));
  }
}

#if !defined(_WIN32) && !defined(__SANITIZE_THREAD__)  // it allows no threads after a fork
TEST(CBatch, GoesOnInAForkedProcess) {
  const auto opened = block_organ(4, 3, 4);
  const OrganHandle organ = c_organ(*opened);
  Draw draw(11);
  const DrawnConfig config = drawn_config(draw);
  std::vector<SimulationHandle> owned;
  std::vector<stylet_simulation*> all;
  std::vector<stylet_input> inputs;
  constexpr std::uint32_t kTicks = 100;
  for (int i = 0; i < 4; ++i) {
    owned.push_back(c_simulation(organ.get(), config));
    all.push_back(owned.back().get());
    for (std::uint64_t t = 0; t < kTicks; ++t) {
      for (const Input& each : inputs_at(opened->organ, config.cpp, 500 + t)) {
        inputs.push_back(test::to_c(each));
      }
    }
  }
  const SimulationHandle alone = c_simulation(organ.get(), config);
  ASSERT_EQ(stylet_simulation_run(alone.get(), inputs.data(), nullptr, kTicks), STYLET_OK);
  const std::uint64_t expected = stylet_simulation_hash(alone.get());
  stylet_batch* made = nullptr;
  ASSERT_EQ(stylet_batch_create(all.data(), 4, 3, &made), STYLET_OK);
  BatchHandle batch(made);
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);  // otherwise it would wait for ever for threads that do not exist
    bool same = stylet_batch_run(made, inputs.data(), nullptr, kTicks) == STYLET_OK;
    for (const stylet_simulation* each : all) same &= stylet_simulation_hash(each) == expected;
    batch.reset();
    _exit(same ? 0 : 1);
  }
  int ended = -1;
  ASSERT_EQ(waitpid(child, &ended, 0), child);
  EXPECT_EQ(ended, 0);
  ASSERT_EQ(stylet_batch_run(made, inputs.data(), nullptr, kTicks), STYLET_OK);
  for (const stylet_simulation* each : all) EXPECT_EQ(stylet_simulation_hash(each), expected);
}
#endif

TEST(CBatch, OfNoSimulationRuns) {
  stylet_batch* made = nullptr;
  ASSERT_EQ(stylet_batch_create(nullptr, 0, 2, &made), STYLET_OK);
  const BatchHandle batch(made);
  EXPECT_EQ(stylet_batch_run(made, nullptr, nullptr, 5), STYLET_OK);
}

TEST(CBatch, RefusesTheSameSimulationTwice) {
  const auto opened = block_organ(3, 3, 3);
  const OrganHandle organ = c_organ(*opened);
  Draw draw(9);
  const SimulationHandle one = c_simulation(organ.get(), drawn_config(draw));
  stylet_simulation* const twice[] = {one.get(), one.get()};
  stylet_batch* made = nullptr;
  EXPECT_EQ(stylet_batch_create(twice, 2, 1, &made), STYLET_ARGUMENT_OUT_OF_RANGE);
  EXPECT_EQ(made, nullptr);
}

}  // namespace
}  // namespace stylet::test
