// SPDX-License-Identifier: Apache-2.0
// Where a straight way in the rest frame first meets a membrane that is whole there.
//
// Promises: no allocation; at most kMaxMembraneSteps edges of the way, 27 cells of space for each,
// kMaxTrianglesPerCell triangles in a cell, kMaxOpenings holes for each. Units: m. PHYSICS 9.7.
#pragma once

#include <span>

#include "stylet/organ.h"

namespace stylet {

// A hole that a tip has made: where, across which normal of the membrane, in which one.
struct MembraneOpening {
  Vec3 at_m, normal;
  std::uint32_t material;
};

// `clear` is the part of the way before the membrane, or 1. It is less without a membrane, too, if
// the way is longer than what is searched.
struct MembraneCrossing {
  float clear;
  std::uint32_t material;  // of the membrane; kNoTissue: none
  Vec3 at_m, normal;
};
// A membrane is open within `mouth_m` of its openings.
MembraneCrossing first_membrane(const Organ& organ, std::span<const MembraneOpening> openings,
                                float mouth_m, Vec3 from_m, Vec3 to_m);

}  // namespace stylet
