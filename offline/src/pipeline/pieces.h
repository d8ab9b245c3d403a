// SPDX-License-Identifier: GPL-3.0-or-later
// What is left of an input's separate pieces once they are voxels: pieces without a voxel of their
// own, and gaps that a voxel bridges. Only for reports. Units: metres.
#pragma once

#include "maps/groups.h"
#include "voxels/lattice.h"
#include "voxels/sample_parts.h"

namespace stylet::offline {

struct PieceCount {
  std::size_t pieces = 0;
  std::size_t lost = 0;  // pieces without a point in a voxel of their owner
};

// A piece of a mesh is connected through shared points, one of a map through any of 26 neighbours.
PieceCount mesh_pieces(const Claims& claims, std::uint16_t owner, const Mesh& surface_m);
std::vector<PieceCount> label_pieces(const Claims& claims, const LabelMap& map,
                                     const Groups& groups, std::size_t group_count);

// Number of voxels that hold parts which do not touch, and of neighbours whose parts do not touch:
// such parts stick together because they share particles.
std::size_t closed_gaps(const Claims& claims, const SamplePlaces& places);

}  // namespace stylet::offline
