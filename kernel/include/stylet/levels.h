// SPDX-License-Identifier: Apache-2.0
// Levels of a graded lattice, each with half the voxel edge of the one before: where they lie. They
// are stored one after the other along z, an empty plane between two, so that a plane has one edge.
//
// In space all levels begin at the origin. `planes`: voxel planes of level 0 (Organ::level_planes);
// an organ of one level has all its planes there.
#pragma once

#include <cstdint>

#include "stylet/limits.h"

namespace stylet {

// Where a level begins in the lattice. The planes of nodes above it end before the next level.
constexpr std::uint32_t first_plane(std::uint32_t planes, std::uint32_t level) {
  return level + planes * ((1U << level) - 1);
}

// Level of plane z of the lattice, of voxels or nodes.
constexpr std::uint32_t level_of(std::uint32_t planes, std::uint32_t z) {
  std::uint32_t level = 0;
  for (std::uint32_t next = 1; next < kMaxLevels; ++next) {
    if (z >= first_plane(planes, next)) level = next;
  }
  return level;
}

// The edge of a level's voxels, over that of level 0: exact.
constexpr float edge_ratio(std::uint32_t level) {
  return 1.0F / static_cast<float>(1U << level);
}

}  // namespace stylet
