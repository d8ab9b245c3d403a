// SPDX-License-Identifier: Apache-2.0
// The spring of a tip in contact: the law of stiffness.h, its chord or tangent, and its creep.
//
// Promises: a fixed number of operations. Units SI, frame of the attachments.
// Source: cone.h and film.h for the law. PHYSICS 8.5, 8.6.
#pragma once

#include "coupling/stiffness.h"
#include "state/layout.h"

namespace stylet {

// Energy of the contact. The present spring carries the spread of the supports.
double contact_energy(const Model& model, const State& state, const Particle& p);

// Lets the contact of a needle that has moved by `step_m` creep, and then sets its spring. The
// force lost to creep is bounded so that tissue can release the tip but not pull it.
void relax_contact(const Model& model, State& state, Vec3 direction, Vec3 step_m);

// A contact pressed on by more than this in a tick has the law's chord as spring, not its tangent.
constexpr float kChordM = 1e-5F;
// Energy of the tip's spring and its Maxwell branch, in contact and in tissue.
double tip_energy(const Model& model, const State& state, const Particle& tip);

}  // namespace stylet
