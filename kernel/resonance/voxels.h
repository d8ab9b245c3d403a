// SPDX-License-Identifier: Apache-2.0
// Voxels and coordinates as the estimate of the first resonance has them (stylet/resonance.h).
//
// Units: SI; places and edges of voxels in edges of the finest level.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <vector>

#include "state/layout.h"

namespace stylet {

using Shapes = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // three shapes at a time

struct CoarseCell {
  std::int32_t x, y, z;
  auto operator<=>(const CoarseCell&) const = default;
};

// A voxel of the kernel's lattice.
struct Voxel {
  CoarseCell at;
  std::int32_t edge;
  double k_n_per_m, volume_ratio;
  std::array<std::uint32_t, 8> corner;  // particles, at x + bit 0, y + bit 1, z + bit 2
};

inline std::int32_t coarsest_edge(const Model& model) {
  return 1 << (model.head->counts.levels - 1);
}

inline Eigen::Index dof(std::uint32_t of, int axis) {
  return 3 * static_cast<Eigen::Index>(of) + axis;
}

}  // namespace stylet
