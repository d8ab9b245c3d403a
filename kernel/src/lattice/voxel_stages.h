// SPDX-License-Identifier: Apache-2.0
// Stages 1 and 2 of the sweep (step.h): the sums over a voxel's corners, its rotation, and what it
// sends to its nodes, over slots in full lanes. step.h includes it once per instruction set.
#pragma once

#include "base/lanes.h"
#include "lattice/lattice.h"
#include "lattice/rotation.h"
#include "laws/stiffening.h"

namespace stylet {
namespace {

// Like kQuantum, for rotations.
constexpr float kQuantumTurn = 1.953125e-3F;  // 2^-9: quaternion parts to 2e-10

// Twelve arrays over some slots of a plane, `stride` apart. For each component of the displacement:
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

// Where nodes are. Copied once per plane: after a store of a float it would be read again.
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

// Stage 1 for rows up to the first that begins at slot `until` of the plane or later; returns that
// row. What the last lanes write beyond a row's end, the next row overwrites.
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

// The first slot, before all rows, passes through stage 2 as well: this sets its numbers.
void clear_first(const Sums& sums) {
  for (std::ptrdiff_t k = 0; k < 12; ++k) sums.at[k * sums.stride] = 0;
}

// Stage 2 is five loops, over as many lanes at a time as stay in the nearest cache. One loop would
// take fewer instructions, but a quarter more time for the whole step: a group of lanes is a chain
// of three roots and a division, so long that the processor sees little of the next group during it
// and waits. So each of the first four loops has one root or division: the slow unit that computes
// it finishes one group of lanes while the other units work on the next.

// What passes from loop to loop, in whole registers. (Registers that lay across lines of the cache
// made the step take 4 % more time.) Later numbers overwrite numbers that are no longer needed: 1 %
// less time.
struct alignas(64) Seen {
  float ax[kChunk], ay[kChunk], az[kChunk];  // K's side, then the quaternion's x, y, z
  float sx[kChunk], sy[kChunk], sz[kChunk], sxy[kChunk], sxz[kChunk], syz[kChunk];  // its block
  float shift[kChunk];   // the block's bound, then lambda, then the quaternion's w
  float corner[kChunk];  // K's corner, then the quaternion's length
};

// What stage 2 reads and writes, from a given slot of a plane on.
struct Slots {
  Sums sums;
  const float *stiffness, *volume, *stiffening;  // the last only where tissue stiffens
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

// What the slots before leave to the next slot of a row: for each component T + X, Y + Z, Y - Z.
struct Carry {
  Wide last[3][3];
};

// One component: what a row sends to its four nodes at the low side of each slot. `hx`, `hy`,
// `hz`: s times the column of H, without the gradient's part.
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

// Factors of a voxel's H: s times that of R - I, of I and, with the sign changed, of the gradient.
struct Factors {
  Wide turn, one, gradient;
};

// Linear tissue adds nothing.
struct Linear {
  explicit Linear(const Slots&) {}
  template <typename Gradient>
  void add(std::uint32_t, const Wide (&)[3][3], Gradient, Wide, Wide, float, Factors&) const {}
};

// Strain stiffening adds g ((1 + t) R - F) to H, with 3 t = tr(R^T F) - 3 and g of stiffening.h.
// `turn` is R - I; `volume` is -3 t.
struct Stiffening {
  explicit Stiffening(const Slots& slots) : stiffening(slots.stiffening) {}
  template <typename Gradient>
  void add(std::uint32_t i, const Wide (&turn)[3][3], Gradient d, Wide volume, Wide s, float scale,
           Factors& factors) const {
    Wide square[3];  // of the rows of F - R
    for (int c = 0; c < 3; ++c) {
      const Wide x = scale * d(c, 0) - turn[c][0], y = scale * d(c, 1) - turn[c][1];
      const Wide z = scale * d(c, 2) - turn[c][2];
      square[c] = (x * x + y * y) + z * z;
    }
    const Wide third = volume * (-1.0F / 3);
    const Wide shape = ((square[0] + square[1]) + square[2]) + third * volume;
    const Wide g = s * stiffer(load(stiffening + i), shape);
    factors.turn = factors.turn + (g + g * third);
    factors.one = factors.one + g * third;
    factors.gradient = factors.gradient + g * scale;
  }
  const float* stiffening;
};

// In place: sum and gradient of the displacement become what is sent to the nodes between a row's
// slots. The corner at (+-1, +-1, +-1) gets T +- X +- Y +- Z, with T = k chi t and X, Y, Z the
// columns of k (h / 2) H. Stored is the sum for the two voxels of the row that share a node: first
// at the row's high side along y, for the particle planes below and above, then at its low side.
template <typename Law>
STYLET_KEEP_APART void send_slots(std::uint32_t lanes, const Slots& slots, float chi,
                                  float half_edge, float scale, Carry& carry_io) {
  // Copied: after every store of a float they would be read again.
  const Slots own = slots;
  const Law law(slots);
  Carry carry = carry_io;
  const std::ptrdiff_t stride = own.sums.stride;
  float* at0 = own.sums.at;
  for (std::uint32_t i = 0; i < lanes; i += kWide, at0 += kWide) {
    float* const at1 = at0 + 4 * stride;
    float* const at2 = at0 + 8 * stride;
    // R - I, so that small rotations keep their digits; the diagonal has the opposite sign.
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
    const float* const at[3] = {at0, at1, at2};
    const auto gradient = [&](int c, int b) { return d(at[c], b); };
    const Wide trace = ((n00 + n11) + n22) - scale * ((d(at0, 0) + d(at1, 1)) + d(at2, 2));
    const Wide inner =
        scale * (((n00 * d(at0, 0) - r01 * d(at0, 1)) - (r02 * d(at0, 2) + r10 * d(at1, 0))) +
                 ((n11 * d(at1, 1) - r12 * d(at1, 2)) - (r20 * d(at2, 0) + r21 * d(at2, 1))) +
                 n22 * d(at2, 2));
    const Wide k = load(own.stiffness + i);
    const Wide s = k * half_edge;
    const Wide sc = s * (load(own.volume + i) * (trace + inner));  // -s p
    const Wide turn[3][3] = {{-n00, r01, r02}, {r10, -n11, r12}, {r20, r21, -n22}};
    Factors factors = {s + sc, sc, s * ((1 - chi) * scale)};
    law.add(i, turn, gradient, trace + inner, s, scale, factors);
    const Wide sa = factors.turn, sb = factors.gradient;
    const Wide weight = k * (chi * 0.125F);
    const Wide one = factors.one;
    send_component(at0, stride, weight, sb, one - sa * n00, sa * r01, sa * r02, carry.last[0]);
    send_component(at1, stride, weight, sb, sa * r10, one - sa * n11, sa * r12, carry.last[1]);
    send_component(at2, stride, weight, sb, sa * r20, sa * r21, one - sa * n22, carry.last[2]);
  }
  carry_io = carry;
}

// Stage 2 for slots from `from` on, a multiple of kLanes; the sums begin with slot `front`.
__attribute__((always_inline)) inline void match_slots(const ModelHead& head, const Level& level,
                                                       const Slots& plane, std::uint32_t from,
                                                       std::uint32_t front, std::uint32_t lanes,
                                                       Carry& carry) {
  const Slots slots = {{plane.sums.at + (from - front), plane.sums.stride},
                       plane.stiffness + from,
                       plane.volume + from,
                       plane.stiffening + from,
                       plane.qw + from,
                       plane.qx + from,
                       plane.qy + from,
                       plane.qz + from};
  Seen seen;
  see_slots(lanes, slots, 4 * level.edge_m, seen);
  shift_slots(lanes, 4 * level.edge_m, seen);
  turn_slots(lanes, slots, seen);
  unit_slots(lanes, seen, slots);
  const float chi = head.hourglass_weight, half_edge = level.edge_m * 0.5F;
  const float scale = level.inverse_edge_per_m * 0.25F;
  if (head.counts.stiffening_slots == 0) {
    send_slots<Linear>(lanes, slots, chi, half_edge, scale, carry);
  } else {
    send_slots<Stiffening>(lanes, slots, chi, half_edge, scale, carry);
  }
}

}  // namespace
}  // namespace stylet
