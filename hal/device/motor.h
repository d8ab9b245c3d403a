// SPDX-License-Identifier: Apache-2.0
// The last word on a force: what the motors get, in the thread that writes it to the device.
//
// The guard decides in the loop's time; here the time is the motors' own. Whatever loop, guard or
// channel do, what leaves is finite, within the device's limits, and changes by at most the slew
// limit in the time that has really passed, also when a vendor's call has held a force back. An
// order that is not renewed begins to fade after kOrderFreshNs, by the largest force in
// kMotorFadeNs: zero within 25 ms of the last one. One that ends at a time of its own, as what a
// station's model gives, is gone by then, whoever is held up or fades meanwhile. After
// kOrderLifeNs, as when the thread that writes was held up for so long, it is over for good: the
// motors are stopped, and only an order with a newer arming number, which the guard gives after
// somebody acknowledged, moves them again. The guard learns of it by the report, and begins its
// fades and ramps from what the motors have. A loop that is 4 to 10 ms late is felt as a dip, by at
// most 30 % of the largest force and slewed both ways: shorter than a fault is worth.
// Promises: no allocation, no clock, no lock; the same few steps each time.
// Units: SI, ns on CLOCK_MONOTONIC. Frame: the device's.
#pragma once

#include <array>
#include <cstdint>

#include "stylet/units.h"

namespace stylet::hal {

// A loop that is late by less is not felt; one that stopped is zero at 4 + 20 ms, and a thread that
// writes once a millisecond keeps the 25 ms of hal/guard/GUARD.md.
constexpr std::int64_t kOrderFreshNs = 4'000'000;
constexpr std::int64_t kOrderLifeNs = 10'000'000;
constexpr std::int64_t kMotorFadeNs = 20'000'000;
// A thread that was held up does not make up for it in one step.
constexpr std::int64_t kMotorStepNs = 2'000'000;
// Of so many calls the shortest is what a call takes; one that takes longer was held up.
constexpr int kUsualCalls = 8;
constexpr float kUnknownSlewNPerS = 1000;  // of a device that tells none: the smallest of all known

struct MotorLimits {
  float max_force_n = 0;
  float max_slew_n_per_s = kUnknownSlewNPerS;  // at least max_force_n / kMotorFadeNs
  float max_torque_nm = 0;                     // from zero to it in half of kMotorFadeNs
};

struct MotorOrder {
  Vec3 force_n = {};
  Vec3 torque_nm = {};
  std::int64_t t_ns = 0;     // of the tick that gave it, no two alike; 0: none was given yet
  std::uint32_t arming = 0;  // the guard's, see GuardState
  bool falls = false;        // the guard lets go: what there is must not grow
  std::int64_t end_ns = 0;   // by when nothing of it may be left; 0: it ages only
};

struct MotorReport {
  Vec3 force_n = {};  // what the motors have
  Vec3 torque_nm = {};
  std::uint32_t arming = 0;  // of the newest order
  bool stopped = false;      // orders of this arming move nothing any more
};

struct MotorState {
  MotorReport report;
  std::int64_t t_ns = 0;                               // of the last step; 0: none yet
  std::int64_t had_ns = 0;                             // since when the motors have the last force
  std::array<std::int64_t, kUsualCalls> call_ns = {};  // how long the last ones took
  std::int64_t given_ns = 0;  // the newest order's time as it is written; 0: none yet
  std::int64_t order_ns = 0;  // from which it ages: one of the future is of when it was seen
  bool fading = false;
  std::int64_t fade_ns = 0;  // since when
  Vec3 fade_force_n = {};    // from what
  Vec3 fade_torque_nm = {};
};

// kFade: the device is to be closed. kNow: it has failed, and may have cut the force itself; a fade
// from what we last wrote would then be a kick.
enum class MotorCut : std::uint32_t { kNone, kFade, kNow };

// Whether somebody acknowledged between the two: armings grow, and may wrap around.
constexpr bool is_newer_arming(std::uint32_t arming, std::uint32_t than) {
  return static_cast<std::int32_t>(arming - than) > 0;
}

// What to write now; state.report is what was written.
void motor_step(const MotorLimits& limits, MotorState& state, const MotorOrder& order, MotorCut cut,
                std::int64_t now_ns);

// The call that wrote it has come back. The motors may have had the force from its beginning, or
// have got it at its end, after a call that was held up: what comes next is slewed from its end,
// less what a call usually takes. Whoever does not say so has calls that take no time.
void motor_written(MotorState& state, std::int64_t now_ns);

}  // namespace stylet::hal
