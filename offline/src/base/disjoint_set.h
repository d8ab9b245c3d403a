// SPDX-License-Identifier: GPL-3.0-or-later
// Which things are connected: a forest in which two things are in one set if they have the same
// root. At the start every thing is its own parent. Time: nearly constant for each call.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace stylet::offline {

inline std::vector<std::uint32_t> each_by_itself(std::size_t count) {
  std::vector<std::uint32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0U);
  return parent;
}

inline std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// The smaller of the two roots becomes the root of both.
inline void join(std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t i = root_of(parent, a), j = root_of(parent, b);
  parent[std::max(i, j)] = std::min(i, j);
}

}  // namespace stylet::offline
