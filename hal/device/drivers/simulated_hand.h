// SPDX-License-Identifier: Apache-2.0
// A hand that is not there: a mass held by a spring and a damper to a target that follows a script,
// and the device it holds.
//
// The force it is given pushes the mass back, so the loop is closed as with a person. Time is the
// loop's tick, not the clock: the same forces give the same motion, bit for bit. Each read is one
// tick of implicit midpoint steps, stable for every mass, spring and damper. The roll of the base
// is the script's own: nothing turns it back. Rolled for a part of every turn's time only
// (duty-cycled spinning, Minhas et al. 2007), a bevelled needle bends by the rest of its curvature.
//
// The device adds its mass, damping and Coulomb friction to the hand's, and tells of its position
// late and in steps of its resolution, each axis on its own; the roll it tells as it is. The energy
// that the hand's side gave it is kept exactly: work against the forces sent, which are held for a
// tick, and what damping and friction take. A device that feels passive keeps it above zero.
// Promises: only + - * / sqrt, no allocation after make_script.
// Units: SI, turns. Frame: the device's; at rest at the origin, pushing the needle moves along -z;
// turns are about z, positive from x to y.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal/device/device.h"
#include "hal/device/model.h"

namespace stylet::hal {

// Go to a place, then stay there. Positions are where the target goes.
struct Waypoint {
  float travel_m = 0;  // of the tip beyond the first contact with the organ at rest
  float right_m = 0;   // across the needle: device x and y
  float up_m = 0;
  float speed_m_per_s = 0;  // 0: take time_s instead
  float time_s = 0;
  float hold_s = 0;
  float turns = 0;  // of the base, on the way
  float duty = 1;   // share of each turn's time in which the base rolls; the rest it waits
};
// Of the way between two places, at the second one's pace.
double seconds_between(const Waypoint& from, const Waypoint& to);

struct SimulatedHandConfig {
  float mass_kg = 0.2F;
  float stiffness_n_per_m = 2000;
  float damping_n_s_per_m = 30;
  DeviceDynamics device = {};
  std::uint32_t held_buttons = 0;  // pressed with the second sample
};

// Motion is computed in so many steps a tick, and remembered for so many of them.
constexpr std::uint32_t kHandStepsPerTick = 8;
constexpr std::size_t kHandHistory = (kMaxDelayTicks + 1) * kHandStepsPerTick;

// The target between two moments moves in a straight line at constant speed. `turns` are since the
// start, `duty` is of the way here.
struct ScriptPoint {
  double t_s, x_m, y_m, z_m;
  double turns = 0, duty = 1;
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
  double received_j = 0, least_received_j = 0;  // from the hand's side; the least ever
};

// `hand` must outlive the device.
Device simulated_hand_device(SimulatedHand& hand, const DeviceInfo& info);

}  // namespace stylet::hal
