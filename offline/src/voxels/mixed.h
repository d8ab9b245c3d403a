// SPDX-License-Identifier: GPL-3.0-or-later
// Voxels in which two tissues meet, or tissue and empty space, each with a plane between the two.
//
// The lattice has one material per voxel, and its faces are stairs: a needle would meet a tissue up
// to half an edge from its true place. So the file tells the needle where in the voxel the other
// tissue begins, by a plane with as many samples on each side as the tissues have, like the
// piecewise linear interfaces of volume-of-fluid methods (Rider and Kothe 1998). Tried before: one
// bit per sub-sample (4 x 4 x 4), whose stairs still changed friction by a tenth. A voxel keeps its
// own material and the one that most of its other samples have; samples of a third material count
// as the voxel's own. Voxels that share a cell have their own samples each; beyond their planes is
// no tissue. Time and memory: linear in the cells. Units: metres; in a cell, edges.
#pragma once

#include <vector>

#include "voxels/layers.h"
#include "voxels/sample_parts.h"

namespace stylet::offline {

struct VoxelTissues {
  const std::vector<std::uint16_t>& owner;    // of each voxel
  const std::vector<std::uint8_t>& material;  // of each voxel
  const std::vector<std::uint8_t>& layers;    // of each cell; empty: no layers
};

// Sorted by voxel.
std::vector<OrganMixed> mixed_voxels(const Claims& claims, const SamplePlaces& places,
                                     const Lattice& lattice, const VoxelTissues& tissues,
                                     const TissueNumbers& numbers);

}  // namespace stylet::offline
