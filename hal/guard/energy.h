// SPDX-License-Identifier: Apache-2.0
// The observer of energy and the passivity controller of the guard (GUARD.md).
// Promise: plain functions over a plain struct: no allocation, no clock, bounded time. Units: SI.
// Frame: the device's. Source: Hannaford and Ryu 2002.
#pragma once

#include <array>

#include "hal/guard/guard.h"

namespace stylet::hal::guarding {

// Call this when the device may have moved unseen. What energy the hand put in meanwhile is not
// known; the most that a spring can hold is assumed.
void lose_sight(const GuardConfig& config, EnergyObserver& energy);
// Averages the speed along the device's path over kPathS. Motion to and fro adds up in it, but
// cancels out in a velocity. Call it before pose_m becomes the new position.
void observe_path(const GuardConfig& config, GuardState& state, Vec3 position_m);
// Adds the work of the hand in this motion. A position within the resolution of the last is not a
// motion, so an encoder count that flickers does no work.
void observe_motion(const GuardConfig& config, GuardState& state, Vec3 position_m);
// Adds the work of the hand in this turn of the device.
void observe_turn(const GuardConfig& config, EnergyObserver& energy, Quat rotation);
// Puts a force, or torque, in front of the earlier ones.
void remember(std::array<Vec3, kMaxDelayTicks + 2>& newest_first, Vec3 value);
// Adds the damping that takes back the energy that was made, as far as one tick can.
Vec3 damped(const GuardConfig& config, GuardState& state, Vec3 force_n);

}  // namespace stylet::hal::guarding
