// SPDX-License-Identifier: GPL-3.0-or-later
// Fills gaps between organs with a tissue of their own: morphological closing of the kept cells,
// which adds what is narrower than a given width and leaves the outside where it is.
// Promise: no cell loses what it holds. Time: linear in cells times width.
#pragma once

#include "voxels/lattice.h"

namespace stylet::bake {

// Gaps up to `width_m`, in whole cells, become full cells of `owner`; cells of organs that are
// enclosed by now are
// filled up. Returns how many cells were added.
std::size_t fill_gaps(Claims& claims, double width_m, std::uint16_t owner);

}  // namespace stylet::bake
