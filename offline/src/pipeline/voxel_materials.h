// SPDX-License-Identifier: GPL-3.0-or-later
// The materials of an organ, and the material of each voxel: that of its owner's tissue, of the
// layer that replaces it, or of the capsule.
#pragma once

#include "asset/materials.h"
#include "pipeline/build.h"
#include "voxels/layers.h"

namespace stylet::offline {

// Material numbers by tissue name, in order of first mention.
struct MaterialList {
  const std::vector<Tissue>& own;
  std::vector<Tissue> tissues;
};

// The number of `wanted`. A tissue may be listed twice: with its membrane and, in a layer, without.
std::uint8_t number_of(MaterialList& list, const Tissue& wanted);

// Materials by owner and by layer, numbered in order of first mention.
TissueNumbers number_tissues(const std::vector<std::string>& tissues, const BuildOptions& options,
                             double edge_m, MaterialList& list);

// For each voxel: its material, and the material before a capsule replaced it.
struct VoxelMaterials {
  std::vector<std::uint8_t> material, given;
};
VoxelMaterials voxel_materials(const Claims& claims, const Lattice& lattice,
                               const std::vector<std::uint16_t>& owner_of_voxel,
                               const std::vector<std::string>& tissues,
                               const TissueNumbers& numbers,
                               const std::vector<std::uint8_t>& layers, const BuildOptions& options,
                               MaterialList& list);

}  // namespace stylet::offline
