// SPDX-License-Identifier: GPL-3.0-or-later
// Voxels in which two tissues meet, or tissue and none, each with a plane between the two.
//
// The lattice has one material a voxel, and its faces are stairs: what a needle meets would follow
// the voxel by half an edge. So the needle is told where in the voxel the other tissue begins, by a
// plane that divides the samples as they are divided, as in the piecewise linear interfaces of
// volume-of-fluid methods (Rider and Kothe 1998). Tried before: a bit for each of 4 x 4 x 4
// quarters, whose stairs still moved friction by a tenth. A voxel keeps its own material and one
// other, the one most of the other samples have; a third counts as its own. Of voxels that share a
// cell, each has its own samples, and beyond its plane there is none. Time and memory: linear in
// the cells. Units: metres; in a cell, edges.
#pragma once

#include <vector>

#include "voxels/layers.h"
#include "voxels/sample_parts.h"

namespace stylet::bake {

struct VoxelTissues {
  const std::vector<std::uint16_t>& owner;    // of each voxel
  const std::vector<std::uint8_t>& material;  // of each voxel
  const std::vector<std::uint8_t>& layers;    // of each cell; empty: no layers
};

// Sorted by voxel.
std::vector<OrganMixed> mixed_voxels(const Claims& claims, const SamplePlaces& places,
                                     const Lattice& lattice, const VoxelTissues& tissues,
                                     const TissueNumbers& numbers);

}  // namespace stylet::bake
