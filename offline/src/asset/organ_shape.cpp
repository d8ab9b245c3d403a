// SPDX-License-Identifier: GPL-3.0-or-later
#include "asset/organ_shape.h"

#include <bit>

#include "stylet/levels.h"

namespace stylet::offline {

std::vector<Cell> lattice_cells_of(const Organ& organ) {
  std::vector<Cell> cells;
  cells.reserve(organ.voxel_count);
  for (const OrganRun& run : organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) cells.push_back({{run.x + i, run.y, run.z}});
  }
  return cells;
}

std::vector<Cell> cells_of(const Organ& organ) {
  std::vector<Cell> cells = lattice_cells_of(organ);
  for (Cell& cell : cells) {
    const std::uint32_t level = stylet::level_of(organ.level_planes, cell[2]);
    cell[1] %= organ.sheet_rows;
    cell[2] -= first_plane(organ.level_planes, level);
    cell.size = 1U << (organ.levels - 1U - level);
    for (std::uint32_t& each : cell.low) each *= cell.size;
  }
  return cells;
}

std::array<std::uint32_t, 3> size_in_space(const Organ& organ) {
  return {organ.size_x, organ.sheet_rows, std::uint32_t{organ.level_planes} << (organ.levels - 1U)};
}

double cell_edge_m(const Organ& organ) {
  return static_cast<double>(organ.voxel_edge_m) / (1U << (organ.levels - 1U));
}

std::uint32_t level_of(const Organ& organ, const Cell& cell) {
  return organ.levels - static_cast<std::uint32_t>(std::bit_width(cell.size));
}

VoxelGrid voxel_grid(const std::vector<Cell>& cells) {
  VoxelGrid grid;
  for (const Cell& cell : cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      grid.size[axis] = std::max(grid.size[axis], cell[axis] + cell.size);
    }
  }
  const auto& size = grid.size;
  grid.voxel.assign(std::size_t{size[0]} * size[1] * size[2], kEmptyCell);
  for (std::uint32_t voxel = 0; voxel < cells.size(); ++voxel) {
    const Cell& at = cells[voxel];
    for (std::uint32_t z = at[2]; z < at[2] + at.size; ++z) {
      for (std::uint32_t y = at[1]; y < at[1] + at.size; ++y) {
        const std::size_t row = (std::size_t{z} * size[1] + y) * size[0];
        std::fill_n(grid.voxel.begin() + static_cast<std::ptrdiff_t>(row + at[0]), at.size, voxel);
      }
    }
  }
  return grid;
}

std::uint32_t voxel_at(const VoxelGrid& grid, std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto& size = grid.size;
  if (x < 0 || y < 0 || z < 0 || x >= size[0] || y >= size[1] || z >= size[2]) return kEmptyCell;
  return grid.voxel[static_cast<std::size_t>((z * size[1] + y) * size[0] + x)];
}

Vec low_corner_m(const Organ& organ, const Cell& cell) {
  const Vec origin = {static_cast<double>(organ.origin_m.x), static_cast<double>(organ.origin_m.y),
                      static_cast<double>(organ.origin_m.z)};
  const Vec at = {1.0 * cell[0], 1.0 * cell[1], 1.0 * cell[2]};
  return origin + at * cell_edge_m(organ);
}

VoxelMesh surface_mesh(const Organ& organ, const std::vector<Cell>& cells) {
  const double step_m = cell_edge_m(organ) / 65535;
  VoxelMesh out;
  out.mesh.points.reserve(organ.vertices.size());
  for (const OrganVertex& v : organ.vertices) {
    const Cell& cell = cells[v.voxel];
    out.mesh.points.push_back(low_corner_m(organ, cell) +
                              Vec{1.0 * v.fx, 1.0 * v.fy, 1.0 * v.fz} * (step_m * cell.size));
  }
  for (const OrganTriangle& t : organ.triangles) {
    out.mesh.triangles.push_back({t.a, t.b, t.c});
    out.voxel.push_back(organ.vertices[t.a].voxel);
  }
  return out;
}

namespace {

void add_face(const Organ& organ, const Cell& cell, std::size_t axis, bool high,
              std::uint32_t voxel, VoxelMesh& out) {
  constexpr std::uint32_t kAround[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto first = static_cast<std::uint32_t>(out.mesh.points.size());
  for (const auto& around : kAround) {
    Cell corner = cell;
    corner[axis] += high ? 1 : 0;
    corner[(axis + 1) % 3] += around[0];
    corner[(axis + 2) % 3] += around[1];
    out.mesh.points.push_back(low_corner_m(organ, corner));
  }
  const std::uint32_t second = high ? 1 : 3, fourth = high ? 3 : 1;
  out.mesh.triangles.push_back({first, first + second, first + 2});
  out.mesh.triangles.push_back({first, first + 2, first + fourth});
  out.voxel.insert(out.voxel.end(), 2, voxel);
}

}  // namespace

namespace {

// Calls visit(cell) for the cells of a voxel along one of its faces.
template <typename Visit>
void each_face_cell(const Cell& voxel, std::size_t axis, bool high, Visit visit) {
  Cell cell{voxel.low, 1};
  if (high) cell[axis] += voxel.size - 1;
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (std::uint32_t j = 0; j < voxel.size; ++j) {
    for (std::uint32_t i = 0; i < voxel.size; ++i) {
      Cell at = cell;
      at[u] += i;
      at[v] += j;
      visit(at);
    }
  }
}

}  // namespace

VoxelMesh voxel_faces(const Organ& organ, const std::vector<Cell>& cells, const VoxelGrid& grid,
                      const std::function<bool(const Cell&)>& shown) {
  VoxelMesh out;
  const auto is_bare = [&](Cell beyond, std::size_t axis, bool high) {
    if (!high && beyond[axis] == 0) return true;
    beyond[axis] += high ? 1U : ~0U;
    return voxel_at(grid, beyond[0], beyond[1], beyond[2]) == kEmptyCell || !shown(beyond);
  };
  for (std::uint32_t voxel = 0; voxel < cells.size(); ++voxel) {
    if (!shown(cells[voxel])) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool high : {false, true}) {
        each_face_cell(cells[voxel], axis, high, [&](const Cell& cell) {
          if (is_bare(cell, axis, high)) add_face(organ, cell, axis, high, voxel, out);
        });
      }
    }
  }
  return out;
}

}  // namespace stylet::offline
