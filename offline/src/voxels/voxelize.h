// SPDX-License-Identifier: GPL-3.0-or-later
// Turns a solid into voxels: which cubes its surface passes through, and which part of every cube
// is inside.
//
// Steps as in squashing cubes (James, Barbic, Twigg 2004): exact triangle/cube overlap marks the
// surface; a flood from outside finds what is enclosed. The generalised winding number decides the
// cells of which the flood proves nothing: those beside the surface, and all cells if the mesh has
// holes. If faces disagree about which side is outside even after repair, thirteen rays vote
// instead of the winding number.
//
// Promises: every point of the surface lies in a voxel marked as pierced or within kTouch of one;
// the filled part is known to 1/64. Time: linear in triangles and cells, n log n in surface cells.
// Units: lattice (voxel edges from the low corner of voxel 0) inside, metres outside.
#pragma once

#include "base/progress.h"
#include "meshes/repair.h"

namespace stylet::offline {

// Half the quantum of a vertex position in the organ file. What is nearer than this to a voxel's
// face counts as lying on the face, so that a surface along voxel faces does not add a layer of
// empty voxels.
constexpr double kTouch = 0.5 / 65535;

// Of a grid; about 2 GiB over all stages.
constexpr std::size_t kMaxCells = std::size_t{1} << 26U;

struct Grid {
  Vec origin_m;       // each component is exactly representable as a float
  double edge_m = 0;  // exactly representable as a float
  std::array<std::uint32_t, 3> size{};
};

inline std::size_t cell_count(const Grid& grid) {
  return std::size_t{grid.size[0]} * grid.size[1] * grid.size[2];
}
inline std::size_t cell_index(const Grid& grid, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return (std::size_t{z} * grid.size[1] + y) * grid.size[0] + x;
}
inline Vec to_lattice(const Grid& grid, Vec point_m) {
  return (point_m - grid.origin_m) * (1 / grid.edge_m);
}

// The smallest grid of this edge around `box_m`; refused if too large for organ files or memory.
Grid make_grid(const Box& box_m, double edge_m);

struct Occupancy {
  std::vector<std::uint64_t> inside;   // per cell, one bit for each sample point
  std::vector<std::uint8_t> pierced;   // 1: the surface passes through the cell
  std::size_t decided_by_winding = 0;  // cells inside that the flood reached through a hole
};

// `solid` is in metres.
Occupancy voxelize(const Grid& grid, const Solid& solid, const Progress& progress);

// Cells that the surface of `mesh` (metres) passes through or touches, for attachments.
std::vector<std::uint8_t> touched_cells(const Grid& grid, const Mesh& mesh);

}  // namespace stylet::offline
