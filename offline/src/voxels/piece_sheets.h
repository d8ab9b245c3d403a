// SPDX-License-Identifier: GPL-3.0-or-later
// Gives pieces of a lattice with levels sheets of their own where they are near each other.
//
// Where there are finer voxels, the kernel moves all that lies in a coarser cell of a sheet by the
// nodes of that cell (kernel/decisions/31). Two pieces that do not hang together must not be moved
// by the same nodes: then a push on one would move the other. They are near each other if they have
// finer voxels in cells of level 0 that touch.
//
// Promises: pieces stay as they are; only sheets, rows and the voxels' order change. If there are
// not enough sheets, the smallest pieces share one. Time: n log n in the voxels.
#pragma once

#include <vector>

#include "voxels/lattice.h"

namespace stylet::offline {

// Lattices of an organ whose parts have been split (voxels/sheets.h).
void keep_pieces_apart(std::vector<Lattice>& levels);

}  // namespace stylet::offline
