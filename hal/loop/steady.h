// SPDX-License-Identifier: Apache-2.0
// A position that a device tells in steps of its resolution, made steady: of all places that would
// have been told as this one, the place that the motion so far leads to.
//
// Times a stiffness of 3.5 N/mm, steps of 0.01 mm are a force of 35 mN at every count, and a needle
// that sticks sees far more stiffness. Promises: within half a step of what was told, on each axis,
// so that it never lags by more; a count that flickers is no motion; without a resolution it is
// what was told; only + - * /. Units: SI. Frame: the device's.
#pragma once

#include "stylet/units.h"

namespace stylet::hal {

constexpr float kSteadyS = 10e-3F;  // over which its velocity is averaged

struct SteadyState {
  bool started = false;
  Vec3 position_m = {};
  Vec3 step_m = {};  // in a tick
};

Vec3 steady_position(float resolution_m, float period_s, SteadyState& state, Vec3 told_m);

}  // namespace stylet::hal
