// SPDX-License-Identifier: Apache-2.0
// Body of the lattice sweep, included once per instruction set by step_<isa>.cpp with
// STYLET_LATTICE_STEP naming the function. See lattice.h for physics and promises.
//
// For each voxel plane: 1 sums and differences of the eight corners, row by row. 2 rotation of each
// cluster and what a row sends to its nodes, over all slots in full lanes, as soon as some dozens
// are summed. 3 each window of nodes collects what the voxel rows at its sides send
// (lattice/plan.h), as soon as both are matched. Then the particles of the plane's low side have
// all their forces and move (with true mass: get their momentum, and lattice/filter_passes.h moves
// them). Some rows of clusters and two planes of forces stay in cache; nothing else is stored.
// (When whole planes of clusters were stored, they did not fit the nearest cache: 8 % more time.)
//
// Voxels that hold constraint particles are matched before the sweep, all together. Plane by plane,
// the few in each plane took the time of a full group of lanes: at 5000 voxels 7 % of the step.

#include <algorithm>

#include "base/lanes.h"
#include "lattice/filter_passes.h"
#include "lattice/graded_passes.h"
#include "lattice/lattice.h"
#include "lattice/match_lanes.h"
#include "lattice/matches.h"
#include "lattice/team.h"
#include "lattice/voxel_stages.h"
#include "state/attachment.h"

namespace stylet {
namespace {

// Stage 3 for windows up to `end`. On the side that the sweep comes from, forces are added to those
// from the clusters there; on the other side they are set. Windows must run in order: their last
// lanes write zeros beyond the end of a line, and the next line overwrites them. `low` and `high`:
// x, y, z, `axis` apart. The sums begin with slot `front`.
template <bool kUp>
const Window* spread_windows(Sums sums, std::int32_t front, const Window* w, const Window* end,
                             float* low, float* high, std::ptrdiff_t axis) {
  constexpr std::uint32_t kWindow = kWide > 8 ? 16 : 8;
  constexpr std::ptrdiff_t kAhead = 48;
  const std::ptrdiff_t stride = sums.stride;
  for (; w != end; ++w) {
    for (std::uint32_t i = 0; i < kWindow; i += kWide) {
      const WideBits before = lanes_set(std::uint32_t{w->lanes[0]} >> i);
      const WideBits behind = lanes_set(std::uint32_t{w->lanes[1]} >> i);
      const float* a = sums.at + (w->slot[0] - front + static_cast<std::ptrdiff_t>(i));
      const float* b = sums.at + (w->slot[1] - front + static_cast<std::ptrdiff_t>(i)) + 2 * stride;
      float *to_low = low + w->low + i, *to_high = high + w->high + i;
      for (int c = 0; c < 3; ++c) {
        const Wide on_low = zero_unless(before, load(a)) + zero_unless(behind, load(b));
        const Wide on_high =
            zero_unless(before, load(a + stride)) + zero_unless(behind, load(b + stride));
        // These forces are set, not read: by now they are in a farther cache, and stores wait for
        // it one by one: 5 % of the time of 20 000 voxels.
        if constexpr (kUp) {
          __builtin_prefetch(to_high + kAhead, 1);
          store(to_low, load(to_low) + on_low);
          store(to_high, on_high);
        } else {
          __builtin_prefetch(to_low + kAhead, 1);
          store(to_low, on_low);
          store(to_high, load(to_high) + on_high);
        }
        a += 4 * stride;
        b += 4 * stride;
        to_low += axis;
        to_high += axis;
      }
    }
  }
  return w;
}

// Moves the results and sums of slots from `from` up to `end` to the front.
void keep_slots(Sums sums, std::uint32_t from, std::uint32_t end) {
  const std::ptrdiff_t stride = sums.stride;
  float* to = sums.at;
  for (std::uint32_t i = from; i < end; i += kWide, to += kWide) {
    for (std::ptrdiff_t c = 0; c < 12; c += 4) {
      float* const at = to + c * stride;
      const float* const old = at + from;
      store(at, load(old));
      store(at + stride, load(old + stride));
      store(at + 2 * stride, load(old + 2 * stride));
      store(at + 3 * stride, load(old + 3 * stride));
    }
  }
}

// The first row of the same line.
inline const Row* line_begin(const Row* first, const Row* row) {
  for (; row != first && row[-1].y == row->y; --row) {
  }
  return row;
}

// All stages for a voxel plane. The last matched line of rows stays for the line of nodes behind
// it; rows that the chunk has begun stay for the next chunk.
template <bool kUp>
void sweep_plane(const Model& model, State& state, Scratch& scratch, const Plane& plane, float* low,
                 float* high) {
  constexpr std::uint32_t kList = kWide > 8 ? 1 : 0;
  const ModelHead& head = *model.head;
  const std::uint32_t at = plane.slot_begin, count = plane.slot_end - plane.slot_begin;
  const auto axis = static_cast<std::ptrdiff_t>(head.counts.particles_per_plane);
  const Places places = {state.ex, state.ey - state.ex};
  const Sums sums = sums_of(model, scratch);
  const Slots slots = {
      sums,          model.slot_k + at, model.slot_volume + at, model.slot_stiffening + at,
      state.qw + at, state.qx + at,     state.qy + at,          state.qz + at};
  clear_first(sums);
  const Row* const first = model.row + plane.row_begin;
  const Row* const end = model.row + (&plane)[1].row_begin;
  const Row* row = first;   // the first row without sums
  const Row* open = first;  // the first row that is not matched to its end
  const Window* const windows = kList == 0 ? model.window8 : model.window16;
  const Window* window = windows + plane.window_begin[kList];
  std::uint32_t front = 0;
  Carry carry = {};
  for (std::uint32_t from = 0; from < count; from += kChunk) {
    const std::uint32_t lanes = count - from < kChunk ? count - from : kChunk;
    row = sum_rows(places, sums, row, end, at + front, from + kChunk - front);
    match_slots(head, head.level[plane.level], slots, from, front, lanes, carry);
    for (; open != row && open->slot + open->count < at + from + lanes; ++open) {
    }
    const Window* const to =
        windows + (open == end ? plane.window_end[kList] : open->window[kList]);
    window =
        spread_windows<kUp>(sums, static_cast<std::int32_t>(front), window, to, low, high, axis);
    if (open != end) {
      const Row* const line = line_begin(first, open);
      const Row* const before = line == first ? first : line_begin(first, line - 1);
      const std::uint32_t kept = (before->slot - at) / kLanes * kLanes;
      const Row& last = row[-1];
      keep_slots(sums, kept - front, last.slot + last.count - at + 1 - front);
      front = kept;
    }
  }
}

// Velocity of a group of lanes along one axis, or momentum over mass, after the forces on it.
inline Wide pushed(const float* force, Wide per_mass, Wide hold, const float* v, const float* e,
                   float keep) {
  return keep * load(v) - per_mass * (hold * load(e) - load(force));
}

// Moves the particles of a plane. `force`: x, y, z, `particles_per_plane` apart. It is zero
// afterwards, for the next plane that uses it.
void move_particles(const Model& model, State& state, const Plane& plane, float* force,
                    Motion& motion_out) {
  const auto force_axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  const std::ptrdiff_t axis = state.uy - state.ux;  // the same from y to z, for u, v and e
  Motion motion = motion_out;
  float* u = state.ux + plane.particle_begin;
  float* v = state.vx + plane.particle_begin;
  float* e = state.ex + plane.particle_begin;
  const float* per_mass = model.step_per_mass + plane.particle_begin;
  const float* hold = model.hourglass_n_per_m + plane.particle_begin;
  // The padding is not written: the thread of the slab below may be reading it.
  for_each_group(plane, [&](std::ptrdiff_t i) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      const std::ptrdiff_t at = i + c * axis, f = i + c * force_axis;
      const Wide velocity =
          pushed(force + f, load(per_mass + i), load(hold + i), v + at, e + at, motion.keep);
      displace_lanes(bounded(velocity, motion.fastest), u + at, v + at, e + at, motion);
      store(force + f, Wide{});
    }
  });
  motion_out = motion;
}

// With true mass the particles only get their momentum here, for the filter.
void push_particles(const Model& model, State& state, const Plane& plane, float* force,
                    const Motion& motion) {
  const auto force_axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  const std::ptrdiff_t axis = state.wy - state.wx;  // the same as for e
  float* w = state.wx + plane.particle_begin;
  const float* e = state.ex + plane.particle_begin;
  const float* per_mass = model.step_per_mass + plane.particle_begin;
  const float* hold = model.hourglass_n_per_m + plane.particle_begin;
  for_each_group(plane, [&](std::ptrdiff_t i) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      const std::ptrdiff_t at = i + c * axis, f = i + c * force_axis;
      const Wide momentum =
          pushed(force + f, load(per_mass + i), load(hold + i), w + at, e + at, motion.keep);
      store(w + at, bounded(momentum, motion.most_momentum));
      store(force + f, Wide{});
    }
  });
}

// Adds the weight of the particles of a plane. Tied nodes each get all of their particle's.
void weigh_particles(const Model& model, const State& state, const Plane& plane, float* force) {
  const auto axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  const Vec3 g = gravity_now(model, state);
  const float* kg = model.particle_kg + plane.particle_begin;
  for_each_group(plane, [&](std::ptrdiff_t i) {
    const Wide mass = load(kg + i);
    store(force + i, load(force + i) + mass * g.x);
    store(force + i + axis, load(force + i + axis) + mass * g.y);
    store(force + i + 2 * axis, load(force + i + 2 * axis) + mass * g.z);
  });
}

// Adds what parts that slide press on each other.
void take_slides(const Model& model, const Scratch& scratch, const Plane& plane, float* force) {
  const auto force_axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  const std::ptrdiff_t axis = model.head->counts.slid_particles;
  const float* const from = scratch.slide_force + plane.particle_begin;
  for_each_group(plane, [&](std::ptrdiff_t i) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      float* const to = force + (i + c * force_axis);
      store(to, load(to) + load(from + (i + c * axis)));
    }
  });
}

// Applies all forces on the particles of a plane.
void finish_particles(const Model& model, State& state, Scratch& scratch, const Plane& plane,
                      float* force, Motion& motion) {
  add_changes(model, scratch, static_cast<std::uint32_t>(&plane - model.plane), force);
  if (has_slides(model)) take_slides(model, scratch, plane, force);
  join_tied(model.tie + plane.tie_begin, model.tie + plane.tie_end, force, plane.particle_begin,
            model.head->counts.particles_per_plane);
  if (has_weight(model)) weigh_particles(model, state, plane, force);
  if (has_true_mass(model)) {
    push_particles(model, state, plane, force, motion);
  } else {
    move_particles(model, state, plane, force, motion);
  }
}

float largest_displacement(const Motion& motion) {
  std::int32_t largest = 0;
  for (std::uint32_t i = 0; i < kWide; ++i) {
    largest = largest > motion.largest[i] ? largest : motion.largest[i];
  }
  return __builtin_bit_cast(float, largest);
}

// Sets the forces on the particles of any plane to zero.
void clear(const Model& model, float* force) {
  const auto axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  const float* const end = force + axis;
  for (force += kLanes; force != end; force += kWide) {  // the first group is padding
    store(force, Wide{});
    store(force + axis, Wide{});
    store(force + 2 * axis, Wide{});
  }
}

// Adds forces on the particles of a plane to others, and sets the added ones to zero.
void take_forces(const Model& model, const Plane& plane, float* more, float* force) {
  const auto axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  const std::ptrdiff_t count = plane.particle_end - plane.particle_begin;
  for (std::ptrdiff_t i = kLanes; i < count; i += kWide) {
    for (std::ptrdiff_t at = i; at < i + 3 * axis; at += axis) {
      store(force + at, load(force + at) + load(more + at));
      store(more + at, Wide{});
    }
  }
}

// Fetches early the lines that another thread's cache has and this thread will write: x, y and z of
// a plane's particles, `axis` apart. Stores are done in order, so they would wait for these lines
// one after the other (two threads at 20 000 voxels: 3 % of the step). Lines that are only read are
// not fetched: at a step's start the other thread needs them, too, and fetching gained no time.
void fetch(const Plane& plane, const float* at, std::ptrdiff_t axis) {
  const std::ptrdiff_t count = plane.particle_end - plane.particle_begin;
  for (std::ptrdiff_t i = kLanes; i < count; i += kLanes) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) __builtin_prefetch(at + i + c * axis, 1);
  }
}

// Moves the particles between two parts that are swept apart, once both have sent their forces and
// gone on by a plane: by then the other thread's lines are here.
void move_between(const Model& model, State& state, Scratch& scratch, Part& part, Motion& motion) {
  if (part.moved || part.apart == nullptr) return;
  if (part.apart->slab->begun.load(std::memory_order_acquire) == 0) return;
  const Plane& between = model.plane[part.first + 1];
  if (!part.fetched) {
    fetch(between, state.ex + between.particle_begin, state.ey - state.ex);
    fetch(between, part.apart->kept, model.head->counts.particles_per_plane);
    part.fetched = true;
    return;
  }
  take_forces(model, between, part.apart->kept, part.kept);
  finish_particles(model, state, scratch, between, part.kept, motion);
  part.moved = true;
}

// Sweeps the first voxel plane of a part and as many of the following ones as it gets, and moves
// the particles between them. Particles at the part's ends stay, unless they are the lattice's ends
// or move_between's. The part keeps the forces on them.
void sweep_planes(const Model& model, State& state, Scratch& scratch, Part& part, Motion& motion) {
  const Plane* const plane = model.plane;
  const std::uint32_t top = model.head->counts.planes;
  const std::size_t size = 3 * std::size_t{model.head->counts.particles_per_plane};
  const bool up = goes_up(part);
  const std::uint32_t behind = up ? 0 : 1, ahead = 1 - behind;  // of a voxel plane's particles
  float* here = part.kept;
  float* next = nullptr;
  std::uint32_t z = part.first;
  part.fetched = part.moved = false;
  for (bool more = true; more; here = next) {
    next = scratch.force + (z + 1) % 2 * size;
    if (up) {
      sweep_plane<true>(model, state, scratch, plane[z], here, next);
    } else {
      sweep_plane<false>(model, state, scratch, plane[z], next, here);
    }
    if (z == part.first && !part.helping) part.slab->begun.store(1, std::memory_order_release);
    const std::uint32_t done = z + behind;
    const bool move = z != part.first || done == 0 || done == top;
    if (move) finish_particles(model, state, scratch, plane[done], here, motion);
    move_between(model, state, scratch, part, motion);
    more = take_plane(part);
    z += more ? ahead - behind : 0;
  }
  const std::uint32_t last = z + ahead;
  if (last == 0 || last == top) finish_particles(model, state, scratch, plane[last], here, motion);
  part.begin = up ? part.first : z;
  part.planes = (up ? z - part.first : part.first - z) + 1;
  part.low = up ? part.kept : here;
  part.high = up ? here : part.kept;
}

// The more a short wave is slowed, the more of its momentum goes into no velocity: with the bound
// of seven passes, tissue of several levels that was crushed lost so much that it gained energy.
Motion start_motion(const ModelHead& head) {
  const float fastest =
      kMaxEdgesPerSubstep * head.level[head.counts.levels - 1].edge_m / head.substep_s;
  return {head.substep_s, head.config.tissue_damping_s,
          1 - head.substep_s * head.config.surround_drag_per_s, fastest,
          fastest * max_of(head.shadows.most_slowed, 1)};
}

// Groups of coupled voxels [begin, end) whose voxels are all in one slab.
struct Groups {
  std::uint32_t begin, end;
};
Groups groups_within(const Scratch& scratch, const Slab& slab) {
  const std::uint32_t first = scratch.plane_first[slab.begin];
  const std::uint32_t end = scratch.plane_first[slab.end];
  const bool last = end == scratch.head->coupled_count;
  return {(first + kLanes - 1) / kLanes, last ? group_count(scratch) : end / kLanes};
}

// The other groups, whose voxels are in two slabs or more.
void match_between(const Model& model, State& state, Scratch& scratch, const Team& team) {
  std::uint32_t next = 0;
  for (std::uint32_t s = 0; s < team.slab_count; ++s) {
    const Groups own = groups_within(scratch, team.slab[s]);
    match_groups(model, state, scratch, next, own.begin);
    next = std::max({next, own.begin, own.end});
  }
}

// Uses the part's own scratch (lattice/team.h).
void sweep_part(const Kernel& kernel, Part& part) {
  View view = view_of(kernel);
  view.scratch.sums = part.sums;
  view.scratch.force = part.force;
  Motion motion = start_motion(*view.model.head);
  part.planes = 0;
  if (!part.helping) {
    const Groups own = groups_within(view.scratch, *part.slab);
    match_groups(view.model, view.state, view.scratch, own.begin, own.end);
    sweep_planes(view.model, view.state, view.scratch, part, motion);
  } else if (take_plane(part)) {
    sweep_planes(view.model, view.state, view.scratch, part, motion);
  }
  part.largest_m = largest_displacement(motion);
}

// Filters the particles at the low sides of a slab's planes; for the last slab also those at its
// high side.
void filter_part(const Kernel& kernel, Part& part) {
  part.planes = 0;
  part.largest_m = 0;
  if (part.helping) return;
  View view = view_of(kernel);
  Motion motion = start_motion(*view.model.head);
  const Slab& slab = *part.slab;
  const bool last = slab.end == view.model.head->counts.planes;
  filter_planes(view.model, view.state, view.scratch, slab.begin, last ? slab.end + 1 : slab.end,
                part.filter, motion);
  part.planes = slab.end - slab.begin;
  part.largest_m = largest_displacement(motion);
}

void join(Motion& motion, const Part& part) {
  const auto size = __builtin_bit_cast(std::int32_t, part.largest_m);
  if (size > motion.largest[0]) motion.largest[0] = size;
}

// Joins a part, if it has any planes, to the one `below`, and moves the particles between them.
// Returns the part that is below the next one.
const Part* join_part(const Model& model, State& state, Scratch& scratch, const Part* below,
                      const Part& part, Motion& motion) {
  join(motion, part);
  if (part.planes == 0) return below;
  if (below != nullptr && !below->moved) {
    const Plane& plane = model.plane[part.begin];
    take_forces(model, plane, part.low, below->high);
    finish_particles(model, state, scratch, plane, below->high, motion);
  }
  return &part;
}

}  // namespace

void STYLET_LATTICE_STEP(const Kernel& kernel) {
  View view = view_of(kernel);
  const ModelHead& head = *view.model.head;
  Motion motion = start_motion(head);
  place_members(view.model, view.state, view.scratch);
  if (team_of(kernel) == nullptr) {
    match_groups(view.model, view.state, view.scratch, 0, group_count(view.scratch));
    Slab all = {};
    all.end = head.counts.planes;
    Part whole = {};
    whole.slab = &all;
    whole.up = true;
    whole.kept = view.scratch.force;
    clear(view.model, view.scratch.force);
    clear(view.model, view.scratch.force + 3 * std::size_t{head.counts.particles_per_plane});
    sweep_planes(view.model, view.state, view.scratch, whole, motion);
    if (is_graded(view.model)) {
      finish_graded(view.model, view.state, view.scratch, motion);
    } else if (has_true_mass(view.model)) {
      filter_planes(view.model, view.state, view.scratch, 0, head.counts.planes + 1,
                    view.scratch.filter, motion);
    }
  } else {
    const Team& team = *team_of(kernel);
    match_between(view.model, view.state, view.scratch, team);
    sweep_together(kernel, sweep_part);
    const Part* below = nullptr;
    for (std::uint32_t s = 0; s < team.slab_count; ++s) {
      const Part &own = team.part[s], &helping = team.part[team.slab_count + s];
      below =
          join_part(view.model, view.state, view.scratch, below, own.up ? own : helping, motion);
      below =
          join_part(view.model, view.state, view.scratch, below, own.up ? helping : own, motion);
    }
    if (is_graded(view.model)) {
      finish_graded(view.model, view.state, view.scratch, motion);
    } else if (has_true_mass(view.model)) {
      sweep_together(kernel, filter_part);
      for (std::uint32_t s = 0; s < team.slab_count; ++s) join(motion, team.part[s]);
    }
  }
  view.state.head->max_displacement_m = largest_displacement(motion);
}

}  // namespace stylet
