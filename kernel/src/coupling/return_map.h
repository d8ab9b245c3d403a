// SPDX-License-Identifier: Apache-2.0
// The return map: slip and cutting are one rule. The axial force of a constraint particle (CP) has
// a limit; beyond it the CP moves exactly so far that the force is back on the limit (passive for
// any step). The paper's moves whole needle units (section IV.C, step 3).
//
// Promises: a fixed number of operations. Units SI.
// Source: Simo and Hughes 1998, chapter 1 (return mapping in one dimension). PHYSICS 12.1 to 12.3.
#pragma once

#include "state/layout.h"

namespace stylet {

// Time constant of the low pass on slip velocities: they choose friction, never force directly.
constexpr float kSlipFilterS = 0.02F;
// Sliding this far renews the tissue a CP touches, and with it the relaxed part of its force.
constexpr float kRenewalLengthM = 1e-3F;
// At a tick's end CPs may carry so many times what they may where the needle has just moved.
constexpr float kEndTolerance = 2.0F;

// How far the CP must move for its axial force to come back between the limits. Paper mode: whole
// needle units, once the point is more than one unit away from its goal.
float overshoot(const Model& model, const Particle& p, float axial_n, float low_n, float high_n);

// A slip brings fresh tissue to the needle, which has relaxed nothing yet. The force stays: returns
// how much farther the CP slips for that, and books what the branch loses.
float renew(const Model& model, Particle& p, Vec3 direction, float slip_m, double& booked_j);

// A slip of this tick into the low-passed speed, by which friction is chosen.
void note_slip(const ModelHead& head, Particle& p, float slip_m);

// A part of that slip was none.
void note_no_slip(const ModelHead& head, Particle& p, float slip_m);

}  // namespace stylet
