// SPDX-License-Identifier: Apache-2.0
// Which slots, particles and tiles the lattice's sweep visits, and in what order: written once,
// when a kernel is created (lattice/plan.h, lattice/tiles.h), and read by every step.
//
// Promises: plain structs, the same bytes on every machine. The arrays are in layout.h.
#pragma once

#include <cstdint>

#include "stylet/limits.h"

namespace stylet {

// A stretch of voxels x0 .. x0 + count - 1 of row y (counted over all sheets) in a plane; holes are
// slots without stiffness. The slots before the first and after the last are empty, so a node sees
// zeros beyond the ends. Rows are sorted by plane, y and x.
struct Row {
  std::uint32_t slot;                 // of the first voxel
  std::uint16_t count, x0, y, plane;  // see above
  std::uint32_t node[4];              // particle at (x0, y + dy, plane + dz), index dy + 2 dz
  std::uint32_t window[2];            // first window of line y, in each of the two lists
};

// Where a plane's tiles begin (lattice/tiles.h): of the particles at its low side, then of its
// voxels.
struct PlaneTiles {
  std::uint32_t node, voxel, end;  // indices of tiles; `end` follows the last one of the plane
};

struct Plane {
  std::uint32_t row_begin;                       // the next plane's row_begin is the end
  std::uint32_t z;                               // in the lattice, of the particles at the low side
  std::uint32_t level, z_in_level;               // in space, in edges of its level
  std::uint32_t slot_begin, slot_end;            // multiples of kLanes
  std::uint32_t particle_begin, particle_end;    // of the particles at the plane's low side
  std::uint32_t window_begin[2], window_end[2];  // of 8 and of 16 lanes
  std::uint32_t tie_begin, tie_end;              // of the particles at the plane's low side
  PlaneTiles tiles;                              // true mass only
};

// Two nodes that are one particle, in different sheets of the lattice.
struct TiedNode {
  std::uint32_t node, representative;  // particles; the second is the one that moves
};

constexpr std::uint32_t kMasters = 4;  // at most: the corners of a voxel's face
// A node on the surface of a coarser voxel. The corners of that voxel around the node are its
// masters, and it moves by the weighted mean of their motions. The weights add up to 1; a node with
// fewer than four masters has the weight 0 for the others.
struct HangingNode {
  std::uint32_t node, master[kMasters];  // particles
  float weight[kMasters];                // of the masters
};
// The share that node `from` gives to node `to` of all that `from` has got. A hanging node in the
// sweep gives each master its weight, times the master's mobility over the hanging node's own.
struct HangingShare {
  std::uint32_t to, from;  // particles, or nodes of the cascade
  float share;             // of what `from` has got
  std::uint32_t count;     // in the first of the shares of a level that have one `to`: how many
};

// A cell of some level in which there are finer voxels (lattice/shadow.h).
struct ShadowCell {
  std::uint32_t node[8];  // of the cascade, at its corners (bits x, y, z)
  float bound_n_per_m;    // on its stiffness at each corner; in level 0 divided by 8
  float fastest_per_s2;   // of its motions, if it were full
  std::uint16_t x, y, z;  // as in the file
};
struct ShadowNode {
  std::uint16_t x, y, z;  // as in the file
};
// The cascade of a graded lattice: its nodes are the particles of all levels above 0, then those of
// level 0 at shadow cells (the border), then the shadows of level 0, 1, ...
struct Shadows {
  std::uint32_t on;                            // 0: no motion is faster than the step can follow
  std::uint32_t first_particle;                // of the levels above 0
  std::uint32_t coarse_planes;                 // planes of particles of level 0
  std::uint32_t fine_begin[kMaxLevels + 1];    // nodes: a level's particles
  std::uint32_t border_begin, border_end;      // nodes
  std::uint32_t shadow_begin[kMaxLevels + 1];  // nodes: a level's shadows
  std::uint32_t coarse_cells;                  // shadow cells of level 0
  std::uint32_t down_begin[kMaxLevels + 1];    // shares of a level's nodes to coarser ones
  std::uint32_t up_begin[kMaxLevels + 1];      // shares of coarser nodes to a level's
  float limit_per_s2[kMaxLevels];              // of the motions that a level moves by itself
  float fastest_per_s2;                        // bound on those of level 0
  float most_slowed;                           // momentum over velocity, at most
};

// Neighbouring nodes of one line (y) of a voxel plane, one register's lanes, and the voxel rows
// y - 1 and y that send forces to them (lattice/plan.h).
struct Window {
  // Slot at the low side of the first node, in the plane; at least -kLanes. A row without any bit
  // gets the other row's slot: only sums of rows that reach the window are available.
  std::int32_t slot[2];
  std::uint16_t lanes[2];   // a bit for each node that belongs to the row
  std::uint32_t low, high;  // the first node, in the particle planes below and above
};

// Eight places of the filter's passes (lattice/tiles.h), which take values from four other tiles.
// Voxels take from nodes at (y, y + 1) below, then above; nodes take from voxels at (y - 1, y)
// below, then above.
struct Tile {
  std::uint32_t from[4];  // where the four tiles begin in an array of their plane
  // For a tile of voxels: how many tiles of nodes of its plane have got all that they take once
  // this tile has sent.
  std::uint32_t ready;
};
// The part of a stretch that lies in the tile with the same index.
struct Piece {
  std::int32_t at;      // the tile's first lane among a plane's slots or particles, or before them
  std::uint32_t lanes;  // a bit for each that is the stretch's
};

}  // namespace stylet
