// SPDX-License-Identifier: Apache-2.0
// Haptic devices by name: what each can do, and how it moves.
//
// Sources. Largest force, stiffness and damping: CHAI3D's device classes. Workspace and resolution:
// data sheets; for the Phantoms (Touch, Omni, Touch X, Premium) also continuous force, friction and
// mass. Not published, and assumed on the safe side: 0.2 kg and no friction for parallel arms, and
// a quarter of the largest force as a Falcon's continuous one. Delay: a period of 1 ms over USB, a
// quarter of it for devices that can be polled at 4 kHz. Damping of the arm: see with_arm_damping.
// The models are listed in the drivers of their devices. Promise: plain data. Units: SI.
// Frame: the device's.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "stylet/units.h"

namespace stylet::hal {

// Longest delay of a device that the observer of energy and the simulated device can handle.
constexpr std::uint32_t kMaxDelayTicks = 16;

// How a device moves and answers, without the hand that holds it.
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
  float continuous_force_n = 8;  // that its motors bear for ever
  float max_slew_n_per_s = 2000;
  float max_stiffness_n_per_m = 0;        // that it renders without buzzing; 0: unknown
  float max_damping_n_s_per_m = 0;        // likewise
  Vec3 workspace_m = {0.2F, 0.2F, 0.2F};  // right, up, toward the operator
  DeviceDynamics motion = {};
};

constexpr float kAssumedSlewNPerS = 2000;  // for every model: no maker publishes it
// One USB period of 1 ms, and a quarter of it for devices that can be polled at 4 kHz.
constexpr float kUsbS = 1e-3F, kPolledUsbS = 0.25e-3F;

constexpr Vec3 mm(float right, float up, float near) {
  return {1e-3F * right, 1e-3F * up, 1e-3F * near};
}

// Sets the damping that the stated stiffness implies, if that is where the device begins to buzz
// in a light grip: b = K (T/2 + delay) at T = 1 ms (Gil et al. 2009).
constexpr DeviceModel with_arm_damping(DeviceModel model) {
  constexpr float kHalfPeriodS = 0.5e-3F;
  model.motion.damping_n_s_per_m =
      model.max_stiffness_n_per_m * (kHalfPeriodS + model.motion.delay_s);
  return model;
}

// The models of all known drivers (devices.h).
std::span<const DeviceModel> device_models();
// nullptr: no model has this name.
const DeviceModel* find_device_model(std::string_view name);
// The model of a device that calls itself `called`, as "PHANTOM Omni" or "Touch X": the longest
// model name found in it, ignoring what is between the letters. nullptr: none is found.
const DeviceModel* recognise_device_model(std::string_view called);
// The model for an unknown device: for each number, the most careful value of all models.
const DeviceModel& unknown_device_model();

}  // namespace stylet::hal
