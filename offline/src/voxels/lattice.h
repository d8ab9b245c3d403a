// SPDX-License-Identifier: GPL-3.0-or-later
// The kept voxels of all inputs, numbered as in the file, and the surface embedded in them.
// Units: lattice coordinates for cells and places; metres where a name says so.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stylet/organ.h"
#include "voxels/voxelize.h"

namespace stylet::offline {

constexpr std::uint64_t kFullCell = ~std::uint64_t{0};  // all 64 samples inside

// What the inputs say about each cell, combined input by input.
struct Claims {
  Grid grid;
  std::vector<std::uint64_t> inside;  // union of the samples of all inputs
  std::vector<std::uint8_t> pierced;
  std::vector<std::uint16_t> owner;      // input whose tissue the cell has
  std::vector<std::uint8_t> owner_fill;  // samples of the owner in the cell
  // Each input's samples in cells with several inputs, or with one that does not fill the cell.
  struct Share {
    std::uint32_t cell;
    std::uint16_t owner;
    int priority;
    std::uint64_t inside;
  };
  std::vector<Share> shares;
};

Claims no_claims(const Grid& grid);
// `priorities` are those of all inputs; `occupancy` is that of `input`.
void add_claim(Claims& claims, const Occupancy& occupancy, std::uint16_t input,
               const std::vector<int>& priorities);

bool is_kept(const Claims& claims, std::size_t cell);
// Whether a cell is at the outer surface: pierced, or bare on a face, and not amid full voxels.
bool is_skin(const Claims& claims, std::uint32_t x, std::uint32_t y, std::uint32_t z);

// A voxel that shares its cell with other voxels (voxels/sheets.h).
struct SharedCell {
  std::uint32_t cell, voxel;
  std::uint64_t quarters;  // the voxel's sub-samples of the cell, as in the organ file
  std::uint64_t inside;    // its samples
};

struct Lattice {
  Grid grid;
  std::vector<std::uint32_t> voxel_of_cell;  // kNoVoxel: none; if there are several, the last
  std::vector<std::uint32_t> cell_of_voxel;
  std::vector<OrganRun> runs;
  std::vector<std::uint8_t> fill;  // 1..255
  std::uint32_t sheets = 1, sheet_rows = 0;
  std::vector<OrganTie> ties;
  std::vector<OrganPart> parts;
  std::vector<SharedCell> shared;    // sorted by cell, then voxel
  std::vector<std::uint32_t> sides;  // of each voxel (voxels/apart.h), if any inputs are apart
  // Where parts were split: the nodes that hang on voxels of the level before. Places of nodes and
  // voxels are in their own levels.
  std::optional<std::vector<OrganHanging>> hanging;
};
constexpr std::uint32_t kNoVoxel = 0xFFFFFFFF;

// The voxels that share a cell; empty if the cell has at most one voxel.
std::span<const SharedCell> shared_in(const Lattice& lattice, std::size_t cell);

// The filled part of a voxel's volume in 255ths, at least 1.
std::uint8_t fill_of(std::uint64_t inside);

// The cell that a point lies in, or the nearest cell of the grid.
std::size_t cell_of(const Grid& grid, Vec point_m);

// Keeps also each cell that a point of the surface needs, then numbers the kept cells that are not
// cut away (`cut` as in voxels/crop.h; empty: nothing is).
Lattice make_lattice(Claims& claims, const std::vector<Vec>& points_m,
                     const std::vector<std::uint8_t>& cut = {});
// One lattice for each level; `absent` are the cells of each that are no voxel's place
// (voxels/levels.h), or empty. Levels behind the last one with voxels are left out.
std::vector<Lattice> make_lattices(std::vector<Claims>& levels, const std::vector<Vec>& points_m,
                                   const std::vector<std::vector<std::uint8_t>>& absent);
std::size_t voxel_count(std::span<const Lattice> levels);

// Owner of each voxel: that of its cell, or of its own samples if it shares the cell.
std::vector<std::uint16_t> owners(Claims& claims, const Lattice& lattice);

struct Surface {
  std::vector<OrganVertex> vertices;
  std::vector<Vec> rest_m;              // positions of the vertices as read back from the file
  std::vector<std::uint32_t> voxel_of;  // per triangle: the voxel of its centroid
};
// If several voxels share a cell, a point belongs to the nearest of them, measured from a place a
// little below the surface. Voxels are numbered through all levels.
Surface embed(std::span<const Lattice> levels, const std::vector<Vec>& points_m,
              const std::vector<Triangle>& triangles);

}  // namespace stylet::offline
