// SPDX-License-Identifier: Apache-2.0
// A hand that is not there: a mass held by a spring and a damper to a target that follows a script.
//
// The force it is given pushes the mass back, so the loop is closed as with a person. Time is the
// loop's tick, not the clock: the same forces give the same motion, bit for bit. Each read is one
// tick of implicit midpoint steps, stable for every mass, spring and damper.
// Promises: only + - * /, no allocation after make_script.
// Units: SI. Frame: the device's; at rest at the origin, pushing the needle moves along -z.
#pragma once

#include <cstdint>
#include <vector>

#include "stylet/hal/device.h"

namespace stylet::hal {

// Go to a place, then stay there. Positions are where the target goes.
struct Waypoint {
  float travel_m = 0;  // of the tip beyond the first contact with the organ at rest
  float right_m = 0;   // across the needle: device x and y
  float up_m = 0;
  float speed_m_per_s = 0;  // 0: take time_s instead
  float time_s = 0;
  float hold_s = 0;
};

struct SimulatedHandConfig {
  float mass_kg = 0.2F;
  float stiffness_n_per_m = 2000;
  float damping_n_s_per_m = 30;
};

// The target between two moments moves in a straight line at constant speed.
struct ScriptPoint {
  double t_s, x_m, y_m, z_m;
};
std::vector<ScriptPoint> make_script(const std::vector<Waypoint>& waypoints, float start_m);
std::uint64_t script_ticks(const std::vector<ScriptPoint>& script, double period_s);

struct SimulatedHand {
  SimulatedHandConfig config;
  double period_s = 1e-3;
  std::vector<ScriptPoint> script;
  std::uint64_t tick = 0;
  std::size_t segment = 0;
  double position_m[3] = {};
  double velocity_m_per_s[3] = {};
  Vec3 force_n = {};  // last command
};

// `hand` must outlive the device.
Device simulated_hand_device(SimulatedHand& hand, const DeviceInfo& info);

}  // namespace stylet::hal
