// SPDX-License-Identifier: Apache-2.0
// Counts the instructions of some ticks of random sessions, among them the one that may cost most.
// It is run twice with the same arguments. The first time, by itself, it plays the sessions and
// saves the state before each of those ticks. The second time, under callgrind, it starts from
// those states and leaves a dump of costs for each tick, with what the tick may cost by
// tick_work.h. costs.py here does both.
//
// usage: stylet_session_costs FOLDER SEED COUNT
#include <valgrind/callgrind.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "simulator.h"
#include "state/attachment.h"
#include "tick_work.h"

namespace stylet::test {
namespace {

constexpr std::uint64_t kSamples = 10;  // of a session, and ticks around the dearest

// A session's file: for each tick the snapshot before it and the inputs of all needles.
struct Saved {
  std::vector<std::byte> state;
  std::array<Input, kMaxNeedles> inputs;

  explicit Saved(const Kernel& kernel) : state(snapshot_bytes(kernel)), inputs{} {}
};

std::string path_of(const std::string& folder, std::uint64_t seed) {
  return folder + "/" + std::to_string(seed) + ".ticks";
}

void save_ticks(const std::string& folder, std::uint64_t seed) {
  const Scenario scenario = draw_scenario(seed);
  const Verdict v = simulate(scenario);
  const std::uint64_t every = v.ticks / kSamples + 1;
  std::ofstream file(path_of(folder, seed), std::ios::binary);
  const auto write = [&](const void* bytes, std::size_t size) {
    file.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  };
  const Meter meter = {[&](std::uint64_t tick) {
                         return tick % every == 0 ||
                                (tick + 1 >= v.dearest_tick && tick <= v.dearest_tick + 1);
                       },
                       [&](Kernel& before, std::span<const Input> inputs) {
                         Saved saved(before);
                         if (snapshot(before, saved.state) != Status::kOk) std::abort();
                         std::copy(inputs.begin(), inputs.end(), saved.inputs.begin());
                         write(saved.state.data(), saved.state.size());
                         write(saved.inputs.data(), sizeof saved.inputs);
                       }};
  (void)simulate(scenario, {}, meter);
  if (!file.flush()) std::abort();
}

void count_tick(Kernel& kernel, std::span<const Input> inputs, std::uint64_t seed) {
  std::array<Output, kMaxNeedles> outputs;
  TickWork work;
  count_work(kernel, {}, work);  // the particles there are before
  CALLGRIND_ZERO_STATS;
  CALLGRIND_TOGGLE_COLLECT;
  tick(kernel, inputs, std::span(outputs).first(inputs.size()));
  CALLGRIND_TOGGLE_COLLECT;
  const View view = view_of(kernel);
  count_work(kernel, attachment_shift(view.model, view.state), work);
  char text[80];
  std::snprintf(text, sizeof text, "%llu seed%llu %llu",
                static_cast<unsigned long long>(outputs[0].tick),
                static_cast<unsigned long long>(seed),
                static_cast<unsigned long long>(bound_of(work.amount)));
  CALLGRIND_DUMP_STATS_AT(text);
}

void count_ticks(const std::string& folder, std::uint64_t seed) {
  const Scenario scenario = draw_scenario(seed);
  Session session = session_of(scenario);
  Saved saved(session.kernel);
  std::ifstream file(path_of(folder, seed), std::ios::binary);
  const auto read = [&](void* bytes, std::size_t size) {
    return !!file.read(static_cast<char*>(bytes), static_cast<std::streamsize>(size));
  };
  while (read(saved.state.data(), saved.state.size()) &&
         read(saved.inputs.data(), sizeof saved.inputs)) {
    if (restore(session.kernel, saved.state) != Status::kOk) std::abort();
    count_tick(session.kernel, std::span(saved.inputs).first(scenario.hands.size()), seed);
  }
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: stylet_session_costs FOLDER SEED COUNT\n", stderr);
    return 2;
  }
  const std::uint64_t first = std::strtoull(argv[2], nullptr, 10);
  const std::uint64_t count = std::strtoull(argv[3], nullptr, 10);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    if (RUNNING_ON_VALGRIND == 0) {
      stylet::test::save_ticks(argv[1], seed);
    } else {
      stylet::test::count_ticks(argv[1], seed);
    }
  }
  return 0;
}
