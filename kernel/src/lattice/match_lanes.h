// SPDX-License-Identifier: Apache-2.0
// The arithmetic of matches of corners and constraint particles together, one voxel per lane.
// lattice/step.h includes it once per instruction set; matches.h reads and writes the memory.
//
// Let w be the weights of a voxel's constraint particles (stiffness times support), r their rest
// offsets and x their places from the mean of the corners. Without the ghosts the match's matrix is
//     2 k h^2 F + sum w x r^T - (sum w x) (sum w r)^T / (8 k + sum w),
// and its translation moves from the corners' mean by (sum w x - R sum w r) / (8 k + sum w).
//
// Promises: no branch on data; the same bits for any lane width. Units SI.
#pragma once

#include "base/lanes.h"
#include "lattice/matches.h"
#include "lattice/rotation.h"

namespace stylet {
namespace {

// Mean and gradient of the corners.
void see_corners(std::uint32_t lanes, const ModelHead& head, const MatchGroup& group,
                 Matches& matches) {
  const float origin_m[3] = {head.origin_m.x, head.origin_m.y, head.origin_m.z};
  for (std::uint32_t i = 0; i < lanes; i += kWide) {
    const Wide scale = load(group.inverse_edge_per_m + i) * 0.25F;
    for (int c = 0; c < 3; ++c) {
      const float(&u)[8][kLanes] = matches.corner_m[c];
      const Wide a0 = load(u[0] + i), b0 = load(u[1] + i), s0 = a0 + b0, d0 = b0 - a0;
      const Wide a1 = load(u[2] + i), b1 = load(u[3] + i), s1 = a1 + b1, d1 = b1 - a1;
      const Wide a2 = load(u[4] + i), b2 = load(u[5] + i), s2 = a2 + b2, d2 = b2 - a2;
      const Wide a3 = load(u[6] + i), b3 = load(u[7] + i), s3 = a3 + b3, d3 = b3 - a3;
      const Wide rest = origin_m[c] + load(group.edge_m + i) * load(group.cell[c] + i);
      store(matches.centre_m[c] + i, rest + ((s0 + s1) + (s2 + s3)) * 0.125F);
      const Wide along[3] = {((d0 + d1) + (d2 + d3)) * scale, ((s1 - s0) + (s3 - s2)) * scale,
                             ((s2 + s3) - (s0 + s1)) * scale};
      for (int b = 0; b < 3; ++b) {
        store(matches.corner[3 * c + b] + i, (b == c ? 1.0F : 0.0F) + along[b]);
      }
    }
  }
}

// Adds one constraint particle of each voxel to the sums of those before; weight 0 adds none.
template <bool kFirst>
void sum_members(std::uint32_t lanes, const MatchMembers& members, Matches& matches) {
  for (std::uint32_t i = 0; i < lanes; i += kWide) {
    const Wide w = load(members.weight_n_per_m + i);
    const auto add = [&](std::uint32_t sum, Wide value) {
      store(matches.sum[sum] + i, (kFirst ? Wide{} : load(matches.sum[sum] + i)) + value);
    };
    Wide x[3], r[3];
    for (std::uint32_t c = 0; c < 3; ++c) {
      x[c] = load(members.place_m[c] + i) - load(matches.centre_m[c] + i);
      r[c] = load(members.offset_m[c] + i);
    }
    add(Matches::kWeight, w);
    add(Matches::kOffsetSquare, w * (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]));
    for (std::uint32_t a = 0; a < 3; ++a) {
      add(Matches::kPlace + a, w * x[a]);
      add(Matches::kOffset + a, w * r[a]);
      for (std::uint32_t b = 0; b < 3; ++b) add(Matches::kProduct + 3 * a + b, w * x[a] * r[b]);
    }
  }
}

// Matrices whose rotations are the matches, scaled to be near the identity at rest. They must be
// scaled by a number only: rot(A Aqq^-1) is not the minimiser when constraint particles make Aqq
// anisotropic.
void join_members(std::uint32_t lanes, const MatchGroup& group, Matches& matches) {
  for (std::uint32_t i = 0; i < lanes; i += kWide) {
    const auto sum = [&](std::uint32_t which) { return load(matches.sum[which] + i); };
    const Wide k = load(group.k + i), whole = 8 * k + sum(Matches::kWeight);
    const Wide edge_m = load(group.edge_m + i), corner = 2 * k * edge_m * edge_m;
    Wide offset[3];
    for (std::uint32_t c = 0; c < 3; ++c) offset[c] = sum(Matches::kOffset + c);
    const Wide trace =
        3 * corner +
        (sum(Matches::kOffsetSquare) -
         (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]) / whole);
    const Wide scale = 3 / trace;
    for (std::uint32_t a = 0; a < 3; ++a) {
      const Wide place = sum(Matches::kPlace + a);
      for (std::uint32_t b = 0; b < 3; ++b) {
        const std::uint32_t ab = 3 * a + b;
        store(matches.joint[ab] + i,
              scale * (corner * load(matches.corner[ab] + i) +
                       (sum(Matches::kProduct + ab) - place * offset[b] / whole)));
      }
    }
    store(matches.whole + i, whole);
  }
}

// One refined step of the rotations of matrices `m`.
inline void turn_lanes(std::uint32_t lanes, const float (&m)[9][kLanes],
                       const float (&from)[4][kLanes], float (&to)[4][kLanes]) {
  STYLET_VECTOR
  for (std::uint32_t i = 0; i < lanes; ++i) {
    float w = from[0][i], x = from[1][i], y = from[2][i], z = from[3][i];
    rotation_step<1>(m[0][i], m[1][i], m[2][i], m[3][i], m[4][i], m[5][i], m[6][i], m[7][i],
                     m[8][i], w, x, y, z);
    to[0][i] = w;
    to[1][i] = x;
    to[2][i] = y;
    to[3][i] = z;
  }
}

// One step for the corners alone, from their rotation of the last substep, and two for the whole
// match, from its rotation of the last tick: each lowers the energy. (The corners' rotation is far
// from that of the whole match where a shaft has been dragged sideways by more than a voxel. Steps
// for the whole match that began at the corners' rotation reached another rotation in every
// substep and added 0.7 mJ. With the sweep's plain step for
// the corners, or with two, tissue dragged to a hundredfold of its length gained 0.2 to 0.3 uJ.)
STYLET_KEEP_APART void turn_matches(std::uint32_t lanes, Matches& matches) {
  turn_lanes(lanes, matches.corner, matches.corner_turn, matches.corner_turn);
  for (int pass = 0; pass < 2; ++pass) {
    turn_lanes(lanes, matches.joint, matches.joint_turn, matches.joint_turn);
  }
}

// As rotation_matrix of math.h.
struct WideMat3 {
  Wide m[3][3];
};
inline WideMat3 rotation_matrix(const float (&turn)[4][kLanes], std::uint32_t i) {
  const Wide w = load(turn[0] + i), x = load(turn[1] + i), y = load(turn[2] + i);
  const Wide z = load(turn[3] + i);
  const Wide x2 = x + x, y2 = y + y, z2 = z + z;
  const Wide xx = x * x2, yy = y * y2, zz = z * z2;
  const Wide xy = x * y2, xz = x * z2, yz = y * z2;
  const Wide wx = w * x2, wy = w * y2, wz = w * z2;
  return {{{1 - (yy + zz), xy - wz, xz + wy},
           {xy + wz, 1 - (xx + zz), yz - wx},
           {xz - wy, yz + wx, 1 - (xx + yy)}}};
}
inline Wide turned(const WideMat3& by, std::uint32_t c, const Wide (&v)[3]) {
  return by.m[c][0] * v[0] + by.m[c][1] * v[1] + by.m[c][2] * v[2];
}

// Places of the matches now, and their change for the corners, k ((t' - t) + (R' - R) q).
void place_matches(std::uint32_t lanes, Matches& matches, MatchGroup& group) {
  for (std::uint32_t i = 0; i < lanes; i += kWide) {
    const WideMat3 r8 = rotation_matrix(matches.corner_turn, i);
    const WideMat3 r = rotation_matrix(matches.joint_turn, i);
    const Wide k = load(group.k + i), turn_k = k * load(group.edge_m + i) * 0.5F;
    const Wide inverse = 1 / load(matches.whole + i);
    Wide offset[3];
    for (std::uint32_t c = 0; c < 3; ++c) offset[c] = load(matches.sum[Matches::kOffset + c] + i);
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Wide shift =
          inverse * (load(matches.sum[Matches::kPlace + c] + i) - turned(r, c, offset));
      store(matches.centre_m[c] + i, load(matches.centre_m[c] + i) + shift);
      for (std::uint32_t b = 0; b < 3; ++b) store(matches.rotation[3 * c + b] + i, r.m[c][b]);
      const Wide along = k * shift, x = turn_k * (r.m[c][0] - r8.m[c][0]);
      const Wide y = turn_k * (r.m[c][1] - r8.m[c][1]), z = turn_k * (r.m[c][2] - r8.m[c][2]);
      const Wide ends[2] = {along - x, along + x}, sides[4] = {-y - z, y - z, z - y, y + z};
      for (std::uint32_t n = 0; n < 4; ++n) {
        store_pairs(group.side[n / 2].change_n[n % 2][c][i], ends[0] + sides[n],
                    ends[1] + sides[n]);
      }
    }
  }
}

std::uint32_t group_count(const Scratch& scratch) {
  return (scratch.head->coupled_count + kLanes - 1) / kLanes;
}

// The matches of a substep, before their planes are swept; needs place_members.
STYLET_KEEP_APART void match_groups(const Model& model, State& state, Scratch& scratch,
                                    std::uint32_t first, std::uint32_t end) {
  const ModelHead& head = *model.head;
  Matches matches = {};  // lanes without a voxel are computed, too
  MatchMembers members = {};
  for (std::uint32_t index = first; index < end; ++index) {
    MatchGroup& group = scratch.group[index];
    begin_matches(state, scratch, group, matches);
    // No more lanes than the voxels need: without wide registers each lane is work.
    const std::uint32_t lanes = (group.count + kWide - 1) / kWide * kWide;
    see_corners(lanes, head, group, matches);
    take_members(state, scratch, group, 0, matches, members);
    sum_members<true>(lanes, members, matches);
    for (std::uint32_t n = 1; n < group.most_members; ++n) {
      take_members(state, scratch, group, n, matches, members);
      sum_members<false>(lanes, members, matches);
    }
    join_members(lanes, group, matches);
    turn_matches(lanes, matches);
    place_matches(lanes, matches, group);
    if (scratch.head->substeps_to_come == 0) give_goals(state, scratch, group, matches);
  }
}

}  // namespace
}  // namespace stylet
