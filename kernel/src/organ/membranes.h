// SPDX-License-Identifier: Apache-2.0
// Where a straight path in the rest frame first meets a membrane without a hole at that place.
//
// Promises: no allocation; at most kMaxMembraneSteps edges of the way, 27 cells of space (those of
// level 0) for each, kMaxTrianglesPerCell triangles in a cell, kMaxOpenings holes for each. Units:
// m. PHYSICS 9.7.
#pragma once

#include <span>

#include "stylet/organ.h"

namespace stylet {

// A hole that a tip has made: its place, and the normal and the material of the membrane there.
struct MembraneOpening {
  Vec3 at_m, normal;
  std::uint32_t material;
};

// `clear` is the part of the path before the membrane, or 1. Without a membrane, too, it is less
// than 1 if the path is longer than the length that is searched.
struct MembraneCrossing {
  float clear;
  std::uint32_t material;  // of the membrane; kNoTissue: none
  Vec3 at_m, normal;
};
// A membrane is open within `mouth_m` of its openings.
MembraneCrossing first_membrane(const Organ& organ, std::span<const MembraneOpening> openings,
                                float mouth_m, Vec3 from_m, Vec3 to_m);

}  // namespace stylet
