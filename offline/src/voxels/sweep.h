// SPDX-License-Identifier: GPL-3.0-or-later
// How much a tick of an organ sweeps over, in voxels of a full block: by the kernel's own count.
//
// A step visits all that the kernel keeps of the lattice, and what an organ is like decides how
// much that is for each voxel: holes in rows, thin walls with nodes on both sides, parts that share
// cells. So it is the bytes of state that are counted, and two full blocks say what a voxel's are.
#pragma once

#include "voxels/lattice.h"

namespace stylet::bake {

double swept_voxels(const Organ& organ);
double swept_voxels(const Lattice& lattice);

}  // namespace stylet::bake
