// SPDX-License-Identifier: Apache-2.0
// Springs of constraint particles (CPs): how stiff each must be for lattice and spring together to
// be as stiff as the needle in its tissue.
//
// A rigid body of the needle's radius in a half space or an endless body has a stiffness in closed
// form: for a tip in contact that of cone.h, or of a skin on the tissue (film.h); for a tip inside
// that of a sphere, or of a membrane that it stretches; for a piece of shaft that of a cylinder.
// The lattice under a CP provides a part of that compliance, which depends on voxel, Poisson's
// ratio and place (measured, below). The spring provides the rest.
//
// Promises: bounded by limits.h, no allocation, fixed order. Units SI. PHYSICS 8.4, 11.
#pragma once

#include "lattice/voxel.h"
#include "laws/cone.h"

namespace stylet {

// Largest spring of a CP, in voxel springs k: a stiffer one would change only the rounding.
constexpr float kMaxCpWeight = 128.0F;

// kMembrane: a tip that a membrane of its material holds.
enum class Role { kSurface, kTip, kMembrane, kShaft };

// Gives a CP its spring and its relaxing part. Where the lattice alone is softer than required, it
// gets the largest spring, and the shortfall is reported.
void set_stiffness(const Model& model, State& state, Particle& particle, Role role);

// The law of contact of this needle's tip. The tip's memory is the force lost to creep over the
// stiffness of the spring. The growth of the lattice's compliance ends where its part of the whole
// would become too large. If the lattice is too soft for a punch as wide as the needle, contact
// widens like the needle's tip and ends at a width for which the lattice is stiff enough.
ContactLaw law_of(const Model& model, const State& state);

}  // namespace stylet
