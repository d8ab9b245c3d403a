// SPDX-License-Identifier: GPL-3.0-or-later
// The sphere tree over an embedded surface (Quinlan 1994: leaves cover triangles, inner nodes halve
// their set). All triangles of a leaf have one voxel, so that a leaf can follow its deformation.
//
// Promises: a sphere, as rounded to floats, contains all positions below it and its children's
// spheres; children come after parents; depth at most 2 + log2(leaves). Units: metres, rest frame.
#pragma once

#include "base/geometry.h"
#include "stylet/organ.h"

namespace stylet::offline {

struct SphereTree {
  std::vector<OrganSphere> nodes;    // root first, children side by side
  std::vector<std::uint32_t> order;  // triangle i of the file is triangle order[i] of the input
};

// `voxel_of[i]` is the voxel of triangle i.
SphereTree sphere_tree(const std::vector<Vec>& points_m, const std::vector<Triangle>& triangles,
                       const std::vector<std::uint32_t>& voxel_of);

}  // namespace stylet::offline
