// SPDX-License-Identifier: Apache-2.0
// Which slots send forces to which particles: the part of the lattice sweep that is irregular,
// worked out once so that the sweep walks a flat list.
//
// A window is a group of lanes: neighbouring nodes of one line (y) of a voxel plane. It collects
// from the two voxel rows at either side, y - 1 and y, whose ends need not agree: a bit for each
// lane says which of them has a voxel there.
//
// Promises: bounded by the lattice's extent; no allocation. At creation only.
#pragma once

#include <algorithm>

#include "layout.h"

namespace stylet {

// Bits of the lanes from node `x` on that belong to the nodes of voxels `row`.
inline std::uint16_t lanes_of(Extent row, std::uint32_t x, std::uint32_t width) {
  std::uint32_t bits = 0;
  for (std::uint32_t lane = 0; lane < width && row.begin != row.end; ++lane) {
    if (x + lane >= row.begin && x + lane <= row.end) bits |= 1U << lane;
  }
  return static_cast<std::uint16_t>(bits);
}

// Calls visit(x, lanes of the row before, lanes of the row behind) for each window of `width` nodes
// between two voxel rows that holds a node of either.
template <typename Visit>
void for_each_window(Extent before, Extent behind, std::uint32_t width, Visit visit) {
  if (before.begin == before.end && behind.begin == behind.end) return;
  if (before.begin == before.end) before = {behind.begin, behind.begin};
  if (behind.begin == behind.end) behind = {before.begin, before.begin};
  const std::uint32_t last = std::max(before.end, behind.end);
  for (std::uint32_t x = std::min(before.begin, behind.begin); x <= last; x += width) {
    const std::uint16_t one = lanes_of(before, x, width), other = lanes_of(behind, x, width);
    if ((one | other) != 0) visit(x, one, other);
  }
}

// Windows of all planes, for either width; needs planes and rows.
void fill_windows(const ModelView& model);

}  // namespace stylet
