// SPDX-License-Identifier: Apache-2.0
// Springs of constraint particles (CPs): how stiff each is, so that lattice and spring together are
// as stiff as the needle in its tissue.
//
// A rigid body of the needle's radius in a half space or an endless body has a stiffness in closed
// form: the tip in contact that of cone.h, or of a skin on the tissue (film.h), the tip inside that
// of a sphere, a stretch of the shaft that of a cylinder. The lattice under a CP gives way by a
// part of it that goes by voxel, Poisson's ratio and place (measured, below); what is left is the
// spring's.
//
// Promises: bounded by limits.h, no allocation, fixed order. Units SI. PHYSICS 8.4, 11.
#pragma once

#include "lattice/voxel.h"
#include "laws/cone.h"

namespace stylet {

// Largest spring of a CP, in voxel springs k: stiffer changes nothing but the numbers' condition.
constexpr float kMaxCpWeight = 128.0F;

enum class Role { kSurface, kTip, kShaft };

// Gives a CP its spring, and what relaxes of it. Where the lattice alone is softer than what is
// wanted, the largest spring is taken and the shortfall reported.
void set_stiffness(const Model& model, State& state, Particle& particle, Role role);

// The law of the contact of this needle's tip. Its memory is the force that is missing over the
// spring's stiffness. The lattice gives way faster only as far as its part stays what it may be.
// Where it is too soft for a punch as wide as the needle, contact widens as the needle's tip does
// and ends at a width for which it is not.
ContactLaw law_of(const Model& model, const State& state);

}  // namespace stylet
