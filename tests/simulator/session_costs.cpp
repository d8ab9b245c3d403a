// SPDX-License-Identifier: Apache-2.0
// Random sessions under callgrind: leaves a dump of costs for some ticks of each, the one that may
// cost most among them, with what tick_work.h says the tick may cost. costs.py here reads them.
//
// usage: stylet_session_costs SEED COUNT
#include <valgrind/callgrind.h>

#include <cstdio>
#include <cstdlib>

#include "needle.h"
#include "simulator.h"
#include "tick_work.h"

namespace stylet::test {
namespace {

constexpr std::uint64_t kSamples = 10;  // of a session, evenly, and ticks around the dearest

void count_tick(Kernel& kernel, std::span<const Input> inputs, std::uint64_t seed) {
  std::array<Output, kMaxNeedles> outputs;
  TickWork work;
  count_work(kernel, {}, work);  // the particles there are before
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  CALLGRIND_TOGGLE_COLLECT;
  tick(kernel, inputs, std::span(outputs).first(inputs.size()));
  CALLGRIND_TOGGLE_COLLECT;
  CALLGRIND_STOP_INSTRUMENTATION;
  count_work(kernel, attachment_shift(view_of(kernel)), work);
  char text[80];
  std::snprintf(text, sizeof text, "%llu seed%llu %llu",
                static_cast<unsigned long long>(outputs[0].tick),
                static_cast<unsigned long long>(seed),
                static_cast<unsigned long long>(bound_of(work.amount)));
  CALLGRIND_DUMP_STATS_AT(text);
}

void count_session(std::uint64_t seed) {
  const Scenario scenario = draw_scenario(seed);
  const Verdict v = simulate(scenario);
  const std::uint64_t every = v.ticks / kSamples + 1;
  const Meter meter = {
      [&](std::uint64_t tick) {
        return tick % every == 0 || (tick + 1 >= v.dearest_tick && tick <= v.dearest_tick + 1);
      },
      [&](Kernel& before, std::span<const Input> inputs) { count_tick(before, inputs, seed); }};
  (void)simulate(scenario, {}, meter);
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: stylet_session_costs SEED COUNT\n", stderr);
    return 2;
  }
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10);
  const std::uint64_t count = std::strtoull(argv[2], nullptr, 10);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    stylet::test::count_session(seed);
  }
  return 0;
}
