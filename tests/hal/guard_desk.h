// SPDX-License-Identifier: Apache-2.0
// A guard and its clock, with a device that answers; shared by the tests of the guard.
#pragma once

#include <cmath>
#include <cstdint>

#include "hal/guard/guard.h"
#include "vectors.h"

namespace stylet::hal {

constexpr std::uint32_t kButton = 3, kAcknowledgeButton = 5;

using test::minus;
using test::size;

// With a dead man's button, and a slew limit that lets 2 N through in a tick.
inline GuardConfig with_button() {
  GuardConfig config;
  config.ramp_s = 0.1F;
  config.dead_man_button = kButton;
  config.acknowledge_button = kAcknowledgeButton;
  config.passivity_damping_n_s_per_m = 2;
  return config;
}

// A guard whose device has reported its position; its clock is at zero.
inline GuardState met(const GuardConfig& config) {
  GuardState state = guard_start();
  (void)guard_sample(config, state, true, {0, 0, {{}, {1, 0, 0, 0}}, 0}, 0);
  return state;
}

// The next tick, with a device that answers and stands at the origin. Returns the force let
// through.
inline Vec3 next_force(const GuardConfig& config, GuardState& state, Vec3 asked_n) {
  const std::int64_t now_ns =
      state.now_ns + std::llround(static_cast<double>(config.period_s) * 1e9);
  (void)guard_sample(config, state, true, {state.seq + 1, now_ns, {{}, {1, 0, 0, 0}}, 0}, now_ns);
  return guard_force(config, state, asked_n);
}

// A guard and its clock, with a device that answers.
struct Desk {
  GuardConfig config = with_button();
  GuardState state = guard_start();
  std::int64_t now_ns = 0;
  std::uint64_t seq = 0;
  Vec3 position_m = {};
  Quat rotation = {1, 0, 0, 0};
  Vec3 asked_n = {3, 0, 0};

  bool acknowledges = false;

  bool hear(bool pressed) {
    now_ns += 1'000'000;
    const std::uint32_t buttons =
        (pressed ? 1U << kButton : 0U) | (acknowledges ? 1U << kAcknowledgeButton : 0U);
    const Sample sample = {++seq, now_ns, {position_m, rotation}, buttons};
    return guard_sample(config, state, true, sample, now_ns);
  }
  Vec3 tick(bool pressed) {
    (void)hear(pressed);
    return guard_force(config, state, asked_n);
  }
  void tick(int count, bool pressed) {
    for (int i = 0; i < count; ++i) (void)tick(pressed);
  }
  void miss(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      now_ns += 1'000'000;
      (void)guard_sample(config, state, false, {}, now_ns);
      (void)guard_force(config, state, asked_n);
    }
  }
};

}  // namespace stylet::hal
