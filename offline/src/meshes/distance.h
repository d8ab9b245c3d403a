// SPDX-License-Identifier: GPL-3.0-or-later
// How far one surface lies from another: sample points are spread over the first, and CGAL's AABB
// tree finds the nearest point of the second for each. Deterministic. Units: metres.
#pragma once

#include "base/geometry.h"

namespace stylet::offline {

struct Deviation {
  double mean_m = 0;
  double most_m = 0;
  Vec where_m;  // where the deviation is `most_m`
  std::size_t samples = 0;
};

// Deviation of `from` from `to`; neither may be empty. Samples lie at corners and inside triangles,
// about equally dense. If `from` has many more triangles than kMostSamples, every n-th is sampled.
constexpr std::size_t kMostSamples = 100'000;
Deviation deviation(const Mesh& from, const Mesh& to);

}  // namespace stylet::offline
