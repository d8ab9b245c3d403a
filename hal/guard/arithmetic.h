// SPDX-License-Identifier: Apache-2.0
// Vectors, times and modes as the guard computes them.
// Promise: computed in double, where the square of any finite float stays finite; only + - * / and
// sqrt, so the results are the same bits everywhere; no allocation. Units: SI, clock times in ns.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hal/guard/guard.h"

namespace stylet::hal::guarding {

inline double widened(float value) {
  return static_cast<double>(value);
}

// A value that follows another with time constant `slow_s` covers this fraction of the gap in
// `step_s`.
inline double gain_of(double step_s, double slow_s) {
  return step_s / (step_s + slow_s);
}

inline std::int64_t in_ns(float time_s) {
  return std::llround(widened(time_s) * 1e9);
}

// True if the time is over, or will be before the next tick: a limit in seconds is not passed by a
// tick.
inline bool is_over(const GuardConfig& config, std::int64_t passed_ns, float time_s) {
  return passed_ns + in_ns(config.period_s) > in_ns(time_s);
}

// Ticks may be lost: the next one then covers all the time that has passed, at most kMaxStepNs.
// While the clock stands still or runs backwards, no time passes.
inline void note_time(const GuardConfig& config, GuardState& state, std::int64_t now_ns) {
  const bool runs = now_ns > state.now_ns;
  // Unsigned, so that the difference of any two times does not overflow.
  const std::uint64_t passed_ns =
      static_cast<std::uint64_t>(now_ns) - static_cast<std::uint64_t>(state.now_ns);
  const std::int64_t first_ns = in_ns(config.period_s);
  const auto most_ns = static_cast<std::uint64_t>(std::max(first_ns, kMaxStepNs));
  state.step_ns = state.have_time == 0 ? first_ns
                  : runs               ? static_cast<std::int64_t>(std::min(passed_ns, most_ns))
                                       : 0;
  state.have_time = 1;
  state.now_ns = now_ns;
}

// The time that the present tick covers.
inline double step_s(const GuardConfig& config, const GuardState& state) {
  const bool one_period = state.step_ns == in_ns(config.period_s);
  return one_period ? widened(config.period_s) : static_cast<double>(state.step_ns) * 1e-9;
}

// The same for what has to go on even while the clock stands still: then it is one period.
inline std::int64_t forced_step_ns(const GuardConfig& config, const GuardState& state) {
  return state.step_ns > 0 ? state.step_ns : in_ns(config.period_s);
}

// Time since the last usable sample, this tick included.
inline double since_last_s(const GuardConfig& config, const GuardState& state) {
  return step_s(config, state) + static_cast<double>(state.blind_ns) * 1e-9;
}

inline bool is_latched(GuardMode mode) {
  return mode == GuardMode::kFading || mode == GuardMode::kFault;
}

inline bool is_armed(GuardMode mode) {
  return mode == GuardMode::kRamp || mode == GuardMode::kLive;
}

}  // namespace stylet::hal::guarding
