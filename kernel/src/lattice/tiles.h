// SPDX-License-Identifier: Apache-2.0
// Tiles: the order of the lattice in whole registers, which the filter's passes follow
// (lattice/filter_passes.h).
//
// A tile is eight neighbouring places of a line along x, the first at a multiple of eight in the
// whole lattice. In this order all that belongs to a tile (its nodes in the lines beside it, what
// its voxels send) lies in tiles as well, at the same lanes: no load crosses a line of the cache,
// and the passes walk flat lists, without a loop for each row. (With rows as the sweep stores them,
// one behind the other without gaps, most loads crossed lines and the ends of rows were masked: a
// tissue step of a large organ took 12 to 22 % more time. Tiles of 16 places for AVX-512 took 3 %
// more in long rows and 11 % more in the rows of an organ.) Only the passes' own arrays have this
// order; pieces say which part of a tile lies where among slots and particles.
//
// In an array of a plane each tile has three groups of lanes one after the other, mostly x, y and
// z: all that a pass does with a tile is near. The first tile is empty (zeros) and stands for lines
// that are not there.
//
// Promises as in plan.h. At creation only.
#pragma once

#include "state/layout.h"

namespace stylet {

constexpr std::uint32_t kTile = 8;
constexpr std::uint32_t kTileFloats = 3 * kTile;
static_assert(kGap >= kTile);  // so no tile has lanes of two stretches of a line

// Arrays that the passes keep. Of each plane that some pass still needs: start values and bounds.
// For each pass: three planes of iterates, two planes of what voxels send. And one array for the
// plane at work; the same plane in the order of particles has its own array, not counted here.
constexpr std::uint32_t kPassPlanes = 5;
constexpr std::uint32_t kFilterArrays =
    2 * (kMaxFilterPasses + 1) + kPassPlanes * kMaxFilterPasses + 1;

// A graded lattice keeps all planes of level 0, pass by pass (filter_passes.h): start values,
// bounds and three iterates; and two planes of what voxels send, and the plane at work.
constexpr std::uint32_t kGradedArrays = 5, kGradedPlanes = 3;

// Where a particle lies in an array of all planes' tiles, each plane from its first tile of nodes.
std::uint32_t place_in_tiles(const Model& model, std::uint32_t particle);

// Adds the numbers of tiles to `counts_io`.
void count_tiles(const Organ& organ, Counts& counts_io);

// Fills tiles, pieces and places of tied nodes; needs planes with their particles and ties.
void fill_tiles(const Organ& organ, Model& model);

}  // namespace stylet
