// SPDX-License-Identifier: Apache-2.0
// A hand that steers a bevelled needle to a target: it pushes at constant speed and rolls it.
//
// Rolling turns the bevel, and the path bends towards the bevel. The policy: the bevel faces the
// target. It is rolled anew when the arc predicted from the tip's position and direction misses the
// target on the other side, early enough to keep half of what the opposite arc can correct.
// The base is where it is told to be: it feels no force. Via points are passed; at the last point
// the needle stops as soon as the tip is level with it.
// Promises: only + - * / sqrt, no allocation after the start; the same tips give the same motion.
// Units: SI. Frame: the device's; the needle goes in along -z, the bevel faces x turned by the
// roll. Source: arc of Webster et al. 2006; the policy is ours.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/device/device.h"

namespace stylet::hal {

struct SteeringConfig {
  std::vector<Vec3> targets_m;  // in the order of passing
  float speed_m_per_s = 5e-3F;
  float curvature_per_m = 5;  // of the path towards the bevel
  float lag_m = 0;            // length of path over which a roll takes effect
  float roll_rad_per_s = 12;
  float hold_s = 1;  // at the end
};

struct Steered {
  SteeringConfig config;  // targets in the device's frame
  double period_s = 1e-3;
  std::uint64_t tick = 0;
  std::size_t next = 0;  // index of the target
  double depth_m = 0;
  double roll_w = 1, roll_z = 0;      // quaternion about z
  double wanted_x = 1, wanted_y = 0;  // side to which the bevel is to be turned
  bool aimed = false;
  std::uint32_t rolls = 0;
  Command last = {};
};

// Ticks that it takes to pass all targets, with a tenth to spare, and to hold.
std::uint64_t steered_ticks(const SteeringConfig& config, float needle_length_m, double period_s);

// `steered` must outlive the device.
Device steered_device(Steered& steered, const DeviceInfo& info);

}  // namespace stylet::hal
