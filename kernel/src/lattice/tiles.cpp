// SPDX-License-Identifier: Apache-2.0
#include "lattice/tiles.h"

#include <algorithm>
#include <bit>

#include "lattice/shadow.h"

namespace stylet {
namespace {

// A tile, the `x`th of line `y`, its place in an array of its plane, and what lies in it.
struct FoundTile {
  std::uint32_t y, x, place;
  Piece piece;
};

// The tiles of a plane, by y and x: of its voxels and the node behind each stretch, or of the nodes
// between two voxel planes.
class PlaneWalk {
 public:
  explicit PlaneWalk(Runs voxels) : lines_({voxels}), rows_(1), next_(1) {}
  PlaneWalk(Runs above, Runs below) : lines_({above, below}), rows_(kRowsTogether), next_(kLanes) {}

  bool next(FoundTile& out) {
    if ((!open_ || x_ * kTile > stretch_.end) && !next_stretch()) return false;
    const std::uint32_t first = x_ * kTile;
    std::uint32_t lanes = 0;
    for (std::uint32_t lane = 0; lane < kTile; ++lane) {
      const std::uint32_t x = first + lane;
      if (x >= stretch_.begin && x <= stretch_.end) lanes |= 1U << lane;
    }
    const auto at =
        static_cast<std::int32_t>(begin_ + first) - static_cast<std::int32_t>(stretch_.begin);
    out = {y_, x_++, place_ += kTileFloats, {at, lanes}};
    return true;
  }

 private:
  bool next_stretch() {
    while (!open_ || !stretches_.next(stretch_)) {
      Beside rows;
      if (!lines_.next(y_, rows)) return false;
      stretches_ = Stretches(std::span(rows).first(rows_));
      open_ = true;
    }
    x_ = stretch_.begin / kTile;
    begin_ = next_;
    next_ += stretch_.end - stretch_.begin + 1;
    return true;
  }

  Lines lines_;
  Stretches stretches_ = {};
  std::uint32_t rows_;  // beside a line
  std::uint32_t next_;  // slot or particle, in the plane, of the next stretch
  Extent stretch_ = {};
  std::uint32_t y_ = 0, x_ = 0, begin_ = 0, place_ = 0;
  bool open_ = false;
};

// Where in a plane's array the tile at line y and place x lies, asked by rising y and x.
class Places {
 public:
  explicit Places(const PlaneWalk& all) : left_(all) { more_ = left_.next(here_); }

  // 0, the empty tile, if there is none.
  std::uint32_t of(std::int64_t y, std::uint32_t x) {
    while (more_ && (here_.y < y || (here_.y == y && here_.x < x))) more_ = left_.next(here_);
    return more_ && here_.y == y && here_.x == x ? here_.place : 0;
  }

 private:
  PlaneWalk left_;
  FoundTile here_ = {};
  bool more_;
};

// Calls visit(plane, runs below, of it and above, z) for each plane of particles.
template <typename Visit>
void for_each_plane(const Organ& organ, std::uint32_t planes, Visit visit) {
  Planes left(organ);
  Runs below = {}, here = {}, above = {};
  std::uint32_t z = 0, z_above = 0;
  (void)left.next(z, here);
  for (std::uint32_t i = 0; i <= planes; ++i, below = here, here = above, z = z_above) {
    above = {};
    if (i < planes) (void)left.next(z_above, above);
    visit(i, below, here, above, z);
  }
}

void count_plane(PlaneWalk left, Counts& counts_io) {
  std::uint32_t tiles = 0;
  for (FoundTile found; left.next(found);) ++tiles;
  counts_io.tiles += tiles;
  counts_io.tile_floats = std::max(counts_io.tile_floats, (1 + tiles) * kTileFloats);
}

// Fills a plane's tiles from index `next` on. They take from tiles of the planes below and above,
// at both sides along y: those of line y take from lines y + first and y + first + 1.
void fill_plane(PlaneWalk left, const PlaneWalk& below, const PlaneWalk& above, std::int64_t first,
                Model& model, std::uint32_t& next_io) {
  Places first_below(below), second_below(below), first_above(above), second_above(above);
  for (FoundTile at; left.next(at); ++next_io) {
    const std::int64_t y = at.y + first;
    model.piece[next_io] = at.piece;
    model.tile[next_io] = {{first_below.of(y, at.x), second_below.of(y + 1, at.x),
                            first_above.of(y, at.x), second_above.of(y + 1, at.x)},
                           0};
  }
}

// For each tile of a plane's voxels: how many tiles of its nodes take from no later one.
void fill_ready(const PlaneTiles& own, Model& model) {
  std::uint32_t node = own.node;
  for (std::uint32_t i = own.voxel; i < own.end; ++i) {
    const std::uint32_t place = (i - own.voxel + 1) * kTileFloats;
    const auto is_ready = [&](const Tile& t) { return std::max(t.from[2], t.from[3]) <= place; };
    for (; node < own.voxel && is_ready(model.tile[node]); ++node) {
    }
    model.tile[i].ready = node - own.node;
  }
}

// Where a plane's particle lies in the plane's array.
std::uint32_t place_of(const Model& model, const Plane& plane, std::uint32_t particle) {
  const auto node = static_cast<std::int32_t>(particle - plane.particle_begin);
  const Piece* const first = model.piece + plane.tiles.node;
  const Piece* const behind = std::upper_bound(
      first, model.piece + plane.tiles.voxel, node, [](std::int32_t at, const Piece& piece) {
        return at < piece.at + std::countr_zero(piece.lanes);
      });
  // behind[-1] has the particle. In the array an empty tile comes before it and the others.
  return static_cast<std::uint32_t>(behind - first) * kTileFloats +
         static_cast<std::uint32_t>(node - behind[-1].at);
}

void fill_ties(const Plane& plane, Model& model) {
  for (std::uint32_t i = plane.tie_begin; i < plane.tie_end; ++i) {
    model.tied_place[i] = {place_of(model, plane, model.tie[i].node),
                           place_of(model, plane, model.tie[i].representative)};
  }
}

}  // namespace

std::uint32_t place_in_tiles(const Model& model, std::uint32_t particle) {
  const Plane* const first = model.plane;
  const Plane* const behind = std::upper_bound(
      first, first + model.head->counts.planes + 1, particle,
      [](std::uint32_t at, const Plane& plane) { return at < plane.particle_begin; });
  return behind[-1].tiles.node * kTileFloats + place_of(model, behind[-1], particle);
}

void count_tiles(const Organ& organ, Counts& counts_io) {
  for_each_plane(organ, counts_io.planes,
                 [&](std::uint32_t i, Runs below, Runs here, Runs, std::uint32_t z) {
                   count_plane(PlaneWalk(here, below), counts_io);
                   if (i < counts_io.planes) count_plane(PlaneWalk(here), counts_io);
                   ++counts_io.tiles;  // an empty one behind each plane's
                   if (level_of(organ.level_planes, z) == 0)
                     counts_io.coarse_tiles = counts_io.tiles;
                 });
  counts_io.filtered_ties = counts_io.ties;
  counts_io.tile_floats = (counts_io.tile_floats + kLanes - 1) / kLanes * kLanes;
  const std::uint64_t coarse = std::uint64_t{counts_io.coarse_tiles} * kTileFloats;
  counts_io.filter_floats =
      (counts_io.levels > 1
           ? kGradedArrays * coarse + std::uint64_t{kGradedPlanes} * counts_io.tile_floats +
                 shadow_floats(counts_io)
           : std::uint64_t{kFilterArrays} * counts_io.tile_floats) +
      std::uint64_t{3} * counts_io.particles_per_plane;
}

void fill_tiles(const Organ& organ, Model& model) {
  const std::uint32_t planes = model.head->counts.planes;
  std::uint32_t next = 0;
  for_each_plane(organ, planes,
                 [&](std::uint32_t i, Runs below, Runs here, Runs above, std::uint32_t) {
                   Plane& plane = model.plane[i];
                   const PlaneWalk nodes(here, below);
                   plane.tiles.node = next;
                   fill_plane(nodes, PlaneWalk(below), PlaneWalk(here), -1, model, next);
                   plane.tiles.voxel = next;
                   if (i < planes) {
                     fill_plane(PlaneWalk(here), nodes, PlaneWalk(above, here), 0, model, next);
                   }
                   plane.tiles.end = next++;  // an empty one: the passes read one ahead
                   fill_ready(plane.tiles, model);
                   fill_ties(plane, model);
                 });
}

}  // namespace stylet
