// SPDX-License-Identifier: Apache-2.0
// How the motion of a device becomes the needle's: scale, turn, clutch, box, and a pivot at the
// skin.
//
// The needle starts at its own start, wherever the device is; from then on it follows the device.
// While the clutch's button is pressed the needle waits; the device moves freely and feels nothing.
// With a pivot the shaft always passes through the point of entry, as through skin: the device's
// position gives depth and direction, its rotation about the shaft gives the roll, and the force
// includes the needle's torque, by virtual work. The power at the device is the power at the needle
// times force_scale / motion_scale, except what a wall of the box or the hub at the skin takes.
// Promises: only + - * / sqrt; no allocation; if not enabled, pose and force stay as they are.
// Units: SI. Frames: the device's; the needle's: its origin is the base's start, -z points inwards.
#pragma once

#include <cstdint>

#include "hal/device/device.h"

namespace stylet::hal {

constexpr float kLetGoS = 0.02F;  // in which the force goes to zero when the clutch is pressed
constexpr float kTakeUpS = 0.3F;  // in which it comes back when the clutch is let go
constexpr float kHubM = 0.01F;    // least distance of a pivoting needle's base from the entry
constexpr std::int32_t kNoButton = -1;

struct GripConfig {
  bool enabled = false;
  float period_s = 1e-3F;
  float motion_scale = 1;    // the needle's motion over the device's
  float force_scale = 1;     // the hand's force over the needle's
  Quat turn = {1, 0, 0, 0};  // turns device coordinates into the needle's
  std::int32_t clutch_button = kNoButton;
  std::int32_t plunger_button = kNoButton;  // while it is pressed, a thumb on a syringe's plunger
  float plunger_n = 0;                      // presses with this, besides what the device tells
  Vec3 box_low_m = {-10, -10, -10};         // limits of the needle's base
  Vec3 box_high_m = {10, 10, 10};
  bool pivots = false;
  float pivot_depth_m = 0;  // of the point of entry, along the needle's line at the start
};

struct GripState {
  bool started = false;
  bool waits = false;                // set by the loop: wait as if the clutch were pressed
  bool held = false;                 // by the clutch
  float gain = 1;                    // factor of the force
  Pose needle = {{}, {1, 0, 0, 0}};  // of the base
  Quat rotation = {1, 0, 0, 0};      // the base's rotation if it did not pivot
  Vec3 offset_m = {};
  Quat offset_rotation = {1, 0, 0, 0};
};

// Pose of the needle's base, in the needle's frame.
Pose grip_pose(const GripConfig& config, GripState& state, const Sample& sample);

// The force on a syringe's plunger, enabled or not.
float plunger_force(const GripConfig& config, const Sample& sample);

// From the next sample on the needle follows the device again, from where the needle is now.
void grip_take_up(GripState& state);

struct Wrench {
  Vec3 force_n;
  Vec3 torque_nm;
};
// What the device must render, in its frame, when `needle` acts at the base, in the needle's frame.
// Call once a tick.
Wrench grip_wrench(const GripConfig& config, GripState& state, const Wrench& needle);
// The stiffness felt at the device of a spring of 1 N/m at the needle's base.
float grip_stiffness(const GripConfig& config, const GripState& state);

}  // namespace stylet::hal
