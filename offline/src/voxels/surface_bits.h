// SPDX-License-Identifier: GPL-3.0-or-later
// A surface in bits: what of it lies in each box of edge 1, with its area, middle and normal.
//
// Promises: the bits' areas add up to the surface's; deterministic. Units: those of the places.
#pragma once

#include <array>
#include <cmath>
#include <map>

#include "base/polygon.h"

namespace stylet::offline {

using SurfaceCell = std::array<std::int64_t, 3>;

struct SurfaceBit {
  double area = 0;
  Vec middle, normal;  // sums, weighted with areas

  void add(const SurfaceBit& other);
};
using SurfaceBits = std::map<SurfaceCell, SurfaceBit>;

Vec middle_of(const Polygon& polygon);

// Small bits join the largest one beside them that faces the same way.
void join_small(SurfaceBits& bits);

// Calls visit(index, part) for each slab of thickness 1 across an axis.
template <typename Visit>
void each_slab(const Polygon& polygon, std::size_t axis, Visit visit) {
  double low = polygon.front()[axis], high = low;
  for (const Vec& p : polygon) {
    low = std::min(low, p[axis]);
    high = std::max(high, p[axis]);
  }
  for (double at = std::floor(low); at <= high; at += 1) {
    // What lies in the plane between two slabs is only in the upper one.
    if (at == high && low < high) continue;
    const Polygon part = between(polygon, axis, at, at + 1);
    if (part.size() > 2) visit(static_cast<std::int64_t>(at), part);
  }
}

// Calls visit(SurfaceCell, part) for each box.
template <typename Visit>
void each_bit(const Polygon& polygon, Visit visit) {
  each_slab(polygon, 2, [&](std::int64_t z, const Polygon& slab) {
    each_slab(slab, 1, [&](std::int64_t y, const Polygon& bar) {
      each_slab(bar, 0, [&](std::int64_t x, const Polygon& part) {
        visit(SurfaceCell{x, y, z}, part);
      });
    });
  });
}

}  // namespace stylet::offline
