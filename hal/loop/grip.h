// SPDX-License-Identifier: Apache-2.0
// How a hand that holds a device holds the needle: scale, turn, clutch, box, and a pivot at the
// skin.
//
// The needle starts where it starts, whatever place the device is in; from then on it follows.
// While the clutch's button is pressed the needle waits, the device moves freely and feels nothing.
// With a pivot the shaft always passes through the point of entry, as through skin: the device's
// place gives depth and direction, its rotation about the shaft the roll, and the force carries the
// needle's torque, by virtual work. The power at the device is that at the needle times force_scale
// / motion_scale, but for what a wall of the box or the hub at the skin takes.
// Promises: only + - * / sqrt; no allocation; not enabled: the pose and the force as they are.
// Units: SI. Frames: the device's; and the needle's: origin where its base starts, -z inwards.
#pragma once

#include <cstdint>

#include "hal/device/device.h"

namespace stylet::hal {

constexpr float kLetGoS = 0.02F;  // the force's way to zero when the clutch is pressed
constexpr float kTakeUpS = 0.3F;  // and back when it is let go
constexpr float kHubM = 0.01F;    // a pivoting needle's base stays as far from the entry
constexpr std::int32_t kNoButton = -1;

struct GripConfig {
  bool enabled = false;
  float period_s = 1e-3F;
  float motion_scale = 1;    // the needle's way over the device's
  float force_scale = 1;     // the hand's force over the needle's
  Quat turn = {1, 0, 0, 0};  // turns device coordinates into the needle's
  std::int32_t clutch_button = kNoButton;
  Vec3 box_low_m = {-10, -10, -10};  // for the needle's base
  Vec3 box_high_m = {10, 10, 10};
  bool pivots = false;
  float pivot_depth_m = 0;  // of the point of entry, on the line of the start
};

struct GripState {
  bool started = false;
  bool waits = false;                // set by the loop: as if the clutch were pressed
  bool held = false;                 // by the clutch
  float gain = 1;                    // of the force
  Pose needle = {{}, {1, 0, 0, 0}};  // of the base
  Quat rotation = {1, 0, 0, 0};      // of the base, did it not pivot
  Vec3 offset_m = {};
  Quat offset_rotation = {1, 0, 0, 0};
};

// Pose of the needle's base, in the needle's frame.
Pose grip_pose(const GripConfig& config, GripState& state, const Sample& sample);

// From the next sample on the needle follows anew, from where it is.
void grip_take_up(GripState& state);

struct Wrench {
  Vec3 force_n;
  Vec3 torque_nm;
};
// What the device must render, in its frame, for `needle` at the base, in the needle's frame. Once
// a tick.
Wrench grip_wrench(const GripConfig& config, GripState& state, const Wrench& needle);
// What a spring of 1 N/m at the needle's base feels like at the device.
float grip_stiffness(const GripConfig& config, const GripState& state);

}  // namespace stylet::hal
