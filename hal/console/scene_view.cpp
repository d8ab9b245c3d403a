// SPDX-License-Identifier: Apache-2.0
#include "hal/console/scene_view.h"

#include <limits>

#include "stylet/levels.h"

namespace stylet::console {
namespace {

constexpr std::uint32_t kUnnamed = std::numeric_limits<std::uint32_t>::max();

// Where a node lies at rest. z is its plane in the lattice, which also says its level.
stylet::Vec3 corner_at(const Organ& organ, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const std::uint32_t level = level_of(organ.level_planes, z);
  const float h = organ.voxel_edge_m * edge_ratio(level);
  const std::uint32_t above = z - first_plane(organ.level_planes, level);
  return {organ.origin_m.x + h * static_cast<float>(x),
          organ.origin_m.y + h * static_cast<float>(y),
          organ.origin_m.z + h * static_cast<float>(above)};
}

}  // namespace

Lattice make_lattice(const Organ& organ, const Kernel& kernel) {
  Lattice out;
  out.corners.resize(std::size_t{8} * organ.voxel_count);
  voxel_corners(kernel, out.corners);
  std::vector<std::uint32_t> number(particle_count(kernel), kUnnamed);
  std::size_t at = 0;
  for (const OrganRun& run : organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) {
      for (std::uint32_t c = 0; c < 8; ++c, ++at) {
        const std::uint32_t particle = out.corners[at];
        if (number[particle] == kUnnamed) {
          number[particle] = static_cast<std::uint32_t>(out.of_kernel.size());
          out.of_kernel.push_back(particle);
          out.rest_m.push_back(corner_at(organ, run.x + i + (c & 1U),
                                         run.y % organ.sheet_rows + ((c >> 1U) & 1U),
                                         run.z + ((c >> 2U) & 1U)));
        }
        out.corners[at] = number[particle];
      }
    }
  }
  return out;
}

}  // namespace stylet::console
