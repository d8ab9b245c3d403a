// SPDX-License-Identifier: Apache-2.0
// A simulated hand: a mass held by a spring and a damper to a target that follows a script, and the
// device that it holds.
//
// The force it receives pushes the mass back, so the loop is closed as with a person. Time is the
// loop's ticks, not the clock: the same forces give the same motion, bit for bit. Each read is one
// tick of implicit midpoint steps, which are stable for every mass, spring and damper. The base's
// roll is the script's own: no torque turns it. If a bevelled needle is rolled only for a part of
// each turn's time (duty-cycled spinning, Minhas et al. 2007), it bends with the curvature left.
//
// The device adds its mass, damping and Coulomb friction to the hand's. It tells its position late
// and in steps of its resolution, on each axis separately, but its roll exactly. The energy that it
// receives from the hand's side is summed exactly: work against the sent forces, which are held for
// a tick, and losses by damping and friction. A device that feels passive keeps it above zero.
// Promises: only + - * / sqrt, no allocation after make_script.
// Units: SI, turns. Frame: the device's; it rests at the origin, and pushing the needle moves along
// -z; turns are about z, positive from x to y.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal/device/device.h"
#include "hal/device/model.h"

namespace stylet::hal {

// Go to a position, then stay there. Positions are those of the target.
struct Waypoint {
  float travel_m = 0;  // of the tip, beyond the first contact with the organ at rest
  float right_m = 0;   // across the needle: device x and y
  float up_m = 0;
  float speed_m_per_s = 0;  // 0: take time_s instead
  float time_s = 0;
  float hold_s = 0;
  float turns = 0;      // of the base, during the motion
  float duty = 1;       // fraction of each turn's time in which the base rolls; else it waits
  float plunger_n = 0;  // on a syringe's plunger, during the motion and the stay
};
// Time of the motion between two positions, at the second one's speed.
double seconds_between(const Waypoint& from, const Waypoint& to);

struct SimulatedHandConfig {
  float mass_kg = 0.2F;
  float stiffness_n_per_m = 2000;
  float damping_n_s_per_m = 30;
  DeviceDynamics device = {};
  std::uint32_t held_buttons = 0;  // pressed from the second sample on
};

// Motion is computed in this many steps a tick, and remembered for this many of them.
constexpr std::uint32_t kHandStepsPerTick = 8;
constexpr std::size_t kHandHistory = (kMaxDelayTicks + 1) * kHandStepsPerTick;

// Between two moments the target moves in a straight line at constant speed. `turns` counts from
// the start, `duty` is that of the motion to here.
struct ScriptPoint {
  double t_s, x_m, y_m, z_m;
  double turns = 0, duty = 1;
  float plunger_n = 0;  // on the way to here
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
  std::array<std::array<double, 3>, kHandHistory> history_m = {};
  double received_j = 0, least_received_j = 0;  // from the hand's side; the least so far
};

// `hand` must outlive the device.
Device simulated_hand_device(SimulatedHand& hand, const DeviceInfo& info);

}  // namespace stylet::hal
