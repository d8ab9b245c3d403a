// SPDX-License-Identifier: GPL-3.0-or-later
#include "asset/organ_shape.h"

namespace stylet::offline {

std::vector<Cell> lattice_cells_of(const Organ& organ) {
  std::vector<Cell> cells;
  cells.reserve(organ.voxel_count);
  for (const OrganRun& run : organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) cells.push_back({run.x + i, run.y, run.z});
  }
  return cells;
}

std::vector<Cell> cells_of(const Organ& organ) {
  std::vector<Cell> cells = lattice_cells_of(organ);
  for (Cell& cell : cells) cell[1] %= organ.sheet_rows;
  return cells;
}

VoxelGrid voxel_grid(const Organ& organ, const std::vector<Cell>& cells) {
  VoxelGrid grid{{organ.size_x, organ.size_y, organ.size_z}, {}};
  grid.voxel.assign(std::size_t{organ.size_x} * organ.size_y * organ.size_z, kEmptyCell);
  for (std::uint32_t voxel = 0; voxel < cells.size(); ++voxel) {
    const Cell& at = cells[voxel];
    grid.voxel[(std::size_t{at[2]} * organ.size_y + at[1]) * organ.size_x + at[0]] = voxel;
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
  return origin + at * static_cast<double>(organ.voxel_edge_m);
}

VoxelMesh surface_mesh(const Organ& organ, const std::vector<Cell>& cells) {
  const double step_m = static_cast<double>(organ.voxel_edge_m) / 65535;
  VoxelMesh out;
  out.mesh.points.reserve(organ.vertices.size());
  for (const OrganVertex& v : organ.vertices) {
    out.mesh.points.push_back(low_corner_m(organ, cells[v.voxel]) +
                              Vec{1.0 * v.fx, 1.0 * v.fy, 1.0 * v.fz} * step_m);
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

VoxelMesh voxel_faces(const Organ& organ, const std::vector<Cell>& cells, const VoxelGrid& grid,
                      const std::function<bool(const Cell&)>& shown) {
  VoxelMesh out;
  for (std::uint32_t voxel = 0; voxel < cells.size(); ++voxel) {
    if (!shown(cells[voxel])) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool high : {false, true}) {
        Cell beyond = cells[voxel];
        const bool at_edge = !high && beyond[axis] == 0;
        if (!at_edge) beyond[axis] += high ? 1U : ~0U;
        const bool bare = at_edge ||
                          voxel_at(grid, beyond[0], beyond[1], beyond[2]) == kEmptyCell ||
                          !shown(beyond);
        if (bare) add_face(organ, cells[voxel], axis, high, voxel, out);
      }
    }
  }
  return out;
}

}  // namespace stylet::offline
