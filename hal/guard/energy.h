// SPDX-License-Identifier: Apache-2.0
// The observer of energy and the passivity controller of the guard (GUARD.md).
// Promise: plain functions over a plain struct: no allocation, no clock, bounded time. Units: SI.
// Frame: the device's. Source: Hannaford and Ryu 2002.
#pragma once

#include <array>

#include "hal/guard/guard.h"

namespace stylet::hal::guarding {

// To be called when the device may be somewhere else: the energy drawn on the way is not known, and
// may be all that a spring can hold.
void lose_sight(const GuardConfig& config, EnergyObserver& energy);
// Averages the length of the device's way over kPathS: to and fro it adds up, where a velocity
// cancels out. To be called before pose_m becomes the new position.
void observe_path(const GuardConfig& config, GuardState& state, Vec3 position_m);
// Adds the work of the hand in this motion. A position within the resolution of the last is not a
// motion, so that a count that flickers does no work.
void observe_motion(const GuardConfig& config, GuardState& state, Vec3 position_m);
// The same for a turn of the device.
void observe_turn(const GuardConfig& config, EnergyObserver& energy, Quat rotation);
// Puts a force, or torque, in front of the earlier ones.
void remember(std::array<Vec3, kMaxDelayTicks + 2>& newest_first, Vec3 value);
// Takes back the energy that was made, as far as damping can in this tick.
Vec3 damped(const GuardConfig& config, GuardState& state, Vec3 force_n);

}  // namespace stylet::hal::guarding
