// SPDX-License-Identifier: Apache-2.0
// Where a straight way in the rest frame first meets a membrane.
//
// Promises: no allocation; at most kMaxMembraneSteps edges of the way, 27 cells of space for each,
// kMaxTrianglesPerCell triangles in a cell. Units: m. PHYSICS 9.7.
#pragma once

#include "stylet/organ.h"

namespace stylet {

// `clear` is the part of the way before the membrane, or 1. It is less without a membrane, too, if
// the way is longer than what is searched.
struct MembraneCrossing {
  float clear;
  std::uint32_t material;  // of the membrane; kNoTissue: none
};
MembraneCrossing first_membrane(const Organ& organ, Vec3 from_m, Vec3 to_m);

}  // namespace stylet
