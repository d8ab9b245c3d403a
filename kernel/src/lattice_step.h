// SPDX-License-Identifier: Apache-2.0
// Body of the lattice sweep, included once per instruction set by lattice_<isa>.cpp with
// STYLET_LATTICE_STEP naming the function. See lattice.h for physics and promises.
//
// Per voxel plane: 1 sums and differences of the eight corners, row by row; 2 rotation and the four
// vectors each cluster sends to its corners, over all slots in full lanes, as soon as some dozens
// are summed; 3 each window of nodes collects what the voxel rows at its sides send
// (lattice_plan.h); then the particles of the plane's low side have all their forces and move. A
// plane of clusters and two of forces stay in cache; nothing else is stored.

#include "fit_lanes.h"
#include "lanes.h"
#include "lattice.h"
#include "lattice_team.h"
#include "rotation.h"

namespace stylet {
namespace {

// Smallest steps of velocity, displacement and rotation: keeps denormals (20 times slower, and
// rounded differently by processors that flush them) out of the state.
constexpr float kQuantum = 1.52587890625e-05F;  // 2^-16: displacements and velocities to 2e-12
constexpr float kQuantumTurn = 1.953125e-3F;    // 2^-9: quaternion parts to 2e-10

// Twelve arrays over the slots of a plane, `stride` apart: for each component of the displacement
// its sum over the corners, then its gradient along x, y, z. After stage 2: what is sent, as T + X,
// T - X, Y + Z, Y - Z (send_slots).
struct Sums {
  float* at;
  std::ptrdiff_t stride;

  float* of(std::ptrdiff_t component, std::ptrdiff_t which) const {
    return at + (4 * component + which) * stride;
  }
};
Sums sums_of(const View& view) {
  return {view.scratch.sums, static_cast<std::ptrdiff_t>(view.model.head->counts.slots_per_plane)};
}

// Where nodes are. Read once a plane: behind every store of a float it would be read again.
struct Places {
  const float* ex;
  std::ptrdiff_t next_axis;  // from ex to ey, and from there to ez
  float inverse_edge_4;
};

// Stage 1 for one component of eight corners; `n` are the first nodes of the four rows.
inline void sum_corners(const float* const n[4], std::ptrdiff_t offset, float inverse_edge_4,
                        float* to, std::ptrdiff_t stride) {
  const Wide a0 = load(n[0] + offset), b0 = load(n[0] + offset + 1), s0 = a0 + b0, d0 = b0 - a0;
  const Wide a1 = load(n[1] + offset), b1 = load(n[1] + offset + 1), s1 = a1 + b1, d1 = b1 - a1;
  const Wide a2 = load(n[2] + offset), b2 = load(n[2] + offset + 1), s2 = a2 + b2, d2 = b2 - a2;
  const Wide a3 = load(n[3] + offset), b3 = load(n[3] + offset + 1), s3 = a3 + b3, d3 = b3 - a3;
  const Wide low = s0 + s1, high = s2 + s3;
  store(to, low + high);
  store(to + stride, ((d0 + d1) + (d2 + d3)) * inverse_edge_4);
  store(to + 2 * stride, ((s1 - s0) + (s3 - s2)) * inverse_edge_4);
  store(to + 3 * stride, (high - low) * inverse_edge_4);
}

// Stage 1 for rows up to the first that begins at slot `until` of the plane or later; returns that.
// What the last lanes write beyond a row's end is written again by the next row.
STYLET_KEEP_APART const Row* sum_rows(Places places, Sums sums, const Row* row, const Row* end,
                                      std::uint32_t plane_slot, std::uint32_t until) {
  const float* const e = places.ex;
  const std::ptrdiff_t end_axis = 3 * places.next_axis;
  for (; row != end && row->slot - plane_slot < until; ++row) {
    const float* n[4] = {e + row->node[0], e + row->node[1], e + row->node[2], e + row->node[3]};
    float* to = sums.at + (row->slot - plane_slot);
    for (const float* const last = to + row->count; to <= last; to += kWide) {
      float* component = to;
      // Counted by offset, so that compilers leave it a loop: 20 000 voxels take 10.9 ns each with
      // AVX-512, unrolled 11.9.
      for (std::ptrdiff_t axis = 0; axis != end_axis; axis += places.next_axis) {
        sum_corners(n, axis, places.inverse_edge_4, component, sums.stride);
        component += 4 * sums.stride;
      }
      for (const float*& node : n) node += kWide;
    }
  }
  return row;
}

// The first slot, before all rows, passes through stage 2 as well: gives it numbers.
void clear_first(const Sums& sums) {
  for (std::ptrdiff_t k = 0; k < 12; ++k) sums.at[k * sums.stride] = 0;
}

// Stage 2 is three loops, for as many lanes at a time as stay in the nearest cache. As one loop it
// takes 4 % fewer instructions, but the whole step a fifth more time with AVX-512 and a third more
// with AVX2: a group of lanes is a chain of three roots and a division, so long that the processor
// sees little of the next group beside it, and waits.

// What passes from the first loop to the second.
constexpr std::uint32_t kChunk = 192;
static_assert(kChunk % kLanes == 0);
struct Seen {
  float ax[kChunk], ay[kChunk], az[kChunk];
  float mxx[kChunk], myy[kChunk], mzz[kChunk], sxy[kChunk], sxz[kChunk], syz[kChunk];
};

// What stage 2 reads and writes, from some slot of a plane on.
struct Slots {
  Sums sums;
  const float *stiffness, *volume;
  float *qw, *qx, *qy, *qz;
};

STYLET_KEEP_APART void see_slots(std::uint32_t lanes, const Slots& slots, Seen& seen_out) {
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
    const Davenport<float> k = davenport<0>(1 + g0[i], g1[i], g2[i], g3[i], 1 + g4[i], g5[i], g6[i],
                                            g7[i], 1 + g8[i], qw[i], qx[i], qy[i], qz[i]);
    seen_out.ax[i] = k.ax;
    seen_out.ay[i] = k.ay;
    seen_out.az[i] = k.az;
    seen_out.mxx[i] = k.lambda - k.sx;
    seen_out.myy[i] = k.lambda - k.sy;
    seen_out.mzz[i] = k.lambda - k.sz;
    seen_out.sxy[i] = k.sxy;
    seen_out.sxz[i] = k.sxz;
    seen_out.syz[i] = k.syz;
  }
}

STYLET_KEEP_APART void turn_slots(std::uint32_t lanes, const Seen& seen, const Slots& slots) {
  const float* stiffness = slots.stiffness;
  float *qw = slots.qw, *qx = slots.qx, *qy = slots.qy, *qz = slots.qz;
  lanes = lanes / kLanes * kLanes;
  STYLET_VECTOR
  for (std::uint32_t i = 0; i < lanes; ++i) {
    const Correction<float> by =
        correction(seen.mxx[i], seen.myy[i], seen.mzz[i], seen.sxy[i], seen.sxz[i], seen.syz[i],
                   seen.ax[i], seen.ay[i], seen.az[i]);
    float w = qw[i], x = qx[i], y = qy[i], z = qz[i];
    turn(by, w, x, y, z);
    x = (x + kQuantumTurn) - kQuantumTurn;
    y = (y + kQuantumTurn) - kQuantumTurn;
    z = (z + kQuantumTurn) - kQuantumTurn;
    // Empty slots stay upright, whatever their neighbours do.
    const bool full = stiffness[i] > 0;
    qw[i] = full ? w : 1.0F;
    qx[i] = full ? x : 0.0F;
    qy[i] = full ? y : 0.0F;
    qz[i] = full ? z : 0.0F;
  }
}

// In place: sum and gradient of the displacement -> what a cluster sends to its corners. The corner
// at (+-1, +-1, +-1) gets T +- X +- Y +- Z, with T = k chi t and X, Y, Z the columns of k (h / 2)
// H; stored are T + X, T - X, Y + Z, Y - Z: stage 3 adds these up along rows.
STYLET_KEEP_APART void send_slots(std::uint32_t lanes, const Slots& slots, float chi,
                                  float half_edge) {
  float *t0 = slots.sums.of(0, 0), *t1 = slots.sums.of(1, 0), *t2 = slots.sums.of(2, 0);
  float* g0 = slots.sums.of(0, 1);
  float* g1 = slots.sums.of(0, 2);
  float* g2 = slots.sums.of(0, 3);
  float* g3 = slots.sums.of(1, 1);
  float* g4 = slots.sums.of(1, 2);
  float* g5 = slots.sums.of(1, 3);
  float* g6 = slots.sums.of(2, 1);
  float* g7 = slots.sums.of(2, 2);
  float* g8 = slots.sums.of(2, 3);
  const float *qw = slots.qw, *qx = slots.qx, *qy = slots.qy, *qz = slots.qz;
  const float *stiffness = slots.stiffness, *volume = slots.volume;
  lanes = lanes / kLanes * kLanes;
  STYLET_VECTOR
  for (std::uint32_t i = 0; i < lanes; ++i) {
    const float d00 = g0[i], d01 = g1[i], d02 = g2[i];
    const float d10 = g3[i], d11 = g4[i], d12 = g5[i];
    const float d20 = g6[i], d21 = g7[i], d22 = g8[i];
    // R - I, so that small rotations keep their digits; the diagonal with the other sign.
    const float w = qw[i], x = qx[i], y = qy[i], z = qz[i];
    const float x2 = x + x, y2 = y + y, z2 = z + z;
    const float xx = x * x2, yy = y * y2, zz = z * z2;
    const float xy = x * y2, xz = x * z2, yz = y * z2;
    const float wx = w * x2, wy = w * y2, wz = w * z2;
    const float n00 = yy + zz, r01 = xy - wz, r02 = xz + wy;
    const float r10 = xy + wz, n11 = xx + zz, r12 = yz - wx;
    const float r20 = xz - wy, r21 = yz + wx, n22 = xx + yy;
    const float trace = ((n00 + n11) + n22) - ((d00 + d11) + d22);
    const float inner = ((n00 * d00 - r01 * d01) - (r02 * d02 + r10 * d10)) +
                        ((n11 * d11 - r12 * d12) - (r20 * d20 + r21 * d21)) + n22 * d22;
    const float k = stiffness[i];
    const float s = k * half_edge;
    const float sc = s * (volume[i] * (trace + inner));  // -s p
    const float sa = s + sc, sb = s * (1 - chi);
    const float h00 = (sc - sa * n00) - sb * d00, h01 = sa * r01 - sb * d01;
    const float h02 = sa * r02 - sb * d02, h10 = sa * r10 - sb * d10;
    const float h11 = (sc - sa * n11) - sb * d11, h12 = sa * r12 - sb * d12;
    const float h20 = sa * r20 - sb * d20, h21 = sa * r21 - sb * d21;
    const float h22 = (sc - sa * n22) - sb * d22;
    const float weight = k * (chi * 0.125F);
    const float f0 = weight * t0[i], f1 = weight * t1[i], f2 = weight * t2[i];
    t0[i] = f0 + h00;
    t1[i] = f1 + h10;
    t2[i] = f2 + h20;
    g0[i] = f0 - h00;
    g1[i] = h01 + h02;
    g2[i] = h01 - h02;
    g3[i] = f1 - h10;
    g4[i] = h11 + h12;
    g5[i] = h11 - h12;
    g6[i] = f2 - h20;
    g7[i] = h21 + h22;
    g8[i] = h21 - h22;
  }
}

// Stage 2 for slots from `from` on, a multiple of kLanes.
inline void fit_slots(const ModelHead& head, const Slots& plane, std::uint32_t from,
                      std::uint32_t lanes) {
  const Slots slots = {{plane.sums.at + from, plane.sums.stride},
                       plane.stiffness + from,
                       plane.volume + from,
                       plane.qw + from,
                       plane.qx + from,
                       plane.qy + from,
                       plane.qz + from};
  Seen seen;
  see_slots(lanes, slots, seen);
  turn_slots(lanes, seen, slots);
  send_slots(lanes, slots, head.hourglass_weight, head.edge_m * 0.5F);
}

// Stages 1 and 2: slots are fitted while their sums are near.
void fit_plane(const View& view, const Plane& plane) {
  const ModelHead& head = *view.model.head;
  const std::uint32_t at = plane.slot_begin, count = plane.slot_end - plane.slot_begin;
  const Places places = {view.state.ex, view.state.ey - view.state.ex,
                         head.inverse_edge_per_m * 0.25F};
  const Slots slots = {sums_of(view),      view.model.slot_k + at, view.model.slot_volume + at,
                       view.state.qw + at, view.state.qx + at,     view.state.qy + at,
                       view.state.qz + at};
  clear_first(slots.sums);
  const Row* row = view.model.row + plane.row_begin;
  const Row* const end = view.model.row + plane.row_end;
  for (std::uint32_t from = 0; from < count; from += kChunk) {
    row = sum_rows(places, slots.sums, row, end, at, from + kChunk);
    fit_slots(head, slots, from, count - from < kChunk ? count - from : kChunk);
  }
}

// What one voxel row sends to a window of its nodes at its low (`kSide` -1) or high (1) side along
// y: to the particles of the plane below and above.
struct Sent {
  Wide low, high;
};
template <int kSide>
inline Sent sent_by_row(const float* sent, std::ptrdiff_t stride, WideBits lanes) {
  const Wide along = load(sent) + load(sent + stride + 1);
  const Wide same = load(sent + 2 * stride) + load(sent + 2 * stride + 1);
  const Wide other = load(sent + 3 * stride) + load(sent + 3 * stride + 1);
  return {zero_unless(lanes, kSide > 0 ? along + other : along - same),
          zero_unless(lanes, kSide > 0 ? along + same : along - other)};
}

// Stage 3. Forces on the particles at the side the sweep comes from join those from the clusters
// there; on the others they are set. Windows in order, so that the zeros which their last lanes
// write beyond the end of a line are written over by the next line. `low` and `high`: x, y, z,
// `axis` apart.
template <bool kUp>
void spread_plane(const View& view, const Plane& plane, float* low, float* high) {
  constexpr std::uint32_t kList = kWide > 8 ? 1 : 0;
  constexpr std::uint32_t kWindow = kWide > 8 ? 16 : 8;
  const Sums sums = sums_of(view);
  const auto axis = static_cast<std::ptrdiff_t>(view.model.head->counts.particles_per_plane);
  const Window* windows = kList == 0 ? view.model.window8 : view.model.window16;
  const Window* const end = windows + plane.window_end[kList];
  for (const Window* w = windows + plane.window_begin[kList]; w != end; ++w) {
    for (std::uint32_t i = 0; i < kWindow; i += kWide) {
      const WideBits before = lanes_set(std::uint32_t{w->lanes[0]} >> i);
      const WideBits behind = lanes_set(std::uint32_t{w->lanes[1]} >> i);
      const float* a = sums.at + (w->slot[0] + static_cast<std::ptrdiff_t>(i));
      const float* b = sums.at + (w->slot[1] + static_cast<std::ptrdiff_t>(i));
      float *to_low = low + w->low + i, *to_high = high + w->high + i;
      for (int c = 0; c < 3; ++c) {
        const Sent one = sent_by_row<1>(a, sums.stride, before);
        const Sent other = sent_by_row<-1>(b, sums.stride, behind);
        const Wide on_low = one.low + other.low, on_high = one.high + other.high;
        if constexpr (kUp) {
          store(to_low, load(to_low) + on_low);
          store(to_high, on_high);
        } else {
          store(to_low, on_low);
          store(to_high, load(to_high) + on_high);
        }
        a += 4 * sums.stride;
        b += 4 * sums.stride;
        to_low += axis;
        to_high += axis;
      }
    }
  }
}

struct Motion {
  float dt, tau, keep, fastest;
  // Largest displacement so far: its bits, which as integers have the order of floats.
  WideBits largest = {};
};

// Moves a group of lanes along one axis.
inline void move_lanes(const float* force, Wide per_mass, Wide hold, float* u, float* v, float* e,
                       Motion& motion) {
  Wide velocity = motion.keep * load(v) - per_mass * (hold * load(e) - load(force));
  velocity = (velocity + kQuantum) - kQuantum;
  velocity = no_larger(velocity, motion.fastest);
  Wide place = load(u) + motion.dt * velocity;
  place = (place + kQuantum) - kQuantum;
  store(v, velocity);
  store(u, place);
  store(e, place + motion.tau * velocity);
  const WideBits size = __builtin_bit_cast(WideBits, place) & 0x7FFFFFFF;
  motion.largest = motion.largest > size ? motion.largest : size;
}

// Nodes that are one particle get the forces on all of them; `force` as below.
void join_tied(const View& view, const Plane& plane, float* force) {
  const TiedNode* const first = view.model.tie + plane.tie_begin;
  const TiedNode* const end = view.model.tie + plane.tie_end;
  for (int c = 0; c < 3; ++c, force += view.model.head->counts.particles_per_plane) {
    const auto on = [&](std::uint32_t node) -> float& {
      return force[node - plane.particle_begin];
    };
    for (const TiedNode* tie = first; tie != end; ++tie) on(tie->root) += on(tie->node);
    for (const TiedNode* tie = first; tie != end; ++tie) on(tie->node) = on(tie->root);
  }
}

// Moves the particles of a plane. `force`: x, y, z, `particles_per_plane` apart.
void move_particles(const View& view, const Plane& plane, float* force, Motion& motion_out) {
  if (plane.tie_begin != plane.tie_end) join_tied(view, plane, force);
  const auto force_axis = static_cast<std::ptrdiff_t>(view.model.head->counts.particles_per_plane);
  const std::ptrdiff_t axis = view.state.uy - view.state.ux;  // as from y to z, for u, v and e
  Motion motion = motion_out;
  float* u = view.state.ux + plane.particle_begin;
  float* v = view.state.vx + plane.particle_begin;
  float* e = view.state.ex + plane.particle_begin;
  const float* per_mass = view.model.step_per_mass + plane.particle_begin;
  const float* hold = view.model.hold + plane.particle_begin;
  const std::ptrdiff_t count = plane.particle_end - plane.particle_begin;
  // The first group is padding. It is not written: the slab below may read it meanwhile.
  for (std::ptrdiff_t group = kLanes; group < count; group += kLanes) {
    for (std::ptrdiff_t i = group; i < group + std::ptrdiff_t{kLanes}; i += kWide) {
      for (std::ptrdiff_t c = 0; c < 3; ++c) {
        move_lanes(force + i + c * force_axis, load(per_mass + i), load(hold + i), u + i + c * axis,
                   v + i + c * axis, e + i + c * axis, motion);
      }
    }
  }
  motion_out = motion;
}

float largest_displacement(const Motion& motion) {
  std::int32_t largest = 0;
  for (std::uint32_t i = 0; i < kWide; ++i) {
    largest = largest > motion.largest[i] ? largest : motion.largest[i];
  }
  return __builtin_bit_cast(float, largest);
}

// Forces on the particles of a plane, to zero.
void clear(const View& view, const Plane& plane, float* force) {
  const auto axis = static_cast<std::ptrdiff_t>(view.model.head->counts.particles_per_plane);
  const float* const end = force + (plane.particle_end - plane.particle_begin);
  for (force += kLanes; force != end; force += kLanes) {
    for (std::uint32_t i = 0; i < kLanes; i += kWide) {
      store(force + i, Wide{});
      store(force + i + axis, Wide{});
      store(force + i + 2 * axis, Wide{});
    }
  }
}

// Sweeps the first voxel plane of a slab and as many of those between as it gets, and moves the
// particles between them. Those at its ends stay, unless they are the lattice's, and the slab has
// the forces on them.
void sweep_planes(const View& view, Slab& slab, Motion& motion) {
  const Plane* const plane = view.model.plane;
  const std::uint32_t top = view.model.head->counts.planes;
  const std::size_t part = 3 * std::size_t{view.model.head->counts.particles_per_plane};
  const std::uint32_t behind = slab.up ? 0 : 1, ahead = 1 - behind;  // of a voxel plane's particles
  float* here = slab.kept;
  float* next = nullptr;
  Fits fits = {};  // lanes without a voxel are computed, too
  FitMembers members = {};
  std::uint32_t z = slab.first;
  clear(view, plane[z + behind], here);
  for (bool more = true; more; here = next) {
    next = view.scratch.force + (z + 1) % 2 * part;
    clear(view, plane[z + ahead], next);
    fit_plane(view, plane[z]);
    couple_plane(view, z, fits, members);
    if (slab.up) {
      spread_plane<true>(view, plane[z], here, next);
    } else {
      spread_plane<false>(view, plane[z], next, here);
    }
    const std::uint32_t done = z + behind;
    const bool move = z != slab.first || done == 0 || done == top;
    if (move) move_particles(view, plane[done], here, motion);
    more = take_plane(*slab.between);
    z += more ? ahead - behind : 0;
  }
  if (slab.up && z + 1 == top) move_particles(view, plane[top], here, motion);
  slab.begin = slab.up ? slab.first : z;
  slab.low = slab.up ? slab.kept : here;
  slab.high = slab.up ? here : slab.kept;
}

Motion start_motion(const ModelHead& head) {
  return {head.substep_s, head.config.tissue_damping_s,
          1 - head.substep_s * head.config.surround_drag_per_s,
          kMaxEdgesPerSubstep * head.edge_m / head.substep_s};
}

// In scratch of its own (lattice_team.h).
void sweep_slab(const Kernel& kernel, Slab& slab) {
  View view = view_of(kernel);
  view.scratch.sums = slab.sums;
  view.scratch.force = slab.force;
  Motion motion = start_motion(*view.model.head);
  sweep_planes(view, slab, motion);
  slab.largest_m = largest_displacement(motion);
}

void add_forces(const View& view, const Plane& plane, const float* more, float* force) {
  const auto axis = static_cast<std::ptrdiff_t>(view.model.head->counts.particles_per_plane);
  const std::ptrdiff_t count = plane.particle_end - plane.particle_begin;
  for (std::ptrdiff_t c = 0; c < 3; ++c) {
    for (std::ptrdiff_t i = c * axis + kLanes; i < c * axis + count; ++i) force[i] += more[i];
  }
}

void join(Motion& motion, const Slab& slab) {
  const auto size = __builtin_bit_cast(std::int32_t, slab.largest_m);
  if (size > motion.largest[0]) motion.largest[0] = size;
}

}  // namespace

void STYLET_LATTICE_STEP(const Kernel& kernel) {
  const View view = view_of(kernel);
  const ModelHead& head = *view.model.head;
  Motion motion = start_motion(head);
  if (kernel.team == nullptr) {
    Between all = {0, head.counts.planes - 1};
    Slab slab = {};
    slab.up = true;
    slab.between = &all;
    slab.kept = view.scratch.force;
    sweep_planes(view, slab, motion);
  } else {
    sweep_together(kernel, sweep_slab);
    Team& team = team_of(kernel);
    join(motion, team.slab[0]);
    for (std::uint32_t s = 1; s < team.slab_count; ++s) {
      const Slab &below = team.slab[s - 1], &above = team.slab[s];
      const Plane& plane = view.model.plane[above.begin];
      add_forces(view, plane, above.low, below.high);
      move_particles(view, plane, below.high, motion);
      join(motion, above);
    }
  }
  view.state.head->max_displacement_m = largest_displacement(motion);
}

}  // namespace stylet
