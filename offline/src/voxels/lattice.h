// SPDX-License-Identifier: GPL-3.0-or-later
// The kept voxels of all inputs together, numbered in file order, and the surface embedded in them.
// Units: lattice coordinates for cells and places, metres where the name says so.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stylet/organ.h"
#include "voxels/voxelize.h"

namespace stylet::bake {

constexpr std::uint64_t kFullCell = ~std::uint64_t{0};  // all 64 samples inside

// What the inputs say about each cell, combined one input after the other.
struct Claims {
  Grid grid;
  std::vector<std::uint64_t> inside;  // union of the samples of all inputs
  std::vector<std::uint8_t> pierced;
  std::vector<std::uint16_t> owner;      // input that gives the tissue
  std::vector<std::uint8_t> owner_fill;  // samples of the owner in the cell
  // The samples of each input in cells that no single one fills.
  struct Share {
    std::uint32_t cell;
    std::uint16_t owner;
    int priority;
    std::uint64_t inside;
  };
  std::vector<Share> shares;
};

Claims no_claims(const Grid& grid);
// `priorities` of all inputs; `input` is the one that `occupancy` belongs to.
void add_claim(Claims& claims, const Occupancy& occupancy, std::uint16_t input,
               const std::vector<int>& priorities);

bool is_kept(const Claims& claims, std::size_t cell);
// At the outer surface: pierced or bare on one face, and not in the midst of full voxels.
bool is_skin(const Claims& claims, std::uint32_t x, std::uint32_t y, std::uint32_t z);

// A voxel that shares its cell with others (voxels/sheets.h).
struct SharedCell {
  std::uint32_t cell, voxel;
  std::uint64_t quarters;  // of the cell that are the voxel's own, as in the organ file
  std::uint64_t inside;    // its samples
};

struct Lattice {
  Grid grid;
  std::vector<std::uint32_t> voxel_of_cell;  // kNoVoxel where there is none; of several the last
  std::vector<std::uint32_t> cell_of_voxel;
  std::vector<OrganRun> runs;
  std::vector<std::uint8_t> fill;  // 1..255
  std::uint32_t sheets = 1, sheet_rows = 0;
  std::vector<OrganTie> ties;
  std::vector<OrganPart> parts;
  std::vector<SharedCell> shared;  // by cell and voxel
};
constexpr std::uint32_t kNoVoxel = 0xFFFFFFFF;

// The voxels of a cell that share it; none where there is one voxel at most.
std::span<const SharedCell> shared_in(const Lattice& lattice, std::size_t cell);

// The part of a voxel's volume that is filled, in 255ths, 1 at least.
std::uint8_t fill_of(std::uint64_t inside);

// The cell a point lies in, or the nearest one of the grid.
std::size_t cell_of(const Grid& grid, Vec point_m);

// Keeps each cell that a point of the surface needs, then numbers the kept ones but for those that
// are cut away (voxels/crop.h; empty: none).
Lattice make_lattice(Claims& claims, const std::vector<Vec>& points_m,
                     const std::vector<std::uint8_t>& cut = {});

// Owner of each voxel: the cell's, or of the samples where cells are shared.
std::vector<std::uint16_t> owners(Claims& claims, const Lattice& lattice);

struct Surface {
  std::vector<OrganVertex> vertices;
  std::vector<Vec> rest_m;              // as the file gives them back
  std::vector<std::uint32_t> voxel_of;  // per triangle: the voxel of its centroid
};
// Where several voxels share a cell, a place belongs to the one it is nearest to, seen from a
// little below the surface.
Surface embed(const Lattice& lattice, const std::vector<Vec>& points_m,
              const std::vector<Triangle>& triangles);

}  // namespace stylet::bake
