// SPDX-License-Identifier: Apache-2.0
#include "organ/runs.h"

#include <algorithm>

namespace stylet {
namespace {

// For a run's end, which may be beyond 65 535.
constexpr std::uint64_t order_of_end(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return (static_cast<std::uint64_t>(z) << 40U) | (static_cast<std::uint64_t>(y) << 20U) | x;
}

}  // namespace

bool has_voxel(const Organ& organ, Extent x, std::uint32_t y, std::uint32_t z) {
  const auto ends_before = [](const OrganRun& run, std::uint64_t place) {
    return order_of_end(static_cast<std::uint32_t>(run.x) + run.count, run.y, run.z) <= place;
  };
  const auto run = std::lower_bound(organ.runs.begin(), organ.runs.end(),
                                    order_of_end(x.begin, y, z), ends_before);
  return run != organ.runs.end() && run->y == y && run->z == z && run->x < x.end;
}

bool has_node(const Organ& organ, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const Extent beside = {x > 0 ? x - 1 : 0, x + 1};
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const std::uint32_t dy = corner & 1U, dz = corner >> 1U;
    if (y >= dy && z >= dz && has_voxel(organ, beside, y - dy, z - dz)) return true;
  }
  return false;
}

}  // namespace stylet
