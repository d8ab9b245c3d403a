// SPDX-License-Identifier: Apache-2.0
// Steadies a position that a device tells in steps of its resolution: of all positions that would
// have been told as this one, it gives the one that the motion so far leads to.
//
// With a stiffness of 3.5 N/mm, steps of 0.01 mm give a force of 35 mN at every count, and a needle
// that sticks meets far more stiffness. Promises: on each axis within half a step of what was told,
// so it never lags by more; a count that flickers is no motion; without a resolution the result is
// what was told; only + - * /. Units: SI. Frame: the device's.
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
