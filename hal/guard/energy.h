// SPDX-License-Identifier: Apache-2.0
// The observer of energy and the passivity controller of the guard (GUARD.md).
// Promise: plain functions over a plain struct: no allocation, no clock, bounded time. Units: SI.
// Frame: the device's. Source: Hannaford and Ryu 2002.
#pragma once

#include <array>

#include "hal/guard/guard.h"

namespace stylet::hal::guarding {

// The device is somewhere else, and what was drawn on the way is not known: it may be all that a
// spring can hold.
void lose_sight(const GuardConfig& config, EnergyObserver& energy);
// Work of the hand in this motion. A position within the resolution of the last is no motion, so
// that a count that flickers does no work.
void observe_motion(const GuardConfig& config, GuardState& state, Vec3 position_m);
// Likewise of a turn of the device.
void observe_turn(const GuardConfig& config, EnergyObserver& energy, Quat rotation);
// Of forces, or torques, the newest first.
void remember(std::array<Vec3, kMaxDelayTicks + 2>& newest_first, Vec3 value);
// Takes back what was made, as far as damping can in this tick.
Vec3 damped(const GuardConfig& config, GuardState& state, Vec3 force_n);

}  // namespace stylet::hal::guarding
