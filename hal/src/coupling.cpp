// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/coupling.h"

#include <algorithm>

namespace stylet::hal {

Vec3 coupled_base(const CouplingConfig& config, CouplingState& state, Vec3 device_m,
                  const Output& last) {
  const float k = config.stiffness_n_per_m;
  if (!(k > 0) || !state.started) {
    state = {true, device_m};
    return device_m;
  }
  const float share = k / (k + std::max(last.stiffness_n_per_m, 0.0F));
  const auto step = [&](float base, float device, float force) {
    return base + share * (device + force / k - base);
  };
  state.base_m = {step(state.base_m.x, device_m.x, last.force_n.x),
                  step(state.base_m.y, device_m.y, last.force_n.y),
                  step(state.base_m.z, device_m.z, last.force_n.z)};
  return state.base_m;
}

Vec3 coupled_force(const CouplingConfig& config, const CouplingState& state, Vec3 device_m,
                   Vec3 kernel_n) {
  const float k = config.stiffness_n_per_m;
  if (!(k > 0)) return kernel_n;
  return {k * (state.base_m.x - device_m.x), k * (state.base_m.y - device_m.y),
          k * (state.base_m.z - device_m.z)};
}

}  // namespace stylet::hal
