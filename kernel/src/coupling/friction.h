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
// to the CP, so no force jumps when a CP is added or removed. The energy lost by the change of
// spring is booked as friction.
void take_tributary_spring(const Model& model, State& state, Particle& p);

// A tributary length may lie in several materials: its friction is their mean, sampled where the
// tip passed in this tick, from `from_m` in the rest frame and `from_track_m` on the track. (The
// CP's own place would be one sample for a unit of shaft.)
void gather_friction(const Model& model, State& state, Vec3 from_m, float from_track_m);

// The shaft's CPs slip back to their limits, and store by how much this tick stretches their
// springs. The needle has moved by `moved_m` along itself in this tick.
void slip_shaft(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                float moved_m);

// Friction of a CP's tributary length, at its slip speed.
float friction_limit_n(const Model& model, const State& state, const Particle& p);

// After the step of the tissue a CP may carry the friction of a whole unit; a CP without friction
// so far may keep its force. But friction must not push the needle in the direction of its slip. As
// far as the tissue has followed the needle since a slip of this tick, the CP takes its slip back,
// until it carries no force. Otherwise the next slip would begin at the limit again, and the hand
// would get that push for nothing.
void slip_after_step(const Model& model, State& state, const Needle& needle, Particle& p);

}  // namespace stylet
