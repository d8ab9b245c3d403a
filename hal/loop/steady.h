// SPDX-License-Identifier: Apache-2.0
// Smooths a position that a device reports in steps of its resolution: of all positions that would
// be reported as this one, it gives the one to which the motion so far leads.
//
// With a stiffness of 3.5 N/mm, steps of 0.01 mm are steps of 35 mN in the force, and a needle that
// sticks meets far more stiffness. Promises: on each axis the result is within half a step of the
// reported position, so it never lags by more; a count that flickers is no motion; without a
// resolution the result is the reported position; only + - * /. Units: SI. Frame: the device's.
#pragma once

#include "stylet/units.h"

namespace stylet::hal {

constexpr float kSteadyS = 10e-3F;  // time over which the position's velocity is averaged

struct SteadyState {
  bool started = false;
  Vec3 position_m = {};
  Vec3 step_m = {};  // motion in a tick
};

Vec3 steady_position(float resolution_m, float period_s, SteadyState& state, Vec3 told_m);

}  // namespace stylet::hal
