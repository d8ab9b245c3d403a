// SPDX-License-Identifier: Apache-2.0
// A hand that steers: pushes a bevelled needle in at constant speed and rolls it to reach a target.
//
// Rolling turns the bevel, and the path bends towards it. The policy: the bevel faces the target;
// it is rolled anew when the arc predicted from the tip's place and direction misses the target on
// the other side, early enough that half of what the opposite arc can make good is left. The base
// is where it is told to be: it feels no force. Via points are passed, the last point is where the
// needle stops, as soon as the tip is level with it.
// Promises: only + - * / sqrt, no allocation after the start; same tips, same motion.
// Units: SI. Frame: the device's; the needle goes in along -z, the bevel faces x turned by the
// roll. Source: arc of Webster et al. 2006; the policy is ours.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/device/device.h"

namespace stylet::hal {

struct SteeringConfig {
  std::vector<Vec3> targets_m;  // in the order in which they are passed
  float speed_m_per_s = 5e-3F;
  float curvature_per_m = 5;  // of the path towards the bevel
  float lag_m = 0;            // way over which the path takes up a roll
  float roll_rad_per_s = 12;
  float hold_s = 1;  // at the end
};

struct Steered {
  SteeringConfig config;  // targets in the device's frame
  double period_s = 1e-3;
  std::uint64_t tick = 0;
  std::size_t next = 0;  // target
  double depth_m = 0;
  double roll_w = 1, roll_z = 0;      // quaternion about z
  double wanted_x = 1, wanted_y = 0;  // side the bevel is turned towards
  bool aimed = false;
  std::uint32_t rolls = 0;
  Command last = {};
};

// Ticks that the way past all targets takes, with a tenth to spare, and the hold.
std::uint64_t steered_ticks(const SteeringConfig& config, float needle_length_m, double period_s);

// `steered` must outlive the device.
Device steered_device(Steered& steered, const DeviceInfo& info);

}  // namespace stylet::hal
