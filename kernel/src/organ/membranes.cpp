// SPDX-License-Identifier: Apache-2.0
#include "organ/membranes.h"

#include <algorithm>

#include "organ/triangle.h"
#include "stylet/limits.h"

namespace stylet {
namespace {

// Cells this near to the way are searched, in edges; a triangle counts this far beyond its rim, in
// parts of its sides. So no rounding lets a tip through between two triangles or two cells.
constexpr float kNearEdges = 1e-3F, kRim = 1e-4F;

struct Way {
  Vec3 from_m, direction;
  float length_m;
};

// Crossings of the triangles of one cell that are nearer than the one found so far.
void test_cell(const Organ& organ, const OrganMembraneCell& cell, const Way& way, float& at_m,
               std::uint32_t& material) {
  const auto point = [&](std::uint32_t i) {
    const OrganPoint& p = organ.membrane_points[i];
    return Vec3{p.x, p.y, p.z};
  };
  for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i) {
    const OrganTriangle& t = organ.membrane_triangles[i];
    float along_m = -1, u = -1, v = -1;
    (void)hit_triangle(way.from_m, way.direction, point(t.a), point(t.b), point(t.c), along_m, u,
                       v);
    const bool inside = u >= -kRim && v >= -kRim && u + v <= 1 + kRim;
    if (!inside || !(along_m >= 0 && along_m < at_m)) continue;
    at_m = along_m;
    material = cell.material;
  }
}

std::uint64_t order_of(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return (z << 32U) | (y << 16U) | x;
}

// All membranes of a cell of space.
void test_place(const Organ& organ, std::uint64_t place, const Way& way, float& at_m,
                std::uint32_t& material) {
  const auto before = [](const OrganMembraneCell& cell, std::uint64_t at) {
    return order_of(cell.x, cell.y, cell.z) < at;
  };
  const auto end = organ.membrane_cells.end();
  auto cell = std::lower_bound(organ.membrane_cells.begin(), end, place, before);
  for (; cell != end && order_of(cell->x, cell->y, cell->z) == place; ++cell) {
    test_cell(organ, *cell, way, at_m, material);
  }
}

// First and last cell of a stretch along an axis, of `size` cells; none if last < first.
struct Cells {
  std::int32_t first, last;
};
Cells cells_of(float a_m, float b_m, float origin_m, float edge_m, std::uint32_t size) {
  const float low = (std::min(a_m, b_m) - origin_m) / edge_m - kNearEdges;
  const float high = (std::max(a_m, b_m) - origin_m) / edge_m + kNearEdges;
  const auto most = static_cast<float>(size);
  if (!(high >= 0 && low < most)) return {0, -1};
  return {static_cast<std::int32_t>(std::max(low, 0.0F)),
          static_cast<std::int32_t>(std::min(high, most - 1))};
}

}  // namespace

MembraneCrossing first_membrane(const Organ& organ, Vec3 from_m, Vec3 to_m) {
  const Vec3 whole = to_m - from_m;
  const float length_m = norm(whole), edge_m = organ.voxel_edge_m;
  if (!(length_m > 0) || !is_finite(length_m)) return {1, kNoTissue};
  constexpr auto kMost = static_cast<float>(kMaxMembraneSteps);
  const float searched_m = min_of(length_m, kMost * edge_m);
  const Way way = {from_m, (1 / length_m) * whole, length_m};
  for (std::uint32_t step = 0; step < kMaxMembraneSteps; ++step) {
    const float from = static_cast<float>(step) * edge_m;
    if (!(from < searched_m)) break;
    const Vec3 a = from_m + from * way.direction;
    const Vec3 b = from_m + min_of(from + edge_m, searched_m) * way.direction;
    const Vec3& o = organ.origin_m;
    const Cells x = cells_of(a.x, b.x, o.x, edge_m, organ.size_x);
    const Cells y = cells_of(a.y, b.y, o.y, edge_m, organ.sheet_rows);
    const Cells z = cells_of(a.z, b.z, o.z, edge_m, organ.size_z);
    // A triangle of these cells may also cross the way farther on, behind others.
    const float end = from + (1 + kNearEdges) * edge_m;
    float at_m = min_of(end, searched_m);
    std::uint32_t material = kNoTissue;
    for (std::int32_t k = z.first; k <= z.last; ++k) {
      for (std::int32_t j = y.first; j <= y.last; ++j) {
        for (std::int32_t i = x.first; i <= x.last; ++i) {
          test_place(organ,
                     order_of(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(j),
                              static_cast<std::uint64_t>(k)),
                     way, at_m, material);
        }
      }
    }
    if (material != kNoTissue) return {at_m / length_m, material};
  }
  return {searched_m < length_m ? searched_m / length_m : 1, kNoTissue};
}

}  // namespace stylet
