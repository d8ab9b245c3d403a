// SPDX-License-Identifier: GPL-3.0-or-later
// Fills gaps between organs with a separate tissue, by morphological closing of the kept cells: it
// fills what is narrower than a given width and does not move the outside.
// Promise: no cell loses what it contains. Time: linear in cells times width.
#pragma once

#include "voxels/lattice.h"

namespace stylet::offline {

// Gaps up to `width_m`, in whole cells, become full cells of `owner`. Partly filled cells of organs
// that are then enclosed are filled up.
// Returns how many cells were added.
std::size_t fill_gaps(Claims& claims, double width_m, std::uint16_t owner);

}  // namespace stylet::offline
