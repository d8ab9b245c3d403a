// SPDX-License-Identifier: Apache-2.0
// Friction between shaft and tissue: constraint particles (CPs) that stick and slip.
//
// A shaft CP carries the shaft from its own place towards the tip, at most one needle unit. Its
// friction grows from zero as the tip moves on and shrinks to zero as the tip returns, so adding or
// removing a CP is never felt. The law is in laws/friction.h.
//
// Promises: bounded by kMaxConstraintParticles, no allocation, fixed order. Units SI.
// Source: paper section V (sticking and slipping). PHYSICS 12.1, 12.6.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Gives a CP the spring of its tributary length. Spring and friction vanish when the tip comes back
// to the CP, so neither friction nor clamping jumps when it is added or removed. The energy that
// this takes is booked as friction.
void take_tributary_spring(const Model& model, State& state, Particle& p);

// A tributary length may lie in several materials: its friction is their mean, sampled where the
// tip passed in this tick, from `from_m` in the rest frame and `from_track_m` on the track. (The
// CP's own place would be one sample for a unit of shaft.)
void gather_friction(const Model& model, State& state, Vec3 from_m, float from_track_m);

// The shaft's CPs slip back to their limits, and store how far the tick pulls their springs. In
// this tick the needle moved by `moved_m` along itself.
void slip_shaft(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                float moved_m);

// Friction of a CP's tributary length, at its slip speed.
float friction_limit_n(const Model& model, const State& state, const Particle& p);

// Any CP may carry the friction of a whole unit; one with no friction yet may keep its force. But
// friction must not push the needle in the direction of its slip. If the tissue has followed the
// needle since a slip of this tick, the CP takes back as much of the slip, down to zero force.
// Else it would be at its limit again at the next slip, and that push would cost the hand nothing.
void slip_after_step(const Model& model, State& state, const Needle& needle, Particle& p);

}  // namespace stylet
