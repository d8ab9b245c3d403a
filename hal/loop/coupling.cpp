// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/coupling.h"

#include <algorithm>

#include "hal/base/vector.h"

namespace stylet::hal {
namespace {

// The stiffness that the base has met recently, at most `bound`.
float met_stiffness(const CouplingConfig& config, CouplingState& state, Vec3 force_n, float bound) {
  const float gain = config.period_s / (config.period_s + kCouplingStiffnessS);
  const float work = -dot(force_n - state.force_n, state.moved_m);
  state.work_j += gain * (work - state.work_j);
  state.square_m2 += gain * (dot(state.moved_m, state.moved_m) - state.square_m2);
  if (!(state.work_j > 0)) return 0;
  return state.work_j < bound * state.square_m2 ? state.work_j / state.square_m2 : bound;
}

// The base, moved so that it is at most `most_m` from the device.
Vec3 drawn_along(float most_m, Vec3 device_m, Vec3 base_m) {
  const Vec3 way = base_m - device_m;
  const float size = length(way);
  return size > most_m ? device_m + most_m / size * way : base_m;
}

}  // namespace

Vec3 coupled_base(const CouplingConfig& config, CouplingState& state, Vec3 device_m,
                  const Output& last) {
  const float k = config.stiffness_n_per_m;
  if (!(k > 0) || !state.started) {
    state.started = true;
    state.base_m = state.device_m = device_m;
    return device_m;
  }
  const float bound = std::max(last.stiffness_n_per_m, 0.0F);
  const float met = met_stiffness(config, state, last.force_n, bound);
  const float quick = config.period_s / (config.period_s + kCouplingVelocityS);
  state.step_m = state.step_m + quick * (device_m - state.device_m - state.step_m);
  const Vec3 ahead = state.base_m + k / (k + met) * state.step_m;
  const Vec3 balance = device_m + 1 / k * last.force_n;
  Vec3 base = bound > 0 ? ahead + k / (k + bound) * (balance - ahead) : balance;
  if (config.max_force_n > 0) base = drawn_along(config.max_force_n / k, device_m, base);
  state.moved_m = base - state.base_m;
  state.base_m = base;
  state.device_m = device_m;
  state.force_n = last.force_n;
  return base;
}

Vec3 coupled_force(const CouplingConfig& config, const CouplingState& state, Vec3 device_m,
                   Vec3 kernel_n) {
  const float k = config.stiffness_n_per_m;
  if (!(k > 0)) return kernel_n;
  return k * (state.base_m - device_m);
}

}  // namespace stylet::hal
