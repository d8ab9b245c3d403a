// SPDX-License-Identifier: Apache-2.0
// Body of the filter (filter.h): velocities from momenta, and the particles' motion; part of the
// lattice sweep, compiled with it once per instruction set.
//
// The passes run through the planes as a wave: pass j is a plane behind pass j - 1, so a pass keeps
// only three planes of its start values and two of what voxels send. They stay in a near cache.
// (Passes one by one over whole arrays do not fit: with 20 000 voxels they took twice the time.) A
// slab computes the iterates that it needs of planes beside it a second time, so no pass
// waits for another thread; the bits do not depend on slabs.
//
// In a pass each voxel takes the mean of its eight corners and gives it to them: sums along x in
// lanes as in the sweep, then through the sweep's windows. This is done for some lines of voxels at
// a time, and for the particles below them right after.
//
// Internal linkage throughout, as in lanes.h. PHYSICS 3.4.
#pragma once

#include "base/lanes.h"
#include "lattice/lattice.h"
#include "state/layout.h"

namespace stylet {
namespace {

// Smallest steps of velocity, displacement and rotation. They keep denormals (20 times slower, and
// rounded differently by processors that flush them) out of the state.
constexpr float kQuantum = 1.52587890625e-05F;  // 2^-16: displacements and velocities to 2e-12

struct Motion {
  float dt, tau, keep;
  float fastest;  // also limits momentum over mass: what is torn so fast loses it
  // Largest displacement so far, as bits: as integers they have the order of floats.
  WideBits largest = {};
};

inline Wide bounded(Wide velocity, const Motion& motion) {
  velocity = (velocity + kQuantum) - kQuantum;
  return no_larger(velocity, motion.fastest);
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

// Nodes that are one particle get the sum of their values. `values`: x, y, z of a plane,
// particles_per_plane apart.
void join_tied(const Model& model, const Plane& plane, float* values) {
  const TiedNode* const first = model.tie + plane.tie_begin;
  const TiedNode* const end = model.tie + plane.tie_end;
  for (int c = 0; c < 3; ++c, values += model.head->counts.particles_per_plane) {
    const auto at = [&](std::uint32_t node) -> float& {
      return values[node - plane.particle_begin];
    };
    for (const TiedNode* tie = first; tie != end; ++tie) at(tie->representative) += at(tie->node);
    for (const TiedNode* tie = first; tie != end; ++tie) at(tie->node) = at(tie->representative);
  }
}

// What the passes keep: x, y, z of a plane, particles_per_plane apart.
struct Wave {
  float* sums;  // of a plane's slots: x, y, z, slots_per_plane apart
  float* planes;
  std::ptrdiff_t axis;

  float* at(std::uint32_t j, std::uint32_t which) const {
    return planes + static_cast<std::ptrdiff_t>((j - 1) * kPassPlanes + which) * 3 * axis;
  }
  // What pass j > 1 starts from; below, what voxels send in any pass.
  float* iterate(std::uint32_t j, std::uint32_t z) const { return at(j, z % 3); }
  float* sent(std::uint32_t j, std::uint32_t z) const { return at(j, 3 + z % 2); }
};

// What pass j starts from (the first from w) on a plane of particles: x, y, z, `axis` apart.
struct Iterate {
  const float* at;
  std::ptrdiff_t axis;
};
Iterate iterate_of(const Model& model, const State& state, const Wave& wave, std::uint32_t j,
                   std::uint32_t z) {
  if (j > 1) return {wave.iterate(j, z), wave.axis};
  return {state.wx + model.plane[z].particle_begin, state.wy - state.wx};
}

Wave wave_in(const Model& model, float* floats) {
  const Counts& counts = model.head->counts;
  float* const sums = floats + kLanes;  // windows read the lanes before, but do not use them
  return {sums, sums + std::size_t{3} * counts.slots_per_plane,
          static_cast<std::ptrdiff_t>(counts.particles_per_plane)};
}

// For voxel rows up to `end`, at the node between two slots: both slots' means of `low` and `high`
// (the iterates below and above), each times its bound, added.
STYLET_KEEP_APART void sum_voxels(const Model& model, std::uint32_t z, Iterate low, Iterate high,
                                  const Wave& wave, const Row* row, const Row* end) {
  const Plane *const plane = model.plane + z, *const above = plane + 1;
  const std::ptrdiff_t stride = model.head->counts.slots_per_plane;
  for (; row != end; ++row) {
    const float* n[4] = {low.at + (row->node[0] - plane->particle_begin),
                         low.at + (row->node[1] - plane->particle_begin),
                         high.at + (row->node[2] - above->particle_begin),
                         high.at + (row->node[3] - above->particle_begin)};
    float* to = wave.sums + (row->slot - plane->slot_begin);
    const float* bound = model.slot_bound + row->slot;
    // Sum over the four rows of nodes at a voxel row, for each x.
    const auto across = [&](std::ptrdiff_t at) {
      return (load(n[0] + at) + load(n[1] + at)) + (load(n[2] + at) + load(n[3] + at));
    };
    Wide last[3] = {};
    Wide here[3] = {across(0), across(low.axis), across(2 * low.axis)};
    const auto emit = [&](std::ptrdiff_t c, Wide b, Wide now, Wide behind) {
      // The corners of an empty slot may have any value.
      const Wide own = zero_unless(b > 0, b * (now + lanes_ahead(now, behind)));
      store(to + c * stride, lanes_behind(last[c], own) + own);
      last[c] = own;
    };
    for (const float* const end_of = to + row->count; to + kWide <= end_of; to += kWide) {
      const Wide b = load(bound);
      bound += kWide;
      for (const float*& node : n) node += kWide;
      for (std::ptrdiff_t c = 0; c < 3; ++c) {
        const Wide next = across(c * low.axis);
        emit(c, b, here[c], next);
        here[c] = next;
      }
    }
    // There is no voxel behind the last node.
    const Wide b = load(bound);
    for (std::ptrdiff_t c = 0; c < 3; ++c) emit(c, b, here[c], here[c]);
  }
}

// Adds the sums of windows up to `end` to the particles below, which may have sums already, and
// sets those above.
STYLET_KEEP_APART void spread_sums(const Model& model, const Wave& wave, const Window* w,
                                   const Window* end, float* low, float* high) {
  constexpr std::uint32_t kWindow = kWide > 8 ? 16 : 8;
  const std::ptrdiff_t stride = model.head->counts.slots_per_plane;
  for (; w != end; ++w) {
    for (std::uint32_t i = 0; i < kWindow; i += kWide) {
      const WideBits before = lanes_set(std::uint32_t{w->lanes[0]} >> i);
      const WideBits behind = lanes_set(std::uint32_t{w->lanes[1]} >> i);
      const float* a = wave.sums + (w->slot[0] + static_cast<std::ptrdiff_t>(i));
      const float* b = wave.sums + (w->slot[1] + static_cast<std::ptrdiff_t>(i));
      float *to_low = low + w->low + i, *to_high = high + w->high + i;
      for (int c = 0; c < 3; ++c) {
        const Wide sum = zero_unless(before, load(a)) + zero_unless(behind, load(b));
        store(to_low, load(to_low) + sum);
        store(to_high, sum);
        a += stride;
        b += stride;
        to_low += wave.axis;
        to_high += wave.axis;
      }
    }
  }
}

// Calls visit(first lane in the plane) for each group of a plane's particles; the first group is
// padding.
template <typename Visit>
inline void for_each_group(const Plane& plane, Visit visit) {
  const std::ptrdiff_t count = plane.particle_end - plane.particle_begin;
  for (std::ptrdiff_t i = kLanes; i < count; i += kWide) visit(i);
}

// Calls use(axis, lane in the plane, next iterate) for the groups [begin, end) of a plane's
// particles after pass j. Sets what was sent to zero, for the next plane that uses the memory.
template <typename Use>
inline void finish_groups(const Model& model, const State& state, const Scratch& scratch,
                          const Wave& wave, std::uint32_t j, std::uint32_t z, std::ptrdiff_t begin,
                          std::ptrdiff_t end, Use use) {
  const Plane& plane = model.plane[z];
  const ModelHead& head = *model.head;
  const FilterPass pass = head.filter.pass[j - 1];
  const float slope = pass.bound_s2 / head.substep_s;  // per dt / m
  const Iterate first = iterate_of(model, state, wave, 1, z),
                last = iterate_of(model, state, wave, j, z);
  const Iterate before =
      j > 1 ? iterate_of(model, state, wave, j - 1, z) : first;  // in pass 1 its factor is zero
  const float* const per_mass = model.step_per_mass + plane.particle_begin;
  const float* const bound = model.bound + plane.particle_begin;
  const float* const held = scratch.coupling_bound + plane.particle_begin;
  float* const sent = wave.sent(j, z);
  for (std::ptrdiff_t i = begin; i < end; i += kWide) {
    const Wide by = slope * load(per_mass + i);
    const Wide d = load(bound + i) + load(held + i);
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      float* const from = sent + (i + c * wave.axis);
      const Wide own = load(last.at + (i + c * last.axis));
      const Wide pull = d * own - load(from);
      const Wide kept = pass.last * own + pass.first * load(first.at + (i + c * first.axis));
      use(c, i, kept + (pass.before * load(before.at + (i + c * before.axis)) - by * pull));
      store(from, Wide{});
    }
  }
}

// Slots of rows, from `row` on, that pass over a plane together: whole lines, few enough that they
// and all data that belongs to them stay in the nearest cache.
constexpr std::uint32_t kSlotsTogether = 64;
inline const Row* lines_together(const Row* row, const Row* end) {
  const std::uint32_t until = row->slot + kSlotsTogether;
  for (++row; row != end && (row->y == row[-1].y || row->slot < until); ++row) {
  }
  return row;
}

// Pass j for a voxel plane, if there is one; then the particles below it, which by then have
// received everything: `use` as in finish_groups.
template <typename Use>
void pass_plane(const Model& model, const State& state, const Scratch& scratch, const Wave& wave,
                std::uint32_t j, std::uint32_t z, Use use) {
  constexpr std::uint32_t kList = kWide > 8 ? 1 : 0;
  const Plane& plane = model.plane[z];
  const std::ptrdiff_t count = plane.particle_end - plane.particle_begin;
  std::ptrdiff_t done = kLanes;  // before it are padding and groups that are finished
  const bool tied = plane.tie_begin != plane.tie_end;
  if (z != model.head->counts.planes) {
    const Window* const windows = kList == 0 ? model.window8 : model.window16;
    const Window* window = windows + plane.window_begin[kList];
    const Row* const end = model.row + (&plane)[1].row_begin;
    const Iterate low = iterate_of(model, state, wave, j, z),
                  high = iterate_of(model, state, wave, j, z + 1);
    const Row* next = model.row + plane.row_begin;
    for (const Row* row = next; row != end; row = next) {
      next = lines_together(row, end);
      sum_voxels(model, z, low, high, wave, row, next);
      const Window* const to =
          windows + (next == end ? plane.window_end[kList] : next->window[kList]);
      spread_sums(model, wave, window, to, wave.sent(j, z), wave.sent(j, z + 1));
      window = to;
      if (tied || next == end) continue;
      const std::ptrdiff_t until = to->low / kWide * kWide;
      finish_groups(model, state, scratch, wave, j, z, done, until, use);
      done = until > done ? until : done;
    }
  }
  if (tied) join_tied(model, plane, wave.sent(j, z));
  finish_groups(model, state, scratch, wave, j, z, done, count, use);
}

// Moves a plane's particles with the velocities of the last pass.
void move_filtered(const Model& model, State& state, const Scratch& scratch, const Wave& wave,
                   std::uint32_t z, Motion& motion_out) {
  const Plane& plane = model.plane[z];
  const std::uint32_t passes = model.head->filter.passes;
  const std::ptrdiff_t axis = state.uy - state.ux;
  float* const u = state.ux + plane.particle_begin;
  float* const v = state.vx + plane.particle_begin;
  float* const e = state.ex + plane.particle_begin;
  Motion motion = motion_out;
  const auto move = [&](std::ptrdiff_t c, std::ptrdiff_t i, Wide velocity) {
    const std::ptrdiff_t at = i + c * axis;
    displace_lanes(bounded(velocity, motion), u + at, v + at, e + at, motion);
  };
  if (passes > 0) {
    pass_plane(model, state, scratch, wave, passes, z, move);
  } else {
    const Iterate w = iterate_of(model, state, wave, 1, z);
    for_each_group(plane, [&](std::ptrdiff_t i) {
      for (std::ptrdiff_t c = 0; c < 3; ++c) move(c, i, load(w.at + (i + c * w.axis)));
    });
  }
  motion_out = motion;
}

// Filters and moves the particles of planes [begin, end).
void filter_planes(const Model& model, State& state, const Scratch& scratch, std::uint32_t begin,
                   std::uint32_t end, float* floats, Motion& motion) {
  const Wave wave = wave_in(model, floats);
  const std::uint32_t passes = model.head->filter.passes;
  const std::uint32_t planes = model.head->counts.planes + 1;  // of particles
  // Pass j covers the planes from passes + 1 - j before the first to as many after the last.
  const auto first_of = [&](std::uint32_t j) {
    const std::uint32_t reach = passes + 1 - j;
    return begin > reach ? begin - reach : 0;
  };
  const auto end_of = [&](std::uint32_t j) {
    const std::uint32_t reach = passes + 1 - j;
    return planes - end > reach ? end + reach : planes;
  };
  for (std::uint32_t j = 1; j <= passes; ++j) {
    for (std::ptrdiff_t i = 0; i < 6 * wave.axis; i += kWide) store(wave.sent(j, 0) + i, Wide{});
  }
  for (std::uint32_t t = first_of(1); t < end + passes; ++t) {
    for (std::uint32_t j = 1; j < passes && j <= t; ++j) {
      const std::uint32_t z = t - j;
      if (z < first_of(j) || (z + 1 >= end_of(j) && z + 1 != planes)) continue;
      float* const next = wave.iterate(j + 1, z);
      pass_plane(model, state, scratch, wave, j, z,
                 [&](std::ptrdiff_t c, std::ptrdiff_t i, Wide value) {
                   store(next + i + c * wave.axis, value);
                 });
    }
    if (t < first_of(passes) + passes) continue;
    const std::uint32_t z = t - passes;
    if (z >= begin) {
      move_filtered(model, state, scratch, wave, z, motion);
    } else {  // what the plane below gives to the first
      pass_plane(model, state, scratch, wave, passes, z,
                 [](std::ptrdiff_t, std::ptrdiff_t, Wide) {});
    }
  }
}

}  // namespace
}  // namespace stylet
