// SPDX-License-Identifier: Apache-2.0
#include "lattice/tiles.h"

#include <algorithm>
#include <bit>

namespace stylet {
namespace {

// A piece, and the tile that has it: the `x`th of line `y`.
struct Found {
  std::uint32_t y, x;
  Piece piece;
};

// What a plane stores of the rows beside a line (runs.h): of voxels, of nodes.
Stretches<1> stretches_of(const Runs (&rows)[2]) {
  return Stretches<1>({rows[0]});
}
Stretches<4> stretches_of(const Runs (&rows)[4]) {
  return Stretches<4>(rows);
}

// The pieces of a plane, by y and x. kPlanes 1: of its voxels and the node behind each stretch;
// 2: of the nodes between two voxel planes, the one above first.
template <std::uint32_t kPlanes>
class Pieces {
 public:
  explicit Pieces(const Runs (&planes)[kPlanes])
      : lines_(planes), next_(kPlanes == 1 ? 1 : kLanes) {}

  bool next(Found& out) {
    if ((!open_ || x_ * kTile > stretch_.end) && !next_stretch()) return false;
    const std::uint32_t first = x_ * kTile;
    std::uint32_t lanes = 0;
    for (std::uint32_t lane = 0; lane < kTile; ++lane) {
      const std::uint32_t x = first + lane;
      if (x >= stretch_.begin && x <= stretch_.end) lanes |= 1U << lane;
    }
    const auto at =
        static_cast<std::int32_t>(begin_ + first) - static_cast<std::int32_t>(stretch_.begin);
    out = {y_, x_++, {at, place_ += kTileFloats, lanes}};
    return true;
  }

 private:
  static constexpr std::uint32_t kRows = kPlanes == 1 ? 1 : 2 * kPlanes;

  bool next_stretch() {
    while (!open_ || !stretches_.next(stretch_)) {
      Runs rows[2 * kPlanes];
      if (!lines_.next(y_, rows)) return false;
      stretches_ = stretches_of(rows);
      open_ = true;
    }
    x_ = stretch_.begin / kTile;
    begin_ = next_;
    next_ += stretch_.end - stretch_.begin + 1;
    return true;
  }

  static constexpr Runs kNone[kRows] = {};
  Lines<kPlanes> lines_;
  Stretches<kRows> stretches_{kNone};
  std::uint32_t next_;  // slot or particle, in the plane, of the next stretch
  Extent stretch_ = {};
  std::uint32_t y_ = 0, x_ = 0, begin_ = 0, place_ = 0;
  bool open_ = false;
};

// Where in a plane's array the tile at line y and place x lies, asked by rising y and x.
template <std::uint32_t kPlanes>
class Places {
 public:
  explicit Places(const Runs (&planes)[kPlanes]) : left_(planes) { more_ = left_.next(here_); }

  // 0, the empty tile, if there is none.
  std::uint32_t of(std::int64_t y, std::uint32_t x) {
    while (more_ && (here_.y < y || (here_.y == y && here_.x < x))) more_ = left_.next(here_);
    return more_ && here_.y == y && here_.x == x ? here_.piece.place : 0;
  }

 private:
  Pieces<kPlanes> left_;
  Found here_ = {};
  bool more_;
};

// Calls visit(plane, runs below, of it and above) for each plane of particles.
template <typename Visit>
void for_each_plane(const Organ& organ, std::uint32_t planes, Visit visit) {
  Planes left(organ);
  Runs below = {}, here = {}, above = {};
  std::uint32_t z = 0;
  (void)left.next(z, here);
  for (std::uint32_t i = 0; i <= planes; ++i, below = here, here = above) {
    above = {};
    if (i < planes) (void)left.next(z, above);
    visit(i, below, here, above);
  }
}

template <std::uint32_t kPlanes>
void count_plane(const Runs (&planes)[kPlanes], Counts& counts_io) {
  Pieces<kPlanes> left(planes);
  std::uint32_t tiles = 0;
  for (Found found; left.next(found);) ++tiles;
  counts_io.tiles += tiles;
  counts_io.tile_floats = std::max(counts_io.tile_floats, (1 + tiles) * kTileFloats);
}

// Where the next tile and piece are filled in.
struct Next {
  Tile* tile;
  Piece* piece;
};

// Appends a plane's pieces and tiles. from(found): where what a tile takes lies.
template <std::uint32_t kPlanes, typename From>
void fill_plane(const Runs (&planes)[kPlanes], Next& next_io, From from) {
  Pieces<kPlanes> left(planes);
  for (Found found; left.next(found);) {
    *next_io.piece++ = found.piece;
    *next_io.tile++ = from(found);
  }
}

// Nodes take from the voxels at both sides along y, of the planes below and above.
void fill_nodes(Runs below, Runs above, Next& next_io) {
  Places<1> first_below({below}), second_below({below});
  Places<1> first_above({above}), second_above({above});
  fill_plane<2>({above, below}, next_io, [&](const Found& at) -> Tile {
    return {{first_below.of(std::int64_t{at.y} - 1, at.x), second_below.of(at.y, at.x),
             first_above.of(std::int64_t{at.y} - 1, at.x), second_above.of(at.y, at.x)},
            0};
  });
}

// Voxels take from the nodes at both sides along y, below and above.
void fill_voxels(Runs below, Runs here, Runs above, Next& next_io) {
  Places<2> first_below({here, below}), second_below({here, below});
  Places<2> first_above({above, here}), second_above({above, here});
  fill_plane<1>({here}, next_io, [&](const Found& at) -> Tile {
    return {{first_below.of(at.y, at.x), second_below.of(std::int64_t{at.y} + 1, at.x),
             first_above.of(at.y, at.x), second_above.of(std::int64_t{at.y} + 1, at.x)},
            0};
  });
}

// For each tile of a plane's voxels: how many tiles of its nodes take from no later one.
void fill_ready(const Tile* node, const Tile* nodes_end, Tile* voxel, const Tile* voxels_end) {
  const Tile* const first = node;
  for (std::uint32_t place = kTileFloats; voxel != voxels_end; ++voxel, place += kTileFloats) {
    while (node != nodes_end && std::max(node->from[2], node->from[3]) <= place) ++node;
    voxel->ready = static_cast<std::uint32_t>(node - first);
  }
}

// Where particle `node` of a plane lies in the plane's array.
std::uint32_t place_of(const Piece* first, const Piece* end, std::int32_t node) {
  const auto first_node = [](const Piece& piece) {
    return piece.at + std::countr_zero(piece.lanes);
  };
  const Piece* const behind =
      std::upper_bound(first, end, node,
                       [&](std::int32_t at, const Piece& piece) { return at < first_node(piece); });
  return behind[-1].place + static_cast<std::uint32_t>(node - behind[-1].at);
}

void fill_ties(const Plane& plane, const Piece* first, const Piece* end, Model& model) {
  const auto place = [&](std::uint32_t node) {
    return place_of(first, end, static_cast<std::int32_t>(node - plane.particle_begin));
  };
  for (std::uint32_t i = plane.tie_begin; i < plane.tie_end; ++i) {
    model.tied_place[i] = {place(model.tie[i].node), place(model.tie[i].representative)};
  }
}

}  // namespace

void count_tiles(const Organ& organ, Counts& counts_io) {
  for_each_plane(organ, counts_io.planes, [&](std::uint32_t i, Runs below, Runs here, Runs) {
    count_plane<2>({here, below}, counts_io);
    if (i < counts_io.planes) count_plane<1>({here}, counts_io);
  });
  counts_io.pieces = counts_io.tiles;
  counts_io.tiles += counts_io.planes + 1;  // an empty one behind each plane's
  counts_io.filtered_ties = counts_io.ties;
  counts_io.tile_floats = (counts_io.tile_floats + kLanes - 1) / kLanes * kLanes;
  counts_io.filter_floats = std::uint64_t{kFilterArrays} * counts_io.tile_floats +
                            std::uint64_t{3} * counts_io.particles_per_plane;
}

void fill_tiles(const Organ& organ, Model& model) {
  Tile* const tiles = model.tile;
  Piece* const pieces = model.piece;
  Next next = {tiles, pieces};
  const std::uint32_t planes = model.head->counts.planes;
  for_each_plane(organ, planes, [&](std::uint32_t i, Runs below, Runs here, Runs above) {
    Plane& plane = model.plane[i];
    const Next nodes = next;
    fill_nodes(below, here, next);
    fill_ties(plane, nodes.piece, next.piece, model);
    const Next voxels = next;
    if (i < planes) fill_voxels(below, here, above, next);
    fill_ready(nodes.tile, voxels.tile, voxels.tile, next.tile);
    const auto index = [](const auto* at, const auto* first) {
      return static_cast<std::uint32_t>(at - first);
    };
    plane.tiles = {index(nodes.tile, tiles),    index(voxels.tile, tiles),
                   index(next.tile, tiles),     index(nodes.piece, pieces),
                   index(voxels.piece, pieces), index(next.piece, pieces)};
    ++next.tile;  // an empty one: the passes read one ahead
  });
}

}  // namespace stylet
