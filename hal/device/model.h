// SPDX-License-Identifier: Apache-2.0
// Haptic devices by name: what each can do, and how it moves.
//
// Sources. Largest force, stiffness and damping: what CHAI3D's device classes advertise. The
// Phantoms' (Touch, Omni, Touch X, Premium) continuous force, resolution, friction, mass and
// workspace: their data sheets; workspace and resolution of the others likewise. Not published and
// assumed on the safe side: 0.2 kg and no friction for parallel arms, a quarter of the largest
// force as a Falcon's continuous one. Delay: a period of 1 ms over USB, a quarter of it for devices
// that can be polled at 4 kHz. Damping of the arm: see with_arm_damping. Each
// driver has the models of its devices. Promise: plain data. Units: SI.
// Frame: the device's.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "stylet/units.h"

namespace stylet::hal {

// Of a device's delay, that the observer of energy and the simulated device allow for.
constexpr std::uint32_t kMaxDelayTicks = 16;

// How a device moves and answers, beside the hand that holds it.
struct DeviceDynamics {
  float mass_kg = 0;            // felt at the handle
  float damping_n_s_per_m = 0;  // of the arm and the lightest grip
  float friction_n = 0;         // Coulomb
  float resolution_m = 0;       // of the position it measures
  float delay_s = 0;            // from a motion to the force that answers it, beside the loop's own
};

struct DeviceModel {
  const char* name = "device";
  float max_force_n = 8;
  float continuous_force_n = 8;  // what its motors stand for ever
  float max_slew_n_per_s = 2000;
  float max_stiffness_n_per_m = 0;        // that it renders without buzzing; 0: not known
  float max_damping_n_s_per_m = 0;        // likewise
  Vec3 workspace_m = {0.2F, 0.2F, 0.2F};  // right, up, towards the operator
  DeviceDynamics motion = {};
};

constexpr float kAssumedSlewNPerS = 2000;  // of every model: none is published
// A period of 1 ms, and a quarter of it for devices that can be polled at 4 kHz.
constexpr float kUsbS = 1e-3F, kPolledUsbS = 0.25e-3F;

constexpr Vec3 mm(float right, float up, float near) {
  return {1e-3F * right, 1e-3F * up, 1e-3F * near};
}

// The damping is what the advertised stiffness implies, if that is where the device begins to buzz
// in a light grip: b = K (T/2 + delay) at T = 1 ms (Gil et al. 2009).
constexpr DeviceModel with_arm_damping(DeviceModel model) {
  constexpr float kHalfPeriodS = 0.5e-3F;
  model.motion.damping_n_s_per_m =
      model.max_stiffness_n_per_m * (kHalfPeriodS + model.motion.delay_s);
  return model;
}

// Of all drivers that are known (devices.h).
std::span<const DeviceModel> device_models();
// nullptr: none has this name.
const DeviceModel* find_device_model(std::string_view name);
// What a device is that calls itself so, as "PHANTOM Omni" or "Touch X": the longest name of ours
// in its own, whatever is between the letters. nullptr: none.
const DeviceModel* recognise_device_model(std::string_view called);
// Of a device that nothing is known of: of each number the most careful that any of them has.
const DeviceModel& unknown_device_model();

}  // namespace stylet::hal
