// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps only a part of an organ: what is cut away costs no time in a tick, and what is left is held
// where it was cut. Units: metres.
#pragma once

#include <vector>

#include "voxels/attach.h"
#include "voxels/lattice.h"

namespace stylet::offline {

// Regions of "--crop": half-spaces and boxes; refuses "touching:MESH" and "none".
std::vector<Region> parse_crop(const std::vector<std::string>& texts);

// One byte per cell; 1 if it is cut away, because its middle is not in all of the regions. Empty
// without regions.
std::vector<std::uint8_t> cut_cells(const Grid& grid, const Box& extent_m,
                                    const std::vector<Region>& regions);

// The triangles of a surface that have all their points in remaining cells, and these points.
Mesh crop_surface(Mesh surface_m, const Grid& grid, const std::vector<std::uint8_t>& cut);

// Marks the corners of cells that were cut away in `held`, which is as from held_corners.
void hold_cut(const Claims& claims, const std::vector<std::uint8_t>& cut,
              std::vector<std::uint8_t>& held);

}  // namespace stylet::offline
