// SPDX-License-Identifier: Apache-2.0
#include "organ/membranes.h"

#include <algorithm>

#include "organ/runs.h"
#include "organ/triangle.h"
#include "stylet/limits.h"

namespace stylet {
namespace {

// Cells this near to the way are searched, in edges; a triangle counts this far beyond its rim, in
// parts of its sides. So no rounding lets a tip through between two triangles or two cells.
constexpr float kNearEdges = 1e-3F, kRim = 1e-4F;

// An opening is one of the sheet that it was made in: within this slope of its plane, and this far
// beside it, for rounding. So another fold close behind it is whole.
constexpr float kSheetSlope = 0.25F, kSheetM = 1e-5F;

struct Way {
  Vec3 from_m, direction;
  float length_m;
  std::span<const MembraneOpening> openings;
  float mouth_m;
};

// The nearest crossing found so far.
struct Crossing {
  float at_m;
  std::uint32_t material;
  Vec3 normal;
};

bool is_open(const Way& way, Vec3 at_m, std::uint32_t material) {
  for (const MembraneOpening& hole : way.openings) {
    const Vec3 off = at_m - hole.at_m;
    const float beside_m = dot(off, hole.normal), off_m = norm(off);
    const float most_m = kSheetM + kSheetSlope * off_m;
    const bool same_sheet = beside_m <= most_m && beside_m >= -most_m;
    if (hole.material == material && off_m <= way.mouth_m && same_sheet) return true;
  }
  return false;
}

// Crossings of the triangles of one cell that are nearer than the one found so far.
void test_cell(const Organ& organ, const OrganMembraneCell& cell, const Way& way, Crossing& found) {
  const auto point = [&](std::uint32_t i) {
    const OrganPoint& p = organ.membrane_points[i];
    return Vec3{p.x, p.y, p.z};
  };
  for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i) {
    const OrganTriangle& t = organ.membrane_triangles[i];
    const Vec3 a = point(t.a), b = point(t.b), c = point(t.c);
    float along_m = -1, u = -1, v = -1;
    (void)hit_triangle(way.from_m, way.direction, a, b, c, along_m, u, v);
    const bool inside = u >= -kRim && v >= -kRim && u + v <= 1 + kRim;
    if (!inside || !(along_m >= 0 && along_m < found.at_m)) continue;
    if (is_open(way, way.from_m + along_m * way.direction, cell.material)) continue;
    const Vec3 across = cross(b - a, c - a);
    found = {along_m, cell.material, (1 / norm(across)) * across};
  }
}

// All membranes of a cell of space.
void test_place(const Organ& organ, std::uint64_t place, const Way& way, Crossing& found) {
  const auto before = [](const OrganMembraneCell& cell, std::uint64_t at) {
    return order_of(cell) < at;
  };
  const auto end = organ.membrane_cells.end();
  auto cell = std::lower_bound(organ.membrane_cells.begin(), end, place, before);
  for (; cell != end && order_of(*cell) == place; ++cell) {
    test_cell(organ, *cell, way, found);
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

MembraneCrossing first_membrane(const Organ& organ, std::span<const MembraneOpening> openings,
                                float mouth_m, Vec3 from_m, Vec3 to_m) {
  const Vec3 whole = to_m - from_m;
  const float length_m = norm(whole), edge_m = organ.voxel_edge_m;
  if (!(length_m > 0) || !is_finite(length_m)) return {1, kNoTissue, to_m, {}};
  constexpr auto kMost = static_cast<float>(kMaxMembraneSteps);
  const float searched_m = min_of(length_m, kMost * edge_m);
  const Way way = {from_m, (1 / length_m) * whole, length_m, openings, mouth_m};
  for (std::uint32_t step = 0; step < kMaxMembraneSteps; ++step) {
    const float from = static_cast<float>(step) * edge_m;
    if (!(from < searched_m)) break;
    const Vec3 a = from_m + from * way.direction;
    const Vec3 b = from_m + min_of(from + edge_m, searched_m) * way.direction;
    const Vec3& o = organ.origin_m;
    const Cells x = cells_of(a.x, b.x, o.x, edge_m, organ.size_x);
    const Cells y = cells_of(a.y, b.y, o.y, edge_m, organ.sheet_rows);
    const Cells z = cells_of(a.z, b.z, o.z, edge_m, organ.level_planes);
    // A triangle of these cells may also cross the way farther on, behind others.
    const float end = from + (1 + kNearEdges) * edge_m;
    Crossing found = {min_of(end, searched_m), kNoTissue, {}};
    for (std::int32_t k = z.first; k <= z.last; ++k) {
      for (std::int32_t j = y.first; j <= y.last; ++j) {
        for (std::int32_t i = x.first; i <= x.last; ++i) {
          test_place(organ,
                     order_of(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                              static_cast<std::uint32_t>(k)),
                     way, found);
        }
      }
    }
    if (found.material == kNoTissue) continue;
    return {found.at_m / length_m, found.material, from_m + found.at_m * way.direction,
            found.normal};
  }
  const float clear = searched_m < length_m ? searched_m / length_m : 1;
  return {clear, kNoTissue, from_m + searched_m * way.direction, {}};
}

}  // namespace stylet
