// SPDX-License-Identifier: GPL-3.0-or-later
// How far one surface lies from another: distances of sample points spread over it (CGAL's AABB
// tree finds the nearest point). Deterministic. Units: metres.
#pragma once

#include "base/geometry.h"

namespace stylet::bake {

struct Deviation {
  double mean_m = 0;
  double most_m = 0;
  Vec where_m;  // of the most
  std::size_t samples = 0;
};

// Of `from` from `to`; neither empty. Samples lie at the corners and inside of triangles, about as
// dense everywhere; a mesh of many more triangles than kMostSamples is sampled at every n-th.
constexpr std::size_t kMostSamples = 100'000;
Deviation deviation(const Mesh& from, const Mesh& to);

}  // namespace stylet::bake
