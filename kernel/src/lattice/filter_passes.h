// SPDX-License-Identifier: Apache-2.0
// Body of the filter (filter.h): velocities from momenta, and the particles' motion; part of the
// lattice sweep, compiled with it once per instruction set.
//
// The passes run through the planes as a wave: pass j is one plane behind pass j - 1. So a pass
// keeps only three planes of its start values and two of what voxels send, which stay in a near
// cache. (Passes one by one over whole arrays do not fit: with 20 000 voxels they took twice the
// time.) Near its ends a slab needs iterates of planes of the next slab, and computes them itself,
// too: so no pass waits for another thread. The bits do not depend on slabs.
//
// In a pass each voxel computes the mean of its eight corners and sends it to them. Before the
// first pass, each plane is brought into the order of tiles (lattice/tiles.h); after the last pass,
// it is brought back.
//
// Internal linkage throughout, as in lanes.h. PHYSICS 3.4.
#pragma once

#include <algorithm>
#include <bit>
#include <type_traits>

#include "base/lanes.h"
#include "lattice/lattice.h"
#include "lattice/tiles.h"
#include "state/layout.h"

namespace stylet {
namespace {

// Smallest steps of velocity, displacement and rotation. They keep denormals (20 times slower, and
// rounded differently by processors that flush them) out of the state.
constexpr float kQuantum = 1.52587890625e-05F;  // 2^-16: displacements and velocities to 2e-12

struct Motion {
  float dt, tau, keep;
  // Limits of a velocity, and of momentum over mass: faster particles lose the rest.
  float fastest, most_momentum;
  // Largest displacement so far, as bits: as integers they have the order of floats.
  WideBits largest = {};
};

inline Wide bounded(Wide velocity, float most) {
  velocity = (velocity + kQuantum) - kQuantum;
  return no_larger(velocity, most);
}

// Moves a group of lanes along one axis by a velocity.
inline void displace_lanes(Wide velocity, float* u, float* v, float* e, Motion& motion) {
  Wide place = load(u) + motion.dt * velocity;
  place = (place + kQuantum) - kQuantum;
  store(v, velocity);
  store(u, place);
  store(e, place + motion.tau * velocity);
  const WideBits size = __builtin_bit_cast(WideBits, place) & 0x7FFFFFFF;
  motion.largest = motion.largest > size ? motion.largest : size;
}

// Nodes that are one particle get the sum of their values: x, y, z, `axis` apart, from node `begin`
// on.
void join_tied(const TiedNode* first, const TiedNode* end, float* values, std::uint32_t begin,
               std::ptrdiff_t axis) {
  for (int c = 0; c < 3; ++c, values += axis) {
    const auto at = [&](std::uint32_t node) -> float& { return values[node - begin]; };
    for (const TiedNode* tie = first; tie != end; ++tie) at(tie->representative) += at(tie->node);
    for (const TiedNode* tie = first; tie != end; ++tie) at(tie->node) = at(tie->representative);
  }
}

// ---- tiles --------------------------------------------------------------------------------------

// What the passes keep, all in arrays of a plane: for each tile three groups of lanes, mostly x, y
// and z of one thing (tiles.h).
struct Wave {
  float *starts, *bounds;
  float* planes;
  float *work, *packed;   // the last: in the order of particles
  std::ptrdiff_t floats;  // of an array
  std::uint32_t kept;     // planes of start values and bounds

  // What the first pass starts from.
  float* start(std::uint32_t z) const { return starts + z % kept * floats; }
  // Of particles, step over mass times bound, and step over mass; of the voxels above, the bound.
  float* bound(std::uint32_t z) const { return bounds + z % kept * floats; }
  float* at(std::uint32_t j, std::uint32_t which) const {
    return planes + static_cast<std::ptrdiff_t>((j - 1) * kPassPlanes + which) * floats;
  }
  // What pass j starts from; below, what voxels send in it.
  float* iterate(std::uint32_t j, std::uint32_t z) const { return j > 1 ? at(j, z % 3) : start(z); }
  float* sent(std::uint32_t j, std::uint32_t z) const { return at(j, 3 + z % 2); }
};

Wave wave_in(const Model& model, float* memory) {
  const auto floats = static_cast<std::ptrdiff_t>(model.head->counts.tile_floats);
  const std::ptrdiff_t kept = kMaxFilterPasses + 1;
  float* const planes = memory + 2 * kept * floats;
  float* const work = planes + kPassPlanes * kMaxFilterPasses * floats;
  return {memory, memory + kept * floats,       planes, work, work + floats,
          floats, model.head->filter.passes + 1};
}

// Brings a plane into the order of tiles. Lanes that are no place of the plane are zero.
STYLET_KEEP_APART void start_plane(const Model& model, const State& state, const Scratch& scratch,
                                   std::uint32_t z, float* start, float* bounds) {
  const Plane& plane = model.plane[z];
  const PlaneTiles& own = plane.tiles;
  const float* const w = state.wx + plane.particle_begin;
  const std::ptrdiff_t axis = state.wy - state.wx;
  const float* const bound = model.bound + plane.particle_begin;
  const float* const held = scratch.coupling_bound + plane.particle_begin;
  const float* const per_mass = model.step_per_mass + plane.particle_begin;
  std::ptrdiff_t place = kTileFloats;
  for (const Piece* p = model.piece + own.node; p != model.piece + own.voxel; ++p) {
    for (std::uint32_t i = 0; i < kTile; i += kNarrow) {
      const NarrowBits lanes = narrow_set(p->lanes >> i);
      const std::ptrdiff_t at = p->at + static_cast<std::ptrdiff_t>(i);
      float* const to = start + place + i;
      float* const to_bounds = bounds + place + i;
      for (std::ptrdiff_t c = 0; c < 3; ++c) {
        store_narrow(to + c * kTile, zero_unless(lanes, load_narrow(w + (at + c * axis))));
      }
      const Narrow mobility = zero_unless(lanes, load_narrow(per_mass + at));
      const Narrow stiffness = load_narrow(bound + at) + load_narrow(held + at);
      store_narrow(to_bounds, zero_unless(lanes, mobility * stiffness));
      store_narrow(to_bounds + kTile, mobility);
    }
    place += kTileFloats;
  }
  const float* const of_voxels = model.slot_bound + plane.slot_begin;
  place = kTileFloats;
  for (const Piece* p = model.piece + own.voxel; p != model.piece + own.end; ++p) {
    for (std::uint32_t i = 0; i < kTile; i += kNarrow) {
      const Narrow each = load_narrow(of_voxels + (p->at + static_cast<std::ptrdiff_t>(i)));
      store_narrow(bounds + place + 2 * kTile + i, zero_unless(narrow_set(p->lanes >> i), each));
    }
    place += kTileFloats;
  }
}

// ---- a pass -------------------------------------------------------------------------------------

// The sum of what a tile takes: from two tiles of `low` and two of `high`.
struct Taken {
  const float* from[4];

  Taken(const Tile& tile, const float* low, const float* high)
      : from{low + tile.from[0], low + tile.from[1], high + tile.from[2], high + tile.from[3]} {}
  Narrow sum(std::uint32_t at) const {
    return (load_narrow(from[0] + at) + load_narrow(from[1] + at)) +
           (load_narrow(from[2] + at) + load_narrow(from[3] + at));
  }
};

// For a plane's voxels, at the node between two of them: both voxels' means of `low` and `high`
// (the iterates below and above), each times its bound, added. A lane without a voxel has the
// bound zero, as the last lane of a row: so nothing passes from a row to the next. `carry`: from
// the tiles before.
STYLET_KEEP_APART void sum_tiles(const Tile* tile, const Tile* end, const float* low,
                                 const float* high, const float* bounds, float* to,
                                 Narrow (&carry)[3]) {
  Narrow last[3] = {carry[0], carry[1], carry[2]};
  Taken taken(*tile, low, high);
  Narrow here[3] = {taken.sum(0), taken.sum(kTile), taken.sum(2 * kTile)};
  for (; tile != end; ++tile, bounds += kTileFloats, to += kTileFloats) {
    const Taken ahead(tile[1], low, high);
    for (std::uint32_t i = 0; i < kTile; i += kNarrow) {
      const bool within = i + kNarrow < kTile;
      const Narrow b = load_narrow(bounds + 2 * kTile + i);
      STYLET_UNROLL
      for (std::uint32_t c = 0; c < 3; ++c) {
        const Narrow next = within ? taken.sum(i + kNarrow + c * kTile) : ahead.sum(c * kTile);
        const Narrow own = b * (here[c] + narrow_ahead(here[c], next));
        store_narrow(to + i + c * kTile, narrow_behind(last[c], own) + own);
        last[c] = own;
        here[c] = next;
      }
    }
    taken = ahead;
  }
  std::copy(last, last + 3, carry);
}

// What a plane's particles get from the voxels below and above.
STYLET_KEEP_APART void gather_tiles(const Tile* tile, const Tile* end, const float* below,
                                    const float* above, float* to) {
  for (; tile != end; ++tile) {
    const Taken taken(*tile, below, above);
    for (std::uint32_t i = 0; i < kTileFloats; i += kNarrow, to += kNarrow) {
      store_narrow(to, taken.sum(i));
    }
  }
}

// The arrays of a plane and of its neighbours that a pass needs.
struct PassArrays {
  const float *last, *high;  // what it starts from: the plane's, and that of the plane above
  const float* below;        // what voxels of the plane below send; above: what the plane's send
  float* above;
  const float *bounds, *first, *before;  // the last two: of w, and of the pass before
  float* work;                           // room for a plane
};
template <typename AnyWave>
PassArrays arrays_of(const AnyWave& wave, std::uint32_t j, std::uint32_t z, std::uint32_t above_z) {
  return {wave.iterate(j, z),     wave.iterate(j, above_z),
          wave.sent(j, z + 1),    wave.sent(j, z),
          wave.bound(z),          wave.start(z),
          wave.iterate(j - 1, z), wave.work};
}

// The arrays of a plane's particles that a pass goes on from.
struct Iterates {
  FilterPass pass;
  float slope;  // of the bound, per dt / m
  const float *bounds, *first, *before, *last;
};

// Adds to the next iterates their parts of w and of the iterates of the pass before. Pass 1 adds
// nothing: w is its last iterate, and no pass is before it. (Two functions: no test could take a
// branch on a constant both ways.)
inline Narrow with_earlier(Narrow next, const Iterates& by, std::ptrdiff_t place, std::false_type) {
  return next + (by.pass.first * load_narrow(by.first + place) +
                 by.pass.before * load_narrow(by.before + place));
}
inline Narrow with_earlier(Narrow next, const Iterates&, std::ptrdiff_t, std::true_type) {
  return next;
}

// Sets the next iterates of tiles [tile, end), which begin at `at` in the plane's arrays.
// sum(tile, at)(i): what particles got, all axes one after the other. kStart: in pass 1.
template <bool kStart, typename Sum>
inline void finish_tiles(const Tile* tile, const Tile* end, const Iterates& iterates,
                         std::ptrdiff_t at, float* to, Sum sum) {
  const Iterates by = iterates;  // copied: after a store of a float they would be read again
  for (; tile != end; ++tile, at += kTileFloats) {
    const auto got = sum(*tile, at);
    for (std::uint32_t i = 0; i < kTile; i += kNarrow) {
      const Narrow last = by.pass.last - by.slope * load_narrow(by.bounds + (at + i));
      const Narrow per_mass = by.slope * load_narrow(by.bounds + (at + kTile + i));
      STYLET_UNROLL
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::ptrdiff_t place = at + i + c * kTile;
        const Narrow next = last * load_narrow(by.last + place) + per_mass * got(i + c * kTile);
        store_narrow(to + place, with_earlier(next, by, place, std::bool_constant<kStart>{}));
      }
    }
  }
}

// The same for a plane with nodes that are one particle: they first get the sum of their values.
// For all passes: in pass 1 what would be added is zero.
STYLET_KEEP_APART void finish_tied(const Model& model, const Plane& plane, const PassArrays& arrays,
                                   const Iterates& iterates, float* to) {
  const Tile* const nodes = model.tile + plane.tiles.node;
  const Tile* const end = model.tile + plane.tiles.voxel;
  float* const sums = arrays.work;
  gather_tiles(nodes, end, arrays.below, arrays.above, sums + kTileFloats);
  join_tied(model.tied_place + plane.tie_begin, model.tied_place + plane.tie_end, sums, 0, kTile);
  finish_tiles<false>(nodes, end, iterates, kTileFloats, to, [=](const Tile&, std::ptrdiff_t at) {
    return [=](std::uint32_t i) { return load_narrow(sums + (at + i)); };
  });
}

// Tiles of voxels that pass over a plane together, so that what belongs to them stays in the
// nearest cache until the nodes below them take it.
constexpr std::ptrdiff_t kTilesTogether = 16;

template <bool kStart>
STYLET_KEEP_APART void pass_plane_as(const Model& model, const PassArrays& arrays, std::uint32_t j,
                                     std::uint32_t z, float* to) {
  const Plane& plane = model.plane[z];
  const PlaneTiles& own = plane.tiles;
  const Tile *const nodes = model.tile + own.node, *const voxels = model.tile + own.voxel;
  const std::ptrdiff_t voxel_count = own.end - own.voxel;
  const float* const below = arrays.below;
  float* const above = arrays.above;
  const FilterPass& pass = model.head->filter.pass[j - 1];
  const Iterates iterates = {pass,          pass.bound_s2 / model.head->substep_s,
                             arrays.bounds, arrays.first,
                             arrays.before, arrays.last};
  const bool tied = plane.tie_begin != plane.tie_end;
  const Tile* node = nodes;
  const auto finish_until = [&](const Tile* end) {
    finish_tiles<kStart>(node, end, iterates, std::ptrdiff_t{kTileFloats} * (node - nodes + 1), to,
                         [=](const Tile& tile, std::ptrdiff_t) {
                           return [taken = Taken(tile, below, above)](std::uint32_t i) {
                             return taken.sum(i);
                           };
                         });
    node = end;
  };
  Narrow carry[3] = {};
  for (std::ptrdiff_t done = 0; done < voxel_count; done += kTilesTogether) {
    const std::ptrdiff_t next = std::min(done + kTilesTogether, voxel_count);
    const std::ptrdiff_t at = std::ptrdiff_t{kTileFloats} * (done + 1);
    sum_tiles(voxels + done, voxels + next, arrays.last, arrays.high, arrays.bounds + at,
              above + at, carry);
    if (!tied) finish_until(nodes + voxels[next - 1].ready);
  }
  if (tied) {
    finish_tied(model, plane, arrays, iterates, to);
  } else {
    finish_until(voxels);
  }
}

// Pass j for the voxels of plane z and the particles below them, whose next iterates it writes to
// `to`.
template <typename AnyWave>
inline void pass_plane(const Model& model, const AnyWave& wave, std::uint32_t j, std::uint32_t z,
                       float* to) {
  const std::uint32_t above_z = z < model.head->counts.planes ? z + 1 : z;  // there: no voxels
  const PassArrays arrays = arrays_of(wave, j, z, above_z);
  if (j == 1) {
    pass_plane_as<true>(model, arrays, j, z, to);
  } else {
    pass_plane_as<false>(model, arrays, j, z, to);
  }
}

// ---- motion -------------------------------------------------------------------------------------

// Calls visit(first lane in the plane) for each group of a plane's particles; the first group is
// padding.
template <typename Visit>
inline void for_each_group(const Plane& plane, Visit visit) {
  const std::ptrdiff_t count = plane.particle_end - plane.particle_begin;
  for (std::ptrdiff_t i = kLanes; i < count; i += kWide) visit(i);
}

// Brings x, y, z of a plane of tiles into the order of particles. What a piece's last lanes write
// beyond it, the next piece overwrites.
STYLET_KEEP_APART void pack_plane(const Piece* piece, const Piece* end, const float* from,
                                  float* to, std::ptrdiff_t to_axis) {
  std::ptrdiff_t last = kLanes;
  for (; piece != end; ++piece) {
    from += kTileFloats;
    const std::ptrdiff_t first = std::countr_zero(piece->lanes);
    last = piece->at + static_cast<std::ptrdiff_t>(std::bit_width(piece->lanes));
    for (std::ptrdiff_t i = first; i < first + kTile; i += kNarrow) {
      for (std::ptrdiff_t c = 0; c < 3; ++c) {
        store_narrow(to + (piece->at + i + c * to_axis), load_narrow(from + (i + c * kTile)));
      }
    }
  }
  for (std::ptrdiff_t i = last; i < last + kLanes; i += kWide) {  // the padding
    for (std::ptrdiff_t c = 0; c < 3; ++c) store(to + (i + c * to_axis), Wide{});
  }
}

// Moves a plane's particles with these velocities: x, y, z, `axis` apart.
STYLET_KEEP_APART void move_plane(const Plane& plane, State& state, const float* velocity,
                                  std::ptrdiff_t axis, Motion& motion_io) {
  const std::ptrdiff_t own_axis = state.uy - state.ux;
  float* const u = state.ux + plane.particle_begin;
  float* const v = state.vx + plane.particle_begin;
  float* const e = state.ex + plane.particle_begin;
  Motion motion = motion_io;
  for_each_group(plane, [&](std::ptrdiff_t i) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      const std::ptrdiff_t at = i + c * own_axis;
      displace_lanes(bounded(load(velocity + (i + c * axis)), motion.fastest), u + at, v + at,
                     e + at, motion);
    }
  });
  motion_io = motion;
}

// `iterate`: the last pass's of the plane; `packed`: room for it in the order of particles.
void move_filtered(const Model& model, State& state, const float* iterate, float* packed,
                   std::uint32_t z, Motion& motion_io) {
  const Plane& plane = model.plane[z];
  const auto axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  pack_plane(model.piece + plane.tiles.node, model.piece + plane.tiles.voxel, iterate, packed,
             axis);
  move_plane(plane, state, packed, axis, motion_io);
}

// Without passes the momenta are the velocities.
void move_unfiltered(const Model& model, State& state, std::uint32_t begin, std::uint32_t end,
                     Motion& motion_io) {
  for (std::uint32_t z = begin; z < end; ++z) {
    const Plane& plane = model.plane[z];
    move_plane(plane, state, state.wx + plane.particle_begin, state.wy - state.wx, motion_io);
  }
}

// Filters and moves the particles of planes [begin, end).
void filter_planes(const Model& model, State& state, const Scratch& scratch, std::uint32_t begin,
                   std::uint32_t end, float* floats, Motion& motion) {
  const std::uint32_t passes = model.head->filter.passes;
  const std::uint32_t planes = model.head->counts.planes + 1;  // of particles
  if (passes == 0) {
    move_unfiltered(model, state, begin, end, motion);
    return;
  }
  const Wave wave = wave_in(model, floats);
  // Pass j covers the planes from passes + 1 - j before the first to as many after the last.
  const auto first_of = [&](std::uint32_t j) {
    const std::uint32_t reach = passes + 1 - j;
    return begin > reach ? begin - reach : 0;
  };
  const auto end_of = [&](std::uint32_t j) {
    const std::uint32_t reach = passes + 1 - j;
    return planes - end > reach ? end + reach : planes;
  };
  for (std::uint32_t k = 0; k < kFilterArrays; ++k) {  // the empty tiles
    for (std::uint32_t i = 0; i < kTileFloats; i += kNarrow) {
      store_narrow(floats + k * wave.floats + i, Narrow{});
    }
  }
  for (std::uint32_t t = first_of(1); t < end + passes; ++t) {
    if (t < end_of(1)) start_plane(model, state, scratch, t, wave.start(t), wave.bound(t));
    for (std::uint32_t j = 1; j < passes && j <= t; ++j) {
      const std::uint32_t z = t - j;
      if (z < first_of(j) || (z + 1 >= end_of(j) && z + 1 != planes)) continue;
      pass_plane(model, wave, j, z, wave.iterate(j + 1, z));
    }
    if (t < first_of(passes) + passes) continue;
    const std::uint32_t z = t - passes;
    pass_plane(model, wave, passes, z, wave.work);
    // Of the plane before `begin`, only what its voxels give to plane `begin` is needed.
    if (z >= begin) move_filtered(model, state, wave.work, wave.packed, z, motion);
  }
}

}  // namespace
}  // namespace stylet
