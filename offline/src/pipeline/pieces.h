// SPDX-License-Identifier: GPL-3.0-or-later
// What of the input's separate parts is left once they are voxels: pieces with no voxel of their
// own, and gaps that a voxel bridges. Only for reports. Units: metres.
#pragma once

#include "maps/groups.h"
#include "voxels/lattice.h"
#include "voxels/sample_parts.h"

namespace stylet::bake {

struct PieceCount {
  std::size_t pieces = 0;
  std::size_t lost = 0;  // none of whose points lies in a voxel of its owner
};

// Pieces of a mesh hang together through points, those of a map through any of 26 neighbours.
PieceCount mesh_pieces(const Claims& claims, std::uint16_t owner, const Mesh& surface_m);
std::vector<PieceCount> label_pieces(const Claims& claims, const LabelMap& map,
                                     const Groups& groups, std::size_t group_count);

// Voxels that hold parts which do not touch, and neighbours whose parts do not touch each other:
// sharing particles, they stick all the same.
std::size_t closed_gaps(const Claims& claims, const SamplePlaces& places);

}  // namespace stylet::bake
