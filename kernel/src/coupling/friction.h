// SPDX-License-Identifier: Apache-2.0
// Friction between shaft and tissue: constraint particles (CPs) that stick and slip.
//
// A shaft CP stands for the stretch of track from its own place towards the tip, at most one needle
// unit: its friction grows from zero as the tip moves on and shrinks back to zero as the tip
// returns, so adding and removing one is never felt. The law is laws/friction.h's.
//
// Promises: bounded by kMaxConstraintParticles, no allocation, fixed order. Units SI.
// Source: paper section V (sticking and slipping). PHYSICS 12.1, 12.6.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Gives a CP the spring of the shaft it stands for: that and friction vanish when the tip comes
// back to it, so that neither friction nor clamping jumps when it is added or removed. What that
// costs is booked as friction.
void take_tributary_spring(const Model& model, State& state, Particle& p);

// The stretch a CP stands for may lie in several materials: its friction is their mean, taken on
// the way on which the tip passed it in this tick, from `from_m` in the rest frame and
// `from_track_m` on the track. (The CP's own place would be one sample of a unit of shaft.)
void gather_friction(const Model& model, State& state, Vec3 from_m, float from_track_m);

// The shaft's CPs slip back to their limits, and remember how far the tick pulls their springs.
void slip_shaft(const Model& model, State& state, Scratch& scratch, const Needle& needle);

// Friction of the stretch of shaft a CP stands for, at its slip speed.
float friction_limit_n(const Model& model, const State& state, const Particle& p);

// Any CP may carry the friction of a whole unit, and one that has met none yet what it has. But
// friction does not push the needle on the way it slips: one that has slipped in this tick takes
// back as much of that as the tissue has come after the needle since, until it carries nothing. At
// the next slip it would be at its limit again, and the hand would have the push for nothing.
void let_slip(const Model& model, State& state, const Needle& needle, Particle& p);

}  // namespace stylet
