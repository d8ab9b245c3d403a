// SPDX-License-Identifier: Apache-2.0
// Vectors and times as the guard computes them.
// Promise: computed in double, where the square of any finite float stays finite; only + - * / and
// sqrt, so the results are the same bits everywhere; no allocation. Units: SI, clock times in ns.
#pragma once

#include <cmath>
#include <cstdint>

#include "hal/guard/guard.h"

namespace stylet::hal::guarding {

inline double of(float value) {
  return static_cast<double>(value);
}

// Part of its way that a value following another with time constant `slow_s` goes in `step_s`.
inline double share_of(double step_s, double slow_s) {
  return step_s / (step_s + slow_s);
}

inline std::int64_t in_ns(float time_s) {
  return std::llround(of(time_s) * 1e9);
}

// The time that the present tick covers.
inline double step_s(const GuardConfig& config, const GuardState& state) {
  const bool one_period = state.step_ns == 0 || state.step_ns == in_ns(config.period_s);
  return one_period ? of(config.period_s) : static_cast<double>(state.step_ns) * 1e-9;
}

// Time since the last usable sample, this tick included.
inline double since_last_s(const GuardConfig& config, const GuardState& state) {
  return step_s(config, state) + static_cast<double>(state.blind_ns) * 1e-9;
}

}  // namespace stylet::hal::guarding
