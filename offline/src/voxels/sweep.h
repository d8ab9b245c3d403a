// SPDX-License-Identifier: GPL-3.0-or-later
// How much state a tick of an organ visits, counted by the kernel, in voxels of a full block.
//
// A step visits all that the kernel keeps of the lattice. How much that is per voxel depends on the
// organ: holes in rows, thin walls with nodes on both sides, parts that share cells. So the bytes
// of state are counted; two full blocks tell how many bytes one voxel has.
#pragma once

#include "voxels/lattice.h"

namespace stylet::offline {

double swept_voxels(const Organ& organ);
double swept_voxels(std::span<const Lattice> levels);

}  // namespace stylet::offline
