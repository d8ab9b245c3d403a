// SPDX-License-Identifier: Apache-2.0
// Apart from layout.cpp because organ_open needs it, too.
#include <algorithm>

#include "layout.h"

namespace stylet {

Extent voxel_extent(const Organ& organ, std::uint32_t y, std::uint32_t z) {
  const auto before = [](const OrganRun& run, std::uint64_t key) {
    return ((static_cast<std::uint64_t>(run.z) << 16U) | run.y) < key;
  };
  const std::uint64_t key = (static_cast<std::uint64_t>(z) << 16U) | y;
  const auto first = std::lower_bound(organ.runs.begin(), organ.runs.end(), key, before);
  const auto last = std::lower_bound(first, organ.runs.end(), key + 1, before);
  if (first == last) return {0, 0};
  const OrganRun& end = *(last - 1);
  return {first->x, static_cast<std::uint32_t>(end.x) + end.count};
}

Extent node_extent(const Organ& organ, std::uint32_t y, std::uint32_t z) {
  Extent all = {0, 0};
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const std::uint32_t dy = corner & 1U, dz = corner >> 1U;
    if (y < dy || z < dz) continue;
    const Extent e = voxel_extent(organ, y - dy, z - dz);
    if (e.begin == e.end) continue;
    all = all.begin == all.end ? Extent{e.begin, e.end + 1}
                               : Extent{std::min(all.begin, e.begin), std::max(all.end, e.end + 1)};
  }
  return all;
}

}  // namespace stylet
