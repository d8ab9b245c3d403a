// SPDX-License-Identifier: GPL-3.0-or-later
// The rest shape of a finished organ, for reports and pictures: the cell of each voxel, the
// embedded surface, the faces of the lattice. Units: metres, the organ's frame; cells are counted
// from the lattice's low corner, in edges of the finest level's voxels.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/geometry.h"
#include "stylet/organ.h"

namespace stylet::offline {

// A voxel covers `size` cells along each axis.
struct Cell {
  std::array<std::uint32_t, 3> low{};
  std::uint32_t size = 1;

  std::uint32_t& operator[](std::size_t axis) { return low[axis]; }
  std::uint32_t operator[](std::size_t axis) const { return low[axis]; }
  bool operator==(const Cell&) const = default;
};

// The cells of each voxel: in space; and in the lattice, where sheets follow one another along y
// and levels along z, and each voxel has a cell.
std::vector<Cell> cells_of(const Organ& organ);
std::vector<Cell> lattice_cells_of(const Organ& organ);
// Cells of space along each axis, and their edge.
std::array<std::uint32_t, 3> size_in_space(const Organ& organ);
double cell_edge_m(const Organ& organ);
// The level of a voxel by its cells in space.
std::uint32_t level_of(const Organ& organ, const Cell& cell);

// The voxel of each cell; kEmptyCell where a cell has no voxel.
constexpr std::uint32_t kEmptyCell = 0xFFFFFFFF;
struct VoxelGrid {
  std::array<std::uint32_t, 3> size{};
  std::vector<std::uint32_t> voxel;
};
VoxelGrid voxel_grid(const std::vector<Cell>& cells);
// Places outside the grid are allowed and are empty.
std::uint32_t voxel_at(const VoxelGrid& grid, std::int64_t x, std::int64_t y, std::int64_t z);

Vec low_corner_m(const Organ& organ, const Cell& cell);

// A mesh with the voxel of each triangle.
struct VoxelMesh {
  Mesh mesh;
  std::vector<std::uint32_t> voxel;
};
VoxelMesh surface_mesh(const Organ& organ, const std::vector<Cell>& cells);
// The faces between the voxels that `shown` accepts and all else; counter-clockwise from outside.
VoxelMesh voxel_faces(const Organ& organ, const std::vector<Cell>& cells, const VoxelGrid& grid,
                      const std::function<bool(const Cell&)>& shown);

}  // namespace stylet::offline
