// SPDX-License-Identifier: GPL-3.0-or-later
// Which cells of which level become voxels, where an organ is finer in some places than in others.
// Every level has a grid over all of the organ, with half the edge of the one before. A cell is a
// voxel's place, or it is split into the eight cells of the next level within it.
//
// Promise: neighbouring voxels, across faces, edges and corners, differ by at most one level.
// Time and memory: linear in the cells of the finest level.
#pragma once

#include <vector>

#include "voxels/lattice.h"

namespace stylet::offline {

// One byte per cell of each level.
using LevelCells = std::vector<std::vector<std::uint8_t>>;

// The grids of level 0 to `halvings`; refused if the finest is too large for organ files or memory.
std::vector<Grid> level_grids(const Grid& coarsest, std::uint32_t halvings);

// Gives each cell of a level the value of the cell of level 0 that holds it. Empty stays empty.
std::vector<std::uint8_t> inherited(const std::vector<std::uint8_t>& coarsest, const Grid& grid,
                                    std::uint32_t level);

// Splits cells, with all cells of coarser levels around them.
class Splitting {
 public:
  // Cells in which there is anything: samples, or points of the surface. Others are never split.
  // `cut`: cells of level 0 that are cut away (voxels/crop.h).
  Splitting(const std::vector<Claims>& levels, const std::vector<Vec>& points_m,
            const std::vector<std::uint8_t>& cut);

  bool is_occupied(std::uint32_t level, std::size_t cell) const {
    return occupied_[level][cell] != 0;
  }
  void split(std::uint32_t level, std::size_t cell) {
    split_[level][cell] = occupied_[level][cell];
  }
  // Splits the cell of the level before that holds this one.
  void split_around(std::uint32_t level, std::size_t cell);

  // Splits as many other cells as the promise takes. Returns the cells that are no voxel's place.
  LevelCells balanced();

 private:
  std::array<std::uint32_t, 3> place(std::uint32_t level, std::size_t cell) const;
  std::size_t around(std::uint32_t level, const std::array<std::uint32_t, 3>& at) const;
  void split_beside(std::uint32_t level, std::size_t cell);

  std::vector<Grid> grids_;
  std::vector<std::uint8_t> cut_;
  LevelCells occupied_, split_;
};

}  // namespace stylet::offline
