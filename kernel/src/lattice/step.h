// SPDX-License-Identifier: Apache-2.0
// Body of the lattice sweep, included once per instruction set by lattice_<isa>.cpp with
// STYLET_LATTICE_STEP naming the function. See lattice.h for physics and promises.
//
// Per voxel plane: 1 sums and differences of the eight corners, row by row; 2 rotation of each
// cluster and what a row sends to its nodes, over all slots in full lanes, as soon as some dozens
// are summed; 3 each window of nodes collects what the voxel rows at its sides send
// (lattice/plan.h), as soon as both are fitted; then the particles of the plane's low side have all
// their forces and move (with true mass: get their momentum, and lattice/filter_passes.h moves
// them). Some rows of clusters and two planes of forces stay in cache; nothing else is stored. (A
// whole plane of clusters was: it leaves the nearest cache, 8 % more time.)
//
// Voxels that hold constraint particles are fitted before the sweep, all together: plane by plane
// each few of them cost the time of a full group of lanes, at 5000 voxels 7 % of the step.

#include <algorithm>

#include "base/lanes.h"
#include "lattice/filter_passes.h"
#include "lattice/fit_lanes.h"
#include "lattice/lattice.h"
#include "lattice/rotation.h"
#include "lattice/team.h"

namespace stylet {
namespace {

// As kQuantum, of rotations.
constexpr float kQuantumTurn = 1.953125e-3F;  // 2^-9: quaternion parts to 2e-10

// Twelve arrays over some slots of a plane, `stride` apart: for each component of the displacement
// its sum over the corners, then its gradient along x, y, z. After stage 2: what is sent
// (send_slots).
struct Sums {
  float* at;
  std::ptrdiff_t stride;

  float* of(std::ptrdiff_t component, std::ptrdiff_t which) const {
    return at + (4 * component + which) * stride;
  }
};
Sums sums_of(const Model& model, Scratch& scratch) {
  return {scratch.sums, static_cast<std::ptrdiff_t>(model.head->counts.slots_at_once)};
}

// Where nodes are. Read once a plane: behind every store of a float it would be read again.
struct Places {
  const float* ex;
  std::ptrdiff_t next_axis;  // from ex to ey, and from there to ez
};

// Stage 1 for one component of eight corners; `n` are the first nodes of the four rows.
inline void sum_corners(const float* const n[4], std::ptrdiff_t offset, float* to,
                        std::ptrdiff_t stride) {
  const Wide a0 = load(n[0] + offset), b0 = load(n[0] + offset + 1), s0 = a0 + b0, d0 = b0 - a0;
  const Wide a1 = load(n[1] + offset), b1 = load(n[1] + offset + 1), s1 = a1 + b1, d1 = b1 - a1;
  const Wide a2 = load(n[2] + offset), b2 = load(n[2] + offset + 1), s2 = a2 + b2, d2 = b2 - a2;
  const Wide a3 = load(n[3] + offset), b3 = load(n[3] + offset + 1), s3 = a3 + b3, d3 = b3 - a3;
  const Wide low = s0 + s1, high = s2 + s3;
  store(to, low + high);
  store(to + stride, (d0 + d1) + (d2 + d3));
  store(to + 2 * stride, (s1 - s0) + (s3 - s2));
  store(to + 3 * stride, high - low);
}

// Stage 1 for rows up to the first that begins at slot `until` of the plane or later; returns that.
// What the last lanes write beyond a row's end is written again by the next row.
STYLET_KEEP_APART const Row* sum_rows(Places places, Sums sums, const Row* row, const Row* end,
                                      std::uint32_t plane_slot, std::uint32_t until) {
  const float* const e = places.ex;
  for (; row != end && row->slot - plane_slot < until; ++row) {
    const float* n[4] = {e + row->node[0], e + row->node[1], e + row->node[2], e + row->node[3]};
    float* to = sums.at + (row->slot - plane_slot);
    for (const float* const last = to + row->count; to <= last; to += kWide) {
      sum_corners(n, 0, to, sums.stride);
      sum_corners(n, places.next_axis, to + 4 * sums.stride, sums.stride);
      sum_corners(n, 2 * places.next_axis, to + 8 * sums.stride, sums.stride);
      for (const float*& node : n) node += kWide;
    }
  }
  return row;
}

// The first slot, before all rows, passes through stage 2 as well: gives it numbers.
void clear_first(const Sums& sums) {
  for (std::ptrdiff_t k = 0; k < 12; ++k) sums.at[k * sums.stride] = 0;
}

// Stage 2 is five loops, for as many lanes at a time as stay in the nearest cache. As one loop it
// takes fewer instructions, but the whole step a quarter more time: a group of lanes is a chain of
// three roots and a division, so long that the processor sees little of the next group beside it,
// and waits. Each of the first four therefore has one of them: all the rest of a loop is time in
// which the slow unit that makes them is done with the group before.

// What passes from loop to loop, in whole registers: where it lay across lines of the cache the
// step took 4 % more time. Later numbers take the place of those that are done with: 1 % less.
struct alignas(64) Seen {
  float ax[kChunk], ay[kChunk], az[kChunk];  // K's side, then the quaternion's x, y, z
  float sx[kChunk], sy[kChunk], sz[kChunk], sxy[kChunk], sxz[kChunk], syz[kChunk];  // its block
  float shift[kChunk];   // the block's bound, then lambda, then the quaternion's w
  float corner[kChunk];  // K's corner, then the quaternion's length
};

// What stage 2 reads and writes, from some slot of a plane on.
struct Slots {
  Sums sums;
  const float *stiffness, *volume;
  float *qw, *qx, *qy, *qz;
};

STYLET_KEEP_APART void see_slots(std::uint32_t lanes, const Slots& slots, float one,
                                 Seen& seen_out) {
  const float* g0 = slots.sums.of(0, 1);
  const float* g1 = slots.sums.of(0, 2);
  const float* g2 = slots.sums.of(0, 3);
  const float* g3 = slots.sums.of(1, 1);
  const float* g4 = slots.sums.of(1, 2);
  const float* g5 = slots.sums.of(1, 3);
  const float* g6 = slots.sums.of(2, 1);
  const float* g7 = slots.sums.of(2, 2);
  const float* g8 = slots.sums.of(2, 3);
  const float *qw = slots.qw, *qx = slots.qx, *qy = slots.qy, *qz = slots.qz;
  lanes = lanes / kLanes * kLanes;
  STYLET_VECTOR
  for (std::uint32_t i = 0; i < lanes; ++i) {
    const Davenport<float> k = davenport(one + g0[i], g1[i], g2[i], g3[i], one + g4[i], g5[i],
                                         g6[i], g7[i], one + g8[i], qw[i], qx[i], qy[i], qz[i]);
    seen_out.ax[i] = k.ax;
    seen_out.ay[i] = k.ay;
    seen_out.az[i] = k.az;
    seen_out.sx[i] = k.sx;
    seen_out.sy[i] = k.sy;
    seen_out.sz[i] = k.sz;
    seen_out.sxy[i] = k.sxy;
    seen_out.sxz[i] = k.sxz;
    seen_out.syz[i] = k.syz;
    seen_out.corner[i] = k.rho;
    seen_out.shift[i] = block_bound(k);
  }
}

STYLET_KEEP_APART void shift_slots(std::uint32_t lanes, float one, Seen& seen) {
  const float tiny = 1e-5F * one;
  lanes = lanes / kLanes * kLanes;
  STYLET_VECTOR
  for (std::uint32_t i = 0; i < lanes; ++i) {
    seen.shift[i] =
        shift_for(seen.corner[i], seen.ax[i], seen.ay[i], seen.az[i], seen.shift[i], tiny);
  }
}

STYLET_KEEP_APART void turn_slots(std::uint32_t lanes, const Slots& slots, Seen& seen) {
  const float *qw = slots.qw, *qx = slots.qx, *qy = slots.qy, *qz = slots.qz;
  lanes = lanes / kLanes * kLanes;
  STYLET_VECTOR
  for (std::uint32_t i = 0; i < lanes; ++i) {
    const float lambda = seen.shift[i];
    const Correction<float> by =
        correction(lambda - seen.sx[i], lambda - seen.sy[i], lambda - seen.sz[i], seen.sxy[i],
                   seen.sxz[i], seen.syz[i], seen.ax[i], seen.ay[i], seen.az[i]);
    const Correction<float> p = product(by, qw[i], qx[i], qy[i], qz[i]);
    seen.shift[i] = p.w;
    seen.ax[i] = p.x;
    seen.ay[i] = p.y;
    seen.az[i] = p.z;
    seen.corner[i] = length(p);
  }
}

STYLET_KEEP_APART void unit_slots(std::uint32_t lanes, const Seen& seen, const Slots& slots) {
  const float* stiffness = slots.stiffness;
  float *qw = slots.qw, *qx = slots.qx, *qy = slots.qy, *qz = slots.qz;
  lanes = lanes / kLanes * kLanes;
  STYLET_VECTOR
  for (std::uint32_t i = 0; i < lanes; ++i) {
    const Correction<float> q =
        unit<float>({seen.shift[i], seen.ax[i], seen.ay[i], seen.az[i]}, seen.corner[i]);
    const float x = (q.x + kQuantumTurn) - kQuantumTurn;
    const float y = (q.y + kQuantumTurn) - kQuantumTurn;
    const float z = (q.z + kQuantumTurn) - kQuantumTurn;
    // Empty slots stay upright, whatever their neighbours do.
    const bool full = stiffness[i] > 0;
    qw[i] = full ? q.w : 1.0F;
    qx[i] = full ? x : 0.0F;
    qy[i] = full ? y : 0.0F;
    qz[i] = full ? z : 0.0F;
  }
}

// What the slots before send along their rows: for each component T + X, Y + Z, Y - Z.
struct Carry {
  Wide last[3][3];
};

// One component: what a row sends to its four nodes at the low side of each slot. `hx`, `hy`, `hz`:
// s times the column of H, but for what the gradient adds.
inline void send_component(float* at, std::ptrdiff_t stride, Wide weight, Wide sb, Wide hx, Wide hy,
                           Wide hz, Wide (&last)[3]) {
  const Wide x = hx - sb * load(at + stride);
  const Wide y = hy - sb * load(at + 2 * stride), z = hz - sb * load(at + 3 * stride);
  const Wide t = weight * load(at);
  const Wide ahead = t + x, same = y + z, other = y - z;
  const Wide along = lanes_behind(last[0], ahead) + (t - x);
  const Wide with = lanes_behind(last[1], same) + same;
  const Wide across = lanes_behind(last[2], other) + other;
  last[0] = ahead;
  last[1] = same;
  last[2] = other;
  store(at, along + across);
  store(at + stride, along + with);
  store(at + 2 * stride, along - with);
  store(at + 3 * stride, along - across);
}

// In place: sum and gradient of the displacement -> what is sent to the nodes between a row's
// slots. The corner at (+-1, +-1, +-1) gets T +- X +- Y +- Z, with T = k chi t and X, Y, Z the
// columns of k (h / 2) H; stored is the sum for the two voxels of the row that share a node: at the
// row's high side along y, of the particle planes below and above, then at its low side.
STYLET_KEEP_APART void send_slots(std::uint32_t lanes, const Slots& slots, float chi,
                                  float half_edge, float scale, Carry& carry_io) {
  // Copied: behind every store of a float they would be read again.
  const Slots own = slots;
  Carry carry = carry_io;
  const std::ptrdiff_t stride = own.sums.stride;
  float* at0 = own.sums.at;
  for (std::uint32_t i = 0; i < lanes; i += kWide, at0 += kWide) {
    float* const at1 = at0 + 4 * stride;
    float* const at2 = at0 + 8 * stride;
    // R - I, so that small rotations keep their digits; the diagonal with the other sign.
    const Wide w = load(own.qw + i), x = load(own.qx + i), y = load(own.qy + i);
    const Wide z = load(own.qz + i);
    const Wide x2 = x + x, y2 = y + y, z2 = z + z;
    const Wide xx = x * x2, yy = y * y2, zz = z * z2;
    const Wide xy = x * y2, xz = x * z2, yz = y * z2;
    const Wide wx = w * x2, wy = w * y2, wz = w * z2;
    const Wide n00 = yy + zz, r01 = xy - wz, r02 = xz + wy;
    const Wide r10 = xy + wz, n11 = xx + zz, r12 = yz - wx;
    const Wide r20 = xz - wy, r21 = yz + wx, n22 = xx + yy;
    const auto d = [&](const float* at, int b) { return load(at + (b + 1) * stride); };
    const Wide trace = ((n00 + n11) + n22) - scale * ((d(at0, 0) + d(at1, 1)) + d(at2, 2));
    const Wide inner =
        scale * (((n00 * d(at0, 0) - r01 * d(at0, 1)) - (r02 * d(at0, 2) + r10 * d(at1, 0))) +
                 ((n11 * d(at1, 1) - r12 * d(at1, 2)) - (r20 * d(at2, 0) + r21 * d(at2, 1))) +
                 n22 * d(at2, 2));
    const Wide k = load(own.stiffness + i);
    const Wide s = k * half_edge;
    const Wide sc = s * (load(own.volume + i) * (trace + inner));  // -s p
    const Wide sa = s + sc, sb = s * ((1 - chi) * scale);
    const Wide weight = k * (chi * 0.125F);
    send_component(at0, stride, weight, sb, sc - sa * n00, sa * r01, sa * r02, carry.last[0]);
    send_component(at1, stride, weight, sb, sa * r10, sc - sa * n11, sa * r12, carry.last[1]);
    send_component(at2, stride, weight, sb, sa * r20, sa * r21, sc - sa * n22, carry.last[2]);
  }
  carry_io = carry;
}

// Stage 2 for slots from `from` on, a multiple of kLanes; the sums begin with slot `front`.
__attribute__((always_inline)) inline void fit_slots(const ModelHead& head, const Slots& plane,
                                                     std::uint32_t from, std::uint32_t front,
                                                     std::uint32_t lanes, Carry& carry) {
  const Slots slots = {{plane.sums.at + (from - front), plane.sums.stride},
                       plane.stiffness + from,
                       plane.volume + from,
                       plane.qw + from,
                       plane.qx + from,
                       plane.qy + from,
                       plane.qz + from};
  Seen seen;
  see_slots(lanes, slots, 4 * head.edge_m, seen);
  shift_slots(lanes, 4 * head.edge_m, seen);
  turn_slots(lanes, slots, seen);
  unit_slots(lanes, seen, slots);
  send_slots(lanes, slots, head.hourglass_weight, head.edge_m * 0.5F,
             head.inverse_edge_per_m * 0.25F, carry);
}

// Stage 3 for windows up to `end`. Forces on the particles at the side the sweep comes from join
// those from the clusters there; on the others they are set. Windows in order, so that the zeros
// which their last lanes write beyond the end of a line are written over by the next line. `low`
// and `high`: x, y, z, `axis` apart. The sums begin with slot `front`.
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
        // What is set and not read is in a farther cache by now, and stores wait for it one by one:
        // 5 % of the time of 20 000 voxels.
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

// Moves what is sent by slots from `from` up to `end`, and their sums, to the front.
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

// All stages for a voxel plane. The last line of rows that is fitted stays for the line of nodes
// behind it, and rows begun with the chunk for the next.
template <bool kUp>
void sweep_plane(const Model& model, State& state, Scratch& scratch, const Plane& plane, float* low,
                 float* high) {
  constexpr std::uint32_t kList = kWide > 8 ? 1 : 0;
  const ModelHead& head = *model.head;
  const std::uint32_t at = plane.slot_begin, count = plane.slot_end - plane.slot_begin;
  const auto axis = static_cast<std::ptrdiff_t>(head.counts.particles_per_plane);
  const Places places = {state.ex, state.ey - state.ex};
  const Sums sums = sums_of(model, scratch);
  const Slots slots = {sums,          model.slot_k + at, model.slot_volume + at, state.qw + at,
                       state.qx + at, state.qy + at,     state.qz + at};
  clear_first(sums);
  const Row* const first = model.row + plane.row_begin;
  const Row* const end = model.row + (&plane)[1].row_begin;
  const Row* row = first;   // the first without sums
  const Row* open = first;  // the first that is not fitted to its end
  const Window* const windows = kList == 0 ? model.window8 : model.window16;
  const Window* window = windows + plane.window_begin[kList];
  std::uint32_t front = 0;
  Carry carry = {};
  for (std::uint32_t from = 0; from < count; from += kChunk) {
    const std::uint32_t lanes = count - from < kChunk ? count - from : kChunk;
    row = sum_rows(places, sums, row, end, at + front, from + kChunk - front);
    fit_slots(head, slots, from, front, lanes, carry);
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

// Moves the particles of a plane. `force`: x, y, z, `particles_per_plane` apart; zero afterwards,
// for the next plane that uses it.
void move_particles(const Model& model, State& state, const Plane& plane, float* force,
                    Motion& motion_out) {
  const auto force_axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  const std::ptrdiff_t axis = state.uy - state.ux;  // as from y to z, for u, v and e
  Motion motion = motion_out;
  float* u = state.ux + plane.particle_begin;
  float* v = state.vx + plane.particle_begin;
  float* e = state.ex + plane.particle_begin;
  const float* per_mass = model.step_per_mass + plane.particle_begin;
  const float* hold = model.hold + plane.particle_begin;
  // The padding is not written: the slab below may read it meanwhile.
  for_each_group(plane, [&](std::ptrdiff_t i) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      const std::ptrdiff_t at = i + c * axis, f = i + c * force_axis;
      const Wide velocity =
          pushed(force + f, load(per_mass + i), load(hold + i), v + at, e + at, motion.keep);
      displace_lanes(bounded(velocity, motion), u + at, v + at, e + at, motion);
      store(force + f, Wide{});
    }
  });
  motion_out = motion;
}

// With true mass the particles get their momentum only, for the filter.
void push_particles(const Model& model, State& state, const Plane& plane, float* force,
                    const Motion& motion) {
  const auto force_axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  const std::ptrdiff_t axis = state.wy - state.wx;  // as that of e
  float* w = state.wx + plane.particle_begin;
  const float* e = state.ex + plane.particle_begin;
  const float* per_mass = model.step_per_mass + plane.particle_begin;
  const float* hold = model.hold + plane.particle_begin;
  for_each_group(plane, [&](std::ptrdiff_t i) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      const std::ptrdiff_t at = i + c * axis, f = i + c * force_axis;
      const Wide momentum =
          pushed(force + f, load(per_mass + i), load(hold + i), w + at, e + at, motion.keep);
      store(w + at, bounded(momentum, motion));
      store(force + f, Wide{});
    }
  });
}

// What all forces on the particles of a plane do to them.
void finish_particles(const Model& model, State& state, Scratch& scratch, const Plane& plane,
                      float* force, Motion& motion) {
  add_changes(model, scratch, static_cast<std::uint32_t>(&plane - model.plane), force);
  if (plane.tie_begin != plane.tie_end) join_tied(model, plane, force);
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

// Forces on the particles of any plane, to zero.
void clear(const Model& model, float* force) {
  const auto axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  const float* const end = force + axis;
  for (force += kLanes; force != end; force += kWide) {  // the first group is padding
    store(force, Wide{});
    store(force + axis, Wide{});
    store(force + 2 * axis, Wide{});
  }
}

// Adds forces on the particles of a plane to others, and sets them to zero.
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

// Asks early for lines that another thread's cache has and that are to be written: x, y and z of a
// plane's particles, `axis` apart. Stores are done in order, so these would wait for one line after
// the other (two threads at 20 000 voxels: 3 % of the step). What is only read is not asked for: at
// the start of a step the other thread needs these lines, too, and no time was gained by it.
void fetch(const Plane& plane, const float* at, std::ptrdiff_t axis) {
  const std::ptrdiff_t count = plane.particle_end - plane.particle_begin;
  for (std::ptrdiff_t i = kLanes; i < count; i += kLanes) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) __builtin_prefetch(at + i + c * axis, 1);
  }
}

// Moves the particles between two parts that are swept apart, a plane after both have sent their
// forces: by then the other thread's lines are here.
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

// Sweeps the first voxel plane of a part and as many of those that follow as it gets, and moves the
// particles between them. Those at its ends stay, unless they are the lattice's or move_between's,
// and the part has the forces on them.
void sweep_planes(const Model& model, State& state, Scratch& scratch, Part& part, Motion& motion) {
  const Plane* const plane = model.plane;
  const std::uint32_t top = model.head->counts.planes;
  const std::size_t size = 3 * std::size_t{model.head->counts.particles_per_plane};
  const std::uint32_t behind = part.up ? 0 : 1, ahead = 1 - behind;  // of a voxel plane's particles
  float* here = part.kept;
  float* next = nullptr;
  std::uint32_t z = part.first;
  part.fetched = part.moved = false;
  for (bool more = true; more; here = next) {
    next = scratch.force + (z + 1) % 2 * size;
    if (part.up) {
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
  part.begin = part.up ? part.first : z;
  part.planes = (part.up ? z - part.first : part.first - z) + 1;
  part.low = part.up ? part.kept : here;
  part.high = part.up ? here : part.kept;
}

Motion start_motion(const ModelHead& head) {
  return {head.substep_s, head.config.tissue_damping_s,
          1 - head.substep_s * head.config.surround_drag_per_s,
          kMaxEdgesPerSubstep * head.edge_m / head.substep_s};
}

// Groups of coupled voxels [begin, end) that have all their voxels in a slab.
struct Groups {
  std::uint32_t begin, end;
};
Groups groups_within(const Scratch& scratch, const Slab& slab) {
  const std::uint32_t first = scratch.plane_first[slab.begin];
  const std::uint32_t end = scratch.plane_first[slab.end];
  const bool last = end == scratch.head->coupled_count;
  return {(first + kLanes - 1) / kLanes, last ? group_count(scratch) : end / kLanes};
}

// The other groups, which two slabs or more have voxels of.
void fit_between(const Model& model, State& state, Scratch& scratch, const Team& team) {
  std::uint32_t next = 0;
  for (std::uint32_t s = 0; s < team.slab_count; ++s) {
    const Groups own = groups_within(scratch, team.slab[s]);
    fit_groups(model, state, scratch, next, own.begin);
    next = std::max({next, own.begin, own.end});
  }
}

// In scratch of its own (lattice/team.h).
void sweep_part(const Kernel& kernel, Part& part) {
  View view = view_of(kernel);
  view.scratch.sums = part.sums;
  view.scratch.force = part.force;
  Motion motion = start_motion(*view.model.head);
  part.planes = 0;
  if (!part.helping) {
    const Groups own = groups_within(view.scratch, *part.slab);
    fit_groups(view.model, view.state, view.scratch, own.begin, own.end);
    sweep_planes(view.model, view.state, view.scratch, part, motion);
  } else if (take_plane(part)) {
    sweep_planes(view.model, view.state, view.scratch, part, motion);
  }
  part.largest_m = largest_displacement(motion);
}

// The particles of a slab: those at its low side, and the last one's also at its high side.
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
// Returns what is below the next.
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
    fit_groups(view.model, view.state, view.scratch, 0, group_count(view.scratch));
    Slab all = {};
    all.end = head.counts.planes;
    Part whole = {};
    whole.slab = &all;
    whole.up = true;
    whole.kept = view.scratch.force;
    clear(view.model, view.scratch.force);
    clear(view.model, view.scratch.force + 3 * std::size_t{head.counts.particles_per_plane});
    sweep_planes(view.model, view.state, view.scratch, whole, motion);
    if (has_true_mass(view.model)) {
      filter_planes(view.model, view.state, view.scratch, 0, head.counts.planes + 1,
                    view.scratch.filter, motion);
    }
  } else {
    const Team& team = *team_of(kernel);
    fit_between(view.model, view.state, view.scratch, team);
    sweep_together(kernel, sweep_part);
    const Part* below = nullptr;
    for (std::uint32_t s = 0; s < team.slab_count; ++s) {
      const Part &own = team.part[s], &helping = team.part[team.slab_count + s];
      below =
          join_part(view.model, view.state, view.scratch, below, own.up ? own : helping, motion);
      below =
          join_part(view.model, view.state, view.scratch, below, own.up ? helping : own, motion);
    }
    if (has_true_mass(view.model)) {
      sweep_together(kernel, filter_part);
      for (std::uint32_t s = 0; s < team.slab_count; ++s) join(motion, team.part[s]);
    }
  }
  view.state.head->max_displacement_m = largest_displacement(motion);
}

}  // namespace stylet
