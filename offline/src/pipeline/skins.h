// SPDX-License-Identifier: GPL-3.0-or-later
// How much of an organ's surface lies in each voxel that has a skin. Voxels at a surface that runs
// askew through the lattice lie behind each other like stairs: if the skin were whole in each of
// them, it would count up to twice.
// Units: lengths in m; areas in squares of the voxel's edge. Frame: that of the lattice.
#pragma once

#include <span>
#include <vector>

#include "asset/materials.h"
#include "base/geometry.h"
#include "stylet/organ.h"
#include "voxels/lattice.h"

namespace stylet::offline {

// For the voxels that the surface touches and whose material has a skin, sorted by voxel.
// `material_of_voxel` counts through all levels. The area that several such voxels share, because
// they lie in the same cell, is divided evenly. Surfaces of several bodies in a voxel add up, also
// where they touch (PHYSICS 18.4).
std::vector<OrganSkin> place_skins(const Mesh& surface_m, std::span<const Lattice> levels,
                                   std::span<const std::uint8_t> material_of_voxel,
                                   const std::vector<Tissue>& materials);

}  // namespace stylet::offline
