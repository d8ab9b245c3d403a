// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/fit.h"

#include <algorithm>

namespace stylet::hal {
namespace {

// The configured value counts only where it is stricter; where nothing is configured it is zero.
float assumed(float configured, float devices) {
  return configured > 0 ? std::min(configured, devices) : devices;
}

// What the device says; else what is known of its model; else 0.
float known(float said, const DeviceModel* model, float DeviceModel::*of_model) {
  return said > 0 ? said : model != nullptr ? model->*of_model : 0;
}

void fit_force(const DeviceInfo& info, const GripConfig& grip, GuardConfig& guard,
               CouplingConfig& coupling) {
  guard.max_force_n = std::min(guard.max_force_n, info.max_force_n);
  const float slew = std::min(guard.max_slew_n_per_s, info.max_slew_n_per_s);
  guard.max_slew_n_per_s = std::max(slew, guard.max_force_n / kDecayS);
  coupling.max_force_n = guard.max_force_n / grip.force_scale;
  guard.buzz_n = std::min(guard.buzz_n, static_cast<float>(kBuzzFraction) * guard.max_force_n);
}

void fit_heat_and_stiffness(const DeviceInfo& info, const GripConfig& grip, GuardConfig& guard,
                            CouplingConfig& coupling) {
  const float always_n =
      known(info.continuous_force_n, info.model, &DeviceModel::continuous_force_n);
  if (always_n > 0) guard.continuous_force_n = std::min(guard.continuous_force_n, always_n);
  const float stiffness =
      known(info.max_stiffness_n_per_m, info.model, &DeviceModel::max_stiffness_n_per_m);
  if (!(stiffness > 0)) return;
  coupling.stiffness_n_per_m = assumed(coupling.stiffness_n_per_m, most_coupling(stiffness, grip));
}

// For the observer of energy: what the device itself dissipates, not what a configured one would.
void fit_energy(const DeviceInfo& info, GuardConfig& guard) {
  const DeviceModel& model = *info.model;
  const DeviceDynamics configured = guard.device;
  guard.device = model.motion;
  guard.device.damping_n_s_per_m =
      assumed(configured.damping_n_s_per_m, model.motion.damping_n_s_per_m);
  guard.device.friction_n = assumed(configured.friction_n, model.motion.friction_n);
  const Vec3 reach = model.workspace_m;
  guard.stored_energy_j =
      0.5F * std::min(info.max_force_n, model.max_force_n) * std::max({reach.x, reach.y, reach.z});
  guard.passivity_damping_n_s_per_m =
      assumed(guard.passivity_damping_n_s_per_m,
              static_cast<float>(kPassivityFraction) * model.max_damping_n_s_per_m);
}

}  // namespace

float most_coupling(float limit_n_per_m, const GripConfig& grip) {
  return static_cast<float>(kCouplingFraction) * limit_n_per_m /
         (grip.motion_scale * grip.force_scale);
}

void fit_to_device(const DeviceInfo& info, const GripConfig& grip, GuardConfig& guard,
                   CouplingConfig& coupling) {
  if (info.max_force_n > 0) {
    fit_force(info, grip, guard, coupling);
    fit_heat_and_stiffness(info, grip, guard, coupling);
    if (info.model != nullptr) fit_energy(info, guard);
  }
  guard.watchdog_s = watchdog_of(info, guard.watchdog_s);
}

}  // namespace stylet::hal
