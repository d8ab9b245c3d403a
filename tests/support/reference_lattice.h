// SPDX-License-Identifier: Apache-2.0
// Slow reference of a free block of voxels in double precision: forces and the symplectic step.
//
// It goes through the voxels one by one, with reference_cluster.h. Units: SI. Frame: world, low
// corner at 0.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "reference_cluster.h"

namespace stylet::test {

struct ReferenceBlock {
  std::size_t size = 0;  // voxels along each edge
  ReferenceVoxel material;
  double corner_kg = 0;  // mass of one voxel's corner
  std::vector<Vec> place, velocity;
  std::vector<double> kg;

  std::size_t node(std::size_t x, std::size_t y, std::size_t z) const {
    return x + (size + 1) * (y + (size + 1) * z);
  }
};

inline std::array<std::size_t, 8> corners_of(const ReferenceBlock& block, std::size_t x,
                                             std::size_t y, std::size_t z) {
  std::array<std::size_t, 8> out = {};
  for (std::size_t i = 0; i < 8; ++i) {
    out[i] = block.node(x + (i & 1U), y + ((i >> 1U) & 1U), z + (i >> 2U));
  }
  return out;
}

template <typename Visit>
void for_each_voxel(const ReferenceBlock& block, Visit visit) {
  for (std::size_t z = 0; z < block.size; ++z) {
    for (std::size_t y = 0; y < block.size; ++y) {
      for (std::size_t x = 0; x < block.size; ++x) visit(corners_of(block, x, y, z));
    }
  }
}

inline ReferenceBlock reference_block(std::size_t size, const ReferenceVoxel& material,
                                      double corner_kg) {
  ReferenceBlock block;
  block.size = size;
  block.material = material;
  block.corner_kg = corner_kg;
  for (std::size_t z = 0; z <= size; ++z) {
    for (std::size_t y = 0; y <= size; ++y) {
      for (std::size_t x = 0; x <= size; ++x) {
        block.place.push_back(material.edge_m * Vec(static_cast<double>(x), static_cast<double>(y),
                                                    static_cast<double>(z)));
      }
    }
  }
  block.velocity.assign(block.place.size(), Vec::Zero());
  block.kg.assign(block.place.size(), 0);
  for_each_voxel(block, [&](const std::array<std::size_t, 8>& corners) {
    for (const std::size_t i : corners) block.kg[i] += corner_kg;
  });
  return block;
}

inline std::vector<Vec> block_forces(const ReferenceBlock& block) {
  std::vector<Vec> forces(block.place.size(), Vec::Zero());
  ReferenceVoxel voxel = block.material;
  for_each_voxel(block, [&](const std::array<std::size_t, 8>& corners) {
    for (std::size_t i = 0; i < 8; ++i) voxel.corner[i] = block.place[corners[i]];
    const VoxelForces f = voxel_forces(voxel);
    for (std::size_t i = 0; i < 8; ++i) forces[corners[i]] += f.corner[i];
  });
  return forces;
}

inline void step_block(ReferenceBlock& block, double step_s) {
  const std::vector<Vec> forces = block_forces(block);
  for (std::size_t i = 0; i < block.place.size(); ++i) {
    block.velocity[i] += step_s / block.kg[i] * forces[i];
    block.place[i] += step_s * block.velocity[i];
  }
}

}  // namespace stylet::test
