// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes of finer voxels that lie on the surface of coarser ones, with which they move
// (kernel/schema/organ.fbs); and the lattice of all levels as the file has it. Each such node hangs
// on the coarsest voxel that it touches: so all voxels around the node agree on where it is.
//
// Places are those of the organ's lattice. Time and memory: linear in the cells of all levels.
#pragma once

#include <span>
#include <vector>

#include "voxels/lattice.h"

namespace stylet::offline {

struct LatticeSize {
  std::uint32_t x, rows, z;  // rows of one sheet
};
LatticeSize lattice_size(std::span<const Lattice> levels);
std::vector<OrganRun> runs_of(std::span<const Lattice> levels);
std::vector<OrganTie> ties_of(std::span<const Lattice> levels);
std::vector<OrganPart> parts_of(std::span<const Lattice> levels);

// Sorted by z, y, x. Where parts were split, their lattices say what hangs.
std::vector<OrganHanging> hanging_nodes(std::span<const Lattice> levels);

}  // namespace stylet::offline
