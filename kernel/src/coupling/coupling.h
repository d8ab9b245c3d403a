// SPDX-License-Identifier: Apache-2.0
// Needle and tissue: constraint particles (CPs), puncture, cutting, slip, retraction.
//
// A CP is a material point of the tissue held by the needle (paper section IV.A). It is shared by
// the eight voxels whose centres surround it, with weights that change smoothly along its way, so
// that a tip running along a voxel face, or crossing one, is not felt; in paper mode it belongs to
// one voxel. Each voxel's fit includes its CPs exactly; ghost particles sit on their goals and drop
// out in closed form. Slip and cutting are one rule: a CP's axial force has a limit; beyond it the
// CP moves exactly so far that the force is back on the limit (passive for any step).
//
// A shaft CP stands for the stretch of track from its own place towards the tip, at most one needle
// unit: its friction grows from zero as the tip moves on and shrinks back to zero as the tip
// returns, so adding and removing one is never felt. Shaft CPs are a stack ordered along the track.
//
// Promises: bounded by limits.h, no allocation, fixed order. Units SI, world frame.
#pragma once

#include "coupling/fit.h"
#include "coupling/needle.h"
#include "lattice/voxel.h"

namespace stylet {

// Time constant of the low pass on slip velocities: they choose friction, never force directly.
constexpr float kSlipFilterS = 0.02F;
// Sliding this far renews the tissue a CP touches, and with it the relaxed part of its force.
constexpr float kRenewalLengthM = 1e-3F;

// Moves the CPs of this view's needle with it, lets them slip and cut, adds and removes; needs the
// goals of the last fit. Returns output flags.
std::uint32_t couple_needle(const View& view, const Needle& needle);

// Lets CPs slip and cut once more that the tissue has taken far beyond their limits in the
// substeps: dragged along by a fast tip it pushes a slipping shaft with many times its friction,
// and the hand would feel that. In the way it slips it does not push it at all.
void let_slip(const View& view, const Needle& needle);

// A bend before the tissue's step has moved the tip by so much, which its spring feels substep by
// substep, too.
void stretch_tip(const View& view, Vec3 moved_m);

// After a bend that has moved the tip by `moved_m`. A tip in contact that is thrown aside by it,
// farther than it was off when the tissue's step began, holds the tissue it lies in now, without
// force: the tangent it was held by says nothing of so long a way, and would let the needle drag
// tissue along for next to no work.
void throw_aside(const View& view, const Needle& needle, Vec3 moved_m);

// Leaves a shaft CP only those shares whose bits `kept` names, for there is no room for the others:
// their weight goes to these, at the same force. With none left it holds nothing, and nothing holds
// it. couple_needle gives shares back where there is room again.
void keep_shares(StateHead& state, Particle& p, std::uint32_t kept);

// The needle has turned: the give of a shaft CP is a way along it, and turns with it. Its spring is
// fixed to a point of the needle (grip), which a turn moves, and whose torque pays for it.
void turn_give(Particle& p, Vec3 direction);

// Friction of the stretch of shaft a CP stands for, at its slip speed.
float friction_limit_n(const View& view, const Particle& p);

// Energy of a CP's spring and its Maxwell branch.
double shaft_energy(const Particle& particle);
double tip_energy(const View& view, const Particle& tip);

// Sum over CPs and contacts of this view's needle: force and torque on its hand, by cause.
void sum_forces(const View& view, const Needle& needle, Output& out);

// Starts contact: the tip holds the surface point `rest_m` (rest frame), now at `place_m`. Only the
// `came_m` the tip moved forward this tick are pressed in: where it lies deeper (it has slid in
// over an edge, or the tissue has come to it) it holds the tissue it lies in, without force, for
// nobody has spent the work to press it there. One that lies deep behind the entry of a track is in
// that track again. One that has just left its track does not touch what it lies in there.
void begin_contact(const View& view, const Needle& needle, Vec3 rest_m, Vec3 place_m, float came_m);

void add_event(const View& view, EventKind kind, float force_n);

}  // namespace stylet
