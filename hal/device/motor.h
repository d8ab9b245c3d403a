// SPDX-License-Identifier: Apache-2.0
// The last check of a force before the motors, in the thread that writes it to the device.
//
// The guard decides in the loop's time; here time is the motors' own. Whatever loop, guard or
// channel do, the force written is finite, within the device's limits, and changes by at most the
// slew limit in the time that has really passed, even if a vendor's call has held a force back. An
// order that is not renewed begins to fade after kOrderFreshNs, by the largest force in
// kMotorFadeNs: it is zero within 25 ms of the last order. An order with an end time of its own, as
// from a station's model, is gone by then, even if something is held up or fading. An order that is
// older than kOrderLifeNs, as when the writing thread was held up that long, is over for good: the
// motors are stopped, and only an order with a newer arming number, which the guard gives after
// somebody acknowledged, moves them again. The guard learns of it from the report, and starts fades
// and ramps from what the motors have. A loop that is 4 to 10 ms late is felt as a dip of at most
// 30 % of the largest force, slewed both ways: too short to be worth a fault.
// Promises: no allocation, no clock, no lock; the same few steps each time.
// Units: SI, ns on CLOCK_MONOTONIC. Frame: the device's.
#pragma once

#include <array>
#include <cstdint>

#include "stylet/units.h"

namespace stylet::hal {

// A smaller delay of the loop is not felt. If it stops, the force is zero after 4 + 20 ms, so a
// thread that writes once a millisecond keeps the 25 ms of hal/guard/GUARD.md.
constexpr std::int64_t kOrderFreshNs = 4'000'000;
constexpr std::int64_t kOrderLifeNs = 10'000'000;
constexpr std::int64_t kMotorFadeNs = 20'000'000;
// A thread that was held up does not catch up in one step.
constexpr std::int64_t kMotorStepNs = 2'000'000;
// The shortest of this many calls is a call's usual time; a longer one was held up.
constexpr int kUsualCalls = 8;
constexpr float kUnknownSlewNPerS = 1000;  // if a device tells none: the smallest of all known

struct MotorLimits {
  float max_force_n = 0;
  float max_slew_n_per_s = kUnknownSlewNPerS;  // at least max_force_n / kMotorFadeNs
  float max_torque_nm = 0;                     // it is reached from zero in half of kMotorFadeNs
};

struct MotorOrder {
  Vec3 force_n = {};
  Vec3 torque_nm = {};
  std::int64_t t_ns = 0;     // of the tick that gave it, all different; 0: none was given yet
  std::uint32_t arming = 0;  // the guard's, see GuardState
  bool falls = false;        // the guard is taking force away: it must not grow
  std::int64_t end_ns = 0;   // the force must be gone by then; 0: it only ages
};

struct MotorReport {
  Vec3 force_n = {};  // what force the motors have
  Vec3 torque_nm = {};
  std::uint32_t arming = 0;  // of the newest order
  bool stopped = false;      // orders of this arming no longer move anything
  bool failed = false;       // because the device has failed
};

struct MotorState {
  MotorReport report;
  std::int64_t t_ns = 0;                               // of the last step; 0: no step yet
  std::int64_t had_ns = 0;                             // since when the motors have the last force
  std::array<std::int64_t, kUsualCalls> call_ns = {};  // how long the last calls took
  std::int64_t given_ns = 0;  // the newest order's time as written in it; 0: none yet
  std::int64_t order_ns = 0;  // start of its age: when first seen, if its time lies ahead
  bool fading = false;
  std::int64_t fade_ns = 0;  // since when it fades
  Vec3 fade_force_n = {};    // the force it fades from
  Vec3 fade_torque_nm = {};
};

// kFade: the device is about to be closed. kNow: it has failed, and may have cut the force itself;
// a fade from the force last written would then be a kick.
enum class MotorCut : std::uint32_t { kNone, kFade, kNow };

// Whether `arming` came after `than`, by an acknowledgement: numbers grow and may wrap around.
constexpr bool is_newer_arming(std::uint32_t arming, std::uint32_t than) {
  return static_cast<std::int32_t>(arming - than) > 0;
}

// Computes what to write now, into state.report.
void motor_step(const MotorLimits& limits, MotorState& state, const MotorOrder& order, MotorCut cut,
                std::int64_t now_ns);

// The call that wrote the force has returned. The motors may have the force since it began, or
// since it ended, if it was held up. So the next step is slewed from the end of the call,
// less the usual time of a call. Without this function calls count as taking no time.
void motor_written(MotorState& state, std::int64_t now_ns);

}  // namespace stylet::hal
