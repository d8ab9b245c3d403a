// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/steady.h"

#include <algorithm>

namespace stylet::hal {

Vec3 steady_position(float resolution_m, float period_s, SteadyState& state, Vec3 told_m) {
  if (!(resolution_m > 0) || !state.started) {
    state = {true, told_m, {}};
    return told_m;
  }
  const float gain = period_s / (period_s + kSteadyS), half = 0.5F * resolution_m;
  const auto follow = [gain, half](float& position, float& step, float told) {
    const float expected = position + step;
    position = std::clamp(expected, told - half, told + half);
    step += gain * (position - expected);
  };
  follow(state.position_m.x, state.step_m.x, told_m.x);
  follow(state.position_m.y, state.step_m.y, told_m.y);
  follow(state.position_m.z, state.step_m.z, told_m.z);
  return state.position_m;
}

}  // namespace stylet::hal
