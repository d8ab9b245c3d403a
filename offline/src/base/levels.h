// SPDX-License-Identifier: GPL-3.0-or-later
// Where the levels of an organ lie in its lattice: one after the other along z, an empty plane
// between two (kernel/schema/organ.fbs). `planes` is the number of voxel planes of level 0.
#pragma once

#include <cstdint>

namespace stylet::offline {

constexpr std::uint32_t first_plane(std::uint32_t planes, std::uint32_t level) {
  return level + planes * ((1U << level) - 1);
}

// The level that a plane of voxels belongs to.
constexpr std::uint32_t level_of_plane(std::uint32_t planes, std::uint32_t z) {
  std::uint32_t level = 0;
  while (z >= first_plane(planes, level + 1)) ++level;
  return level;
}

}  // namespace stylet::offline
