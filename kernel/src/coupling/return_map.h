// SPDX-License-Identifier: Apache-2.0
// The return map, the one rule of slip and cutting. The axial force of a constraint particle (CP)
// has a limit; beyond it the CP moves just so far that the force is back at the limit, which is
// passive for any step. In the paper a CP moves by whole needle units (section IV.C, step 3).
//
// Promises: a fixed number of operations. Units SI.
// Source: Simo and Hughes 1998, chapter 1 (return mapping in one dimension). PHYSICS 12.1 to 12.3.
#pragma once

#include "state/layout.h"

namespace stylet {

// Time constant of the low pass of slip speeds. They set the limit of friction.
constexpr float kSlipFilterS = 0.02F;
// Sliding this far renews the tissue that a CP touches, and so the relaxed part of its force.
constexpr float kRenewalLengthM = 1e-3F;
// At the end of a tick in which the needle has moved, a CP may carry this many times its limit.
constexpr float kEndTolerance = 2.0F;

// How far the CP must move for its axial force to return between the limits. Paper mode: by whole
// needle units, once the point is more than one unit away from its goal.
float overshoot(const Model& model, const Particle& p, float axial_n, float low_n, float high_n);

// A slip brings fresh tissue to the needle, which has not relaxed yet. The force stays. Returns how
// much farther the CP must slip for that, and books the energy that the branch loses. The way that
// renews is all of it, what the renewal adds included, but no longer than the slip or than what the
// needle `moved_m` in the tick: tissue that has crept a renewal length or more would run away.
float renew(const Model& model, Particle& p, Vec3 direction, float slip_m, float moved_m,
            double& booked_j);

// Adds a slip of this tick to the low-passed speed, which chooses the friction.
void note_slip(const ModelHead& head, Particle& p, float slip_m);

// Takes a part of that slip back out.
void note_no_slip(const ModelHead& head, Particle& p, float slip_m);

}  // namespace stylet
