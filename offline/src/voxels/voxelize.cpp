// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/voxelize.h"

#include <numeric>

#include "base/refusal.h"
#include "voxels/sample_cell.h"

namespace stylet::offline {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

// ---- triangle and cube --------------------------------------------------------------------------

// The thirteen separating axes of a triangle and a cube, with the triangle's extent along each.
struct SeparatingAxes {
  struct Axis {
    Vec direction;
    double low, high;
    double inverse_reach;  // 1 / sum of |components|: extent of a cube of half edge 1
  };
  std::array<Axis, 13> axes;
  std::size_t count = 0;
  Vec base;  // coordinates are relative to this point, which keeps rounding small
};

void add_axis(SeparatingAxes& s, Vec direction, const std::array<Vec, 3>& corners,
              double smallest) {
  const double reach = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  if (reach <= smallest) return;  // only rounding error; leaving out an axis is conservative
  const double a = dot(direction, corners[0]), b = dot(direction, corners[1]);
  const double c = dot(direction, corners[2]);
  s.axes[s.count++] = {direction, std::min({a, b, c}), std::max({a, b, c}), 1 / reach};
}

SeparatingAxes separating_axes(const std::array<Vec, 3>& triangle) {
  SeparatingAxes s;
  s.base = triangle[0];
  const std::array<Vec, 3> corners{Vec{}, triangle[1] - s.base, triangle[2] - s.base};
  const std::array<Vec, 3> edges{corners[1], corners[2] - corners[1], corners[2]};
  constexpr std::array<Vec, 3> kAxes{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  constexpr double kRounding = 1e-8;
  add_axis(s, cross(edges[0], edges[1]), corners, kRounding * length(edges[0]) * length(edges[1]));
  for (const Vec& axis : kAxes) {
    add_axis(s, axis, corners, 0);
    for (const Vec& edge : edges) add_axis(s, cross(axis, edge), corners, kRounding * length(edge));
  }
  return s;
}

// Half the edge of the smallest cube around `centre` that reaches the triangle.
double half_edge_to_reach(const SeparatingAxes& s, Vec centre) {
  const Vec from_base = centre - s.base;
  double half_edge = 0;
  for (std::size_t i = 0; i < s.count; ++i) {
    const auto& axis = s.axes[i];
    const double at = dot(axis.direction, from_base);
    half_edge = std::max(half_edge, std::max(axis.low - at, at - axis.high) * axis.inverse_reach);
  }
  return half_edge;
}

Vec centre_of(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return {x + 0.5, y + 0.5, z + 0.5};
}

// First and last cell from that of `low` to that of `high`, within the grid.
std::pair<std::uint32_t, std::uint32_t> cell_range(double low, double high, std::uint32_t size) {
  const double last = size - 1.0;
  return {static_cast<std::uint32_t>(std::clamp(std::floor(low - 2 * kTouch), 0.0, last)),
          static_cast<std::uint32_t>(std::clamp(std::floor(high + 2 * kTouch), 0.0, last))};
}

// Calls visit(cell, half_edge) for all cells whose cube the triangle meets or touches.
template <typename Visit>
void each_touched_cell(const Grid& grid, const std::array<Vec, 3>& triangle, Visit visit) {
  const SeparatingAxes axes = separating_axes(triangle);
  Box box;
  for (const Vec& p : triangle) grow(box, p);
  const auto [x0, x1] = cell_range(box.low.x, box.high.x, grid.size[0]);
  const auto [y0, y1] = cell_range(box.low.y, box.high.y, grid.size[1]);
  const auto [z0, z1] = cell_range(box.low.z, box.high.z, grid.size[2]);
  for (std::uint32_t z = z0; z <= z1; ++z) {
    for (std::uint32_t y = y0; y <= y1; ++y) {
      for (std::uint32_t x = x0; x <= x1; ++x) {
        const double half_edge = half_edge_to_reach(axes, centre_of(x, y, z));
        if (half_edge <= 0.5 + kTouch) visit(cell_index(grid, x, y, z), half_edge);
      }
    }
  }
}

bool is_pierced(double half_edge) {
  return half_edge < 0.5 - kTouch;
}

std::array<Vec, 3> corners_of(const std::vector<Vec>& points, const Triangle& t) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}

// ---- flood --------------------------------------------------------------------------------------

enum class FloodState : std::uint8_t { kUnknown, kSurface, kOutside, kInside };

struct Place {
  std::uint32_t x, y, z;
};

// Gives `value` to every unknown cell that is connected with `seed` through faces.
void fill_region(const Grid& grid, std::vector<FloodState>& cells, Place seed, FloodState value,
                 std::vector<Place>& stack) {
  const auto visit = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    FloodState& cell = cells[cell_index(grid, x, y, z)];
    if (cell != FloodState::kUnknown) return;
    cell = value;
    stack.push_back({x, y, z});
  };
  visit(seed.x, seed.y, seed.z);
  while (!stack.empty()) {
    const Place p = stack.back();
    stack.pop_back();
    if (p.x > 0) visit(p.x - 1, p.y, p.z);
    if (p.y > 0) visit(p.x, p.y - 1, p.z);
    if (p.z > 0) visit(p.x, p.y, p.z - 1);
    if (p.x + 1 < grid.size[0]) visit(p.x + 1, p.y, p.z);
    if (p.y + 1 < grid.size[1]) visit(p.x, p.y + 1, p.z);
    if (p.z + 1 < grid.size[2]) visit(p.x, p.y, p.z + 1);
  }
}

template <typename Visit>
void each_cell(const Grid& grid, Visit visit) {
  for (std::uint32_t z = 0; z < grid.size[2]; ++z) {
    for (std::uint32_t y = 0; y < grid.size[1]; ++y) {
      for (std::uint32_t x = 0; x < grid.size[0]; ++x) visit(x, y, z);
    }
  }
}

// Floods the outside first, from the grid's faces; then each enclosed region. Enclosed regions are
// inside, except cavities; only a closed (and so oriented) surface can tell a cavity from
// tissue.
void flood(const Grid& grid, std::vector<FloodState>& cells, const Solid& solid,
           const InsideTest& test) {
  std::vector<Place> stack;
  each_cell(grid, [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const bool at_edge = x == 0 || y == 0 || z == 0 || x + 1 == grid.size[0] ||
                         y + 1 == grid.size[1] || z + 1 == grid.size[2];
    if (at_edge) fill_region(grid, cells, {x, y, z}, FloodState::kOutside, stack);
  });
  each_cell(grid, [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    if (cells[cell_index(grid, x, y, z)] != FloodState::kUnknown) return;
    const bool inside = !solid.closed || is_inside(test, centre_of(x, y, z));
    fill_region(grid, cells, {x, y, z}, inside ? FloodState::kInside : FloodState::kOutside, stack);
  });
}

// The boundary's triangles sorted by the cells they touch: those of cell i are at
// [first[i], first[i + 1]).
struct NearTriangles {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> triangle;
};

NearTriangles near_triangles(const Grid& grid, const Solid& solid) {
  NearTriangles near;
  near.first.assign(cell_count(grid) + 1, 0);
  const auto visit_all = [&](auto visit) {
    for (std::uint32_t i = 0; i < solid.boundary.size(); ++i) {
      each_touched_cell(grid, corners_of(solid.surface.points, solid.boundary[i]),
                        [&](std::size_t cell, double) { visit(cell, i); });
    }
  };
  visit_all([&](std::size_t cell, std::uint32_t) { ++near.first[cell + 1]; });
  std::partial_sum(near.first.begin(), near.first.end(), near.first.begin());
  near.triangle.resize(near.first.back());
  std::vector<std::uint32_t> next(near.first.begin(), near.first.end() - 1);
  visit_all([&](std::size_t cell, std::uint32_t i) { near.triangle[next[cell]++] = i; });
  return near;
}

std::vector<std::array<Vec, 3>> corners_near(const NearTriangles& near, std::size_t cell,
                                             const Solid& solid) {
  std::vector<std::array<Vec, 3>> corners;
  for (std::uint32_t i = near.first[cell]; i < near.first[cell + 1]; ++i) {
    corners.push_back(corners_of(solid.surface.points, solid.boundary[near.triangle[i]]));
  }
  return corners;
}

// Bounds the time and the lists above: refuses many large triangles in a fine grid.
void require_bounded_work(const Grid& grid, const Solid& solid) {
  constexpr double kMostVisits = 4e9;
  double visits = 0;
  for (const Triangle& t : solid.surface.triangles) {
    Box box;
    for (const std::uint32_t corner : t) grow(box, solid.surface.points[corner]);
    double cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = cell_range(box.low[axis], box.high[axis], grid.size[axis]);
      cells *= high - low + 1.0;
    }
    visits += cells;
  }
  if (visits > kMostVisits) {
    refuse<TooFine>(
        "voxel edge {:.6g} mm: the triangles reach over {:.3g} cells in all: expected at most "
        "{:.3g}: choose a larger voxel edge",
        grid.edge_m * 1e3, visits, kMostVisits);
  }
}

Solid in_lattice_units(const Grid& grid, const Solid& solid) {
  Solid scaled = solid;
  for (Vec& p : scaled.surface.points) p = to_lattice(grid, p);
  return scaled;
}

}  // namespace

Grid make_grid(const Box& box_m, double edge_m) {
  Grid grid;
  grid.edge_m = static_cast<double>(static_cast<float>(edge_m));
  const auto round_down = [](double value) {
    const float near = static_cast<float>(value);
    const bool above = static_cast<double>(near) > value;
    return static_cast<double>(above ? std::nextafterf(near, -INFINITY) : near);
  };
  grid.origin_m = {round_down(box_m.low.x), round_down(box_m.low.y), round_down(box_m.low.z)};
  const Vec extent = to_lattice(grid, box_m.high);
  constexpr double kMostPerAxis = 65535;
  double cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = std::max(1.0, std::ceil(extent[axis] - kTouch));
    cells *= size;
    if (!(size <= kMostPerAxis) || !(cells <= static_cast<double>(kMaxCells))) {
      refuse<TooFine>(
          "voxel edge {:.6g} mm: the organ of {:.6g} x {:.6g} x {:.6g} mm needs more than {} "
          "lattice cells: expected a larger voxel edge",
          edge_m * 1e3, (box_m.high.x - box_m.low.x) * 1e3, (box_m.high.y - box_m.low.y) * 1e3,
          (box_m.high.z - box_m.low.z) * 1e3, kMaxCells);
    }
    grid.size[axis] = static_cast<std::uint32_t>(size);
  }
  return grid;
}

Occupancy voxelize(const Grid& grid, const Solid& solid_m, const Progress& progress) {
  const Solid solid = in_lattice_units(grid, solid_m);
  const std::vector<Vec>& points = solid.surface.points;
  Occupancy occupancy;
  occupancy.inside.assign(cell_count(grid), 0);
  occupancy.pierced.assign(cell_count(grid), 0);
  std::vector<FloodState> cells(cell_count(grid), FloodState::kUnknown);
  require_bounded_work(grid, solid);
  progress("marking surface", 0);
  for (const Triangle& t : solid.surface.triangles) {
    each_touched_cell(grid, corners_of(points, t), [&](std::size_t cell, double half_edge) {
      cells[cell] = FloodState::kSurface;
      if (is_pierced(half_edge)) occupancy.pierced[cell] = 1;
    });
  }
  progress("flooding outside", 0);
  const TriangleTree tree = triangle_tree(points, solid.boundary);
  const InsideTest test{tree, solid.oriented};
  flood(grid, cells, solid, test);
  const bool flood_is_proof = solid.closed;
  const NearTriangles near = flood_is_proof ? near_triangles(grid, solid) : NearTriangles{};
  each_cell(grid, [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const std::size_t i = cell_index(grid, x, y, z);
    if (x == 0 && y == 0) progress("sampling", static_cast<double>(z) / grid.size[2]);
    if (cells[i] == FloodState::kSurface) {
      const Vec low_corner{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
      occupancy.inside[i] = flood_is_proof
                                ? sample_cell(test, low_corner, corners_near(near, i, solid))
                                : sample_cell(test, low_corner);
    } else if (cells[i] == FloodState::kInside) {
      occupancy.inside[i] = kAll;
    } else if (!flood_is_proof && is_inside(test, centre_of(x, y, z))) {
      occupancy.inside[i] = kAll;
      ++occupancy.decided_by_winding;
    }
  });
  return occupancy;
}

std::vector<std::uint8_t> touched_cells(const Grid& grid, const Mesh& mesh) {
  std::vector<std::uint8_t> touched(cell_count(grid), 0);
  for (const Triangle& t : mesh.triangles) {
    std::array<Vec, 3> corners = corners_of(mesh.points, t);
    for (Vec& p : corners) p = to_lattice(grid, p);
    each_touched_cell(grid, corners, [&](std::size_t cell, double) { touched[cell] = 1; });
  }
  return touched;
}

}  // namespace stylet::offline
