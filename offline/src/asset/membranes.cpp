// SPDX-License-Identifier: GPL-3.0-or-later
#include "asset/membranes.h"

#include <map>

#include "base/polygon.h"

namespace stylet::offline {
namespace {

// Triangles this near to a cell count as touching it, in edges: more than the kernel searches
// beside a needle's way, plus the rounding of points to float.
constexpr double kTouch = 5e-3;

using Place = std::array<std::uint32_t, 4>;  // z, y, x, material
struct InCell {
  std::vector<std::size_t> triangles;  // numbers in the list of all
  double area = 0;                     // in squares of the edge
};
using Cells = std::map<Place, InCell>;

// Calls visit(index, part) for each cell along an axis that the polygon (in edges) touches.
template <typename Visit>
void for_each_cell(const Polygon& polygon, std::size_t axis, std::uint32_t size, Visit visit) {
  double low = polygon.front()[axis], high = low;
  for (const Vec& p : polygon) {
    low = std::min(low, p[axis]);
    high = std::max(high, p[axis]);
  }
  const double last = std::min(std::floor(high + kTouch), static_cast<double>(size) - 1);
  for (double at = std::max(0.0, std::floor(low - kTouch)); at <= last; at += 1) {
    const Polygon part = between(polygon, axis, at - kTouch, at + 1 + kTouch);
    if (!part.empty()) visit(static_cast<std::uint32_t>(at), part);
  }
}

// Enters a triangle in all cells that it touches.
void enter(const Polygon& triangle, std::size_t number, std::uint16_t material,
           const CellGrid& grid, Cells& cells) {
  for_each_cell(triangle, 2, grid.size[2], [&](std::uint32_t z, const Polygon& slab) {
    for_each_cell(slab, 1, grid.size[1], [&](std::uint32_t y, const Polygon& bar) {
      for_each_cell(bar, 0, grid.size[0], [&](std::uint32_t x, const Polygon& part) {
        InCell& cell = cells[{z, y, x, material}];
        cell.triangles.push_back(number);
        Polygon inside = between(part, 2, z, z + 1.0);
        inside = between(inside, 1, y, y + 1.0);
        cell.area += area_of(between(inside, 0, x, x + 1.0));
      });
    });
  });
}

}  // namespace

MembraneLists list_membranes(const std::vector<MembraneSurface>& surfaces, const CellGrid& grid) {
  MembraneLists lists;
  std::vector<OrganTriangle> all;
  Cells cells;
  for (const MembraneSurface& surface : surfaces) {
    const auto base = static_cast<std::uint32_t>(lists.points.size());
    for (const Vec& p : surface.mesh_m.points) {
      lists.points.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    for (const Triangle& t : surface.mesh_m.triangles) {
      Polygon corners;
      for (const std::uint32_t i : t) {
        corners.push_back((surface.mesh_m.points[i] - grid.origin_m) * (1 / grid.edge_m));
      }
      enter(corners, all.size(), surface.material, grid, cells);
      all.push_back({t[0] + base, t[1] + base, t[2] + base});
    }
  }
  for (const auto& [place, cell] : cells) {
    lists.cells.push_back(
        {static_cast<std::uint16_t>(place[2]), static_cast<std::uint16_t>(place[1]),
         static_cast<std::uint16_t>(place[0]), static_cast<std::uint16_t>(place[3]),
         static_cast<std::uint32_t>(lists.triangles.size()),
         static_cast<std::uint32_t>(cell.triangles.size()), static_cast<float>(cell.area)});
    for (const std::size_t number : cell.triangles) lists.triangles.push_back(all[number]);
  }
  return lists;
}

std::size_t most_in_a_cell(const MembraneLists& lists) {
  std::size_t most = 0, here = 0;
  for (std::size_t i = 0; i < lists.cells.size(); ++i) {
    const OrganMembraneCell& c = lists.cells[i];
    const OrganMembraneCell& before = lists.cells[i > 0 ? i - 1 : 0];
    const bool same = i > 0 && before.x == c.x && before.y == c.y && before.z == c.z;
    here = (same ? here : 0) + c.count;
    most = std::max(most, here);
  }
  return most;
}

double area_m2(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    sum += area_of({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]});
  }
  return sum;
}

}  // namespace stylet::offline
