// SPDX-License-Identifier: Apache-2.0
// Helper threads beside the loop: the same bits, in virtual and in real time; and they sleep
// between ticks.
#include "hal/loop/helpers.h"

#include <gtest/gtest.h>
#include <time.h>

#include <chrono>
#include <thread>

#include "rig.h"

namespace stylet::hal {
namespace {

constexpr std::uint64_t kTicks = 250;  // contact, puncture, insertion

struct Ran {
  std::uint64_t hash = 0, parts = 0;
  HostReport report;
};

Ran run_with(std::uint32_t count, bool real_time) {
  Rig rig;
  rig.config.ticks = kTicks;
  HelperConfig config = {count, real_time, {}, 40};
  for (std::uint32_t i = 0; i < count; ++i) config.cpus.push_back(loop_processors(-1).back());
  Device device = rig.device();
  device.write = [](void*, const Command&) {};  // faults of a busy machine do not matter here
  Ran ran;
  {
    std::unique_ptr<Helpers> helpers;
    if (count > 0) {
      helpers = std::make_unique<Helpers>(rig.instance->kernel, config, rig.state, ran.report);
      EXPECT_TRUE(has_team(rig.instance->kernel));
    }
    run_loop(rig.config, rig.instance->kernel, std::span(&device, 1),
             real_time ? monotonic_clock() : virtual_clock(rig.time), {&rig.records}, rig.state);
    if (helpers != nullptr) ran.parts = helpers->parts();
  }
  EXPECT_FALSE(has_team(rig.instance->kernel));
  EXPECT_EQ(rig.state.ticks, kTicks);
  ran.hash = hash(rig.instance->kernel);
  return ran;
}

TEST(Helpers, GiveTheSameBitsInVirtualTime) {
  const Ran alone = run_with(0, false);
  for (const std::uint32_t count : {1U, 2U, 5U}) {
    const Ran helped = run_with(count, false);
    EXPECT_EQ(helped.hash, alone.hash) << count << " helpers";
    EXPECT_TRUE(helped.report.lacks.empty()) << "virtual time asks for no rights";
  }
}

TEST(Helpers, GiveTheSameBitsInRealTime) {
  if (loop_processors(-1).size() < 2) GTEST_SKIP() << "one processor";
  EXPECT_EQ(run_with(1, true).hash, run_with(0, false).hash);
}

TEST(Helpers, DoPartsOfTheStep) {
  Rig rig;
  HostReport report;
  Helpers helpers(rig.instance->kernel, {2, false, {}, 0}, rig.state, report);
  Input input = {{{}, {1, 0, 0, 0}}, 1};
  for (int i = 0; i < 100'000 && helpers.parts() == 0; ++i) tick(rig.instance->kernel, input);
  EXPECT_GT(helpers.parts(), 0U);
}

double cpu_seconds() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

TEST(Helpers, SleepUntilTheNextTick) {
  Rig rig;
  HostReport report;
  rig.state.next_ns = monotonic_now_ns() + 10'000'000'000;
  const std::vector<int> cpus = {loop_processors(-1).back(), loop_processors(-1).back()};
  const Helpers helpers(rig.instance->kernel, {2, true, cpus, 40}, rig.state, report);
  const double before = cpu_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_LT(cpu_seconds() - before, 0.1) << "of 0.6 s that two threads could have had";
}

TEST(Helpers, MoreThanTheKernelAcceptsAreRefused) {
  Rig rig;
  HostReport report;
  EXPECT_THROW(Helpers(rig.instance->kernel, {kMaxHelpers + 1, false, {}, 0}, rig.state, report),
               std::invalid_argument);
}

// Helpers wait for each other in real time, so each has a processor of its own.
TEST(Helpers, ProcessorsAreNamedOnceTheWantedOneFirst) {
  const std::vector<int> all = loop_processors(-1), wanted = loop_processors(all.back());
  ASSERT_EQ(all.size(), wanted.size());
  EXPECT_EQ(wanted.front(), all.back());
  for (const int each : all) EXPECT_EQ(std::count(wanted.begin(), wanted.end(), each), 1) << each;
}

}  // namespace
}  // namespace stylet::hal
