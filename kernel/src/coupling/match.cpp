// SPDX-License-Identifier: Apache-2.0
#include "coupling/match.h"

#include "coupling/spring.h"
#include "coupling/support.h"
#include "lattice/voxel.h"
#include "state/particles.h"

namespace stylet {

namespace {

constexpr std::uint32_t kNoVoxel = 0xFFFFFFFFU;

// Index of a support's voxel in this tick's list, added if new; kNoVoxel if the list has no `room`.
// The mark of a slot is trusted only if the list entry it names points back, so stale marks do no
// harm.
std::uint32_t coupled_index(Scratch& scratch, const Support& support, std::uint32_t room) {
  ScratchHead& head = *scratch.head;
  const std::uint32_t mark = scratch.slot_mark[support.slot];
  if (mark < head.coupled_count && scratch.coupled[mark].slot == support.slot) return mark;
  if (head.coupled_count >= room) return kNoVoxel;
  const std::uint32_t index = head.coupled_count++;
  scratch.coupled[index] = {support.slot, support.row, 0, 0, 0};
  scratch.slot_mark[support.slot] = index;
  return index;
}

// How full the list may be when a particle's voxels are added: tips always find room.
std::uint32_t room_for(const Model& model, std::uint32_t index) {
  const std::uint32_t needles = model.head->counts.needles;
  const std::uint32_t tips_before = index / kNeedleParticles + (is_tip(index) ? 1 : 0);
  return kMaxCoupledVoxels * needles - kSupportsPerParticle * (needles - tips_before);
}

// Coupled voxels in the order of their planes: plane_order[plane_first[z]] .. plane_first[z + 1].
void sort_by_plane(const Model& model, Scratch& scratch) {
  const std::uint32_t planes = model.head->counts.planes;
  std::uint32_t* first = scratch.plane_first;
  for (std::uint32_t z = 0; z < planes + 2; ++z) first[z] = 0;
  const std::uint32_t count = scratch.head->coupled_count;
  for (std::uint32_t i = 0; i < count; ++i) {
    ++first[model.row[scratch.coupled[i].row].plane + 2U];
  }
  for (std::uint32_t z = 2; z < planes + 2; ++z) first[z] += first[z - 1];
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t z = model.row[scratch.coupled[i].row].plane;
    scratch.plane_order[first[z + 1U]++] = i;
  }
}

// These places do not change within a tick, so they are looked up once.
void fill_groups(const Model& model, Scratch& scratch) {
  const std::uint32_t count = scratch.head->coupled_count;
  for (std::uint32_t i = 0; i < count; ++i) {
    const CoupledVoxel& voxel = scratch.coupled[scratch.plane_order[i]];
    const Row& row = model.row[voxel.row];
    const std::uint32_t along = voxel.slot - row.slot, lane = i % kLanes;
    MatchGroup& group = scratch.group[i / kLanes];
    if (lane == 0) {
      group.count = count - i < kLanes ? count - i : kLanes;
      group.most_members = 0;
    }
    group.first_member[lane] = voxel.first_member;
    group.member_count[lane] = voxel.member_count;
    if (voxel.member_count > group.most_members) group.most_members = voxel.member_count;
    group.slot[lane] = voxel.slot;
    for (std::uint32_t n = 0; n < 4; ++n) {
      group.side[n / 2].node[n % 2][lane] = row.node[n] + along;
    }
    const Vec3 cell = cell_of(model, voxel.slot, row);
    group.cell[0][lane] = cell.x + 0.5F;
    group.cell[1][lane] = cell.y + 0.5F;
    group.cell[2][lane] = cell.z + 0.5F;
    group.edge_m[lane] = level_of(model, row).edge_m;
    group.inverse_edge_per_m[lane] = level_of(model, row).inverse_edge_per_m;
    group.k[lane] = model.slot_k[voxel.slot];
  }
}

// A spring at a point r from a voxel's centre, at most sqrt(3) / 2 edges, pulls at the corners by
// weights whose squares sum to 1 / 8 + r^2 / (4 edge^2).
constexpr float kMostOfPull = 5.0F / 16;

// Total stiffness of the springs that pull at a coupled voxel.
float pull_n_per_m(const State& state, const Scratch& scratch, const CoupledVoxel& voxel) {
  float sum = 0;
  std::uint32_t at = voxel.first_member;
  for (std::uint32_t i = 0; i < voxel.member_count; ++i) {
    const Member& member = scratch.member[at];
    const Particle& p = particle_at(state, member.particle);
    sum = sum + p.stiffness_n_per_m * p.support[member.support].weight;
    at = member.next;
  }
  return sum;
}

// What the springs of constraint particles may add to the bound of a particle (filter.h).
void bound_held(const Model& model, const State& state, Scratch& scratch) {
  const Counts& counts = model.head->counts;
  float* const sums = scratch.coupling_bound;
  for (std::uint32_t i = 0; i < counts.filtered_particles; ++i) sums[i] = 0;
  for (std::uint32_t i = 0; i < scratch.head->coupled_count; ++i) {
    const CoupledVoxel& voxel = scratch.coupled[i];
    const Row& row = model.row[voxel.row];
    const float k = model.slot_k[voxel.slot];
    const float pull = kMostOfPull * pull_n_per_m(state, scratch, voxel);
    const float more = pull * k / (k + pull);
    for (const std::uint32_t node : row.node) {
      sums[node + voxel.slot - row.slot] += more;
      sums[node + voxel.slot - row.slot + 1] += more;
    }
  }
  sum_tied(model, sums);
}

}  // namespace

MatchFrame match_frame(const Model& model, const State& state, std::uint32_t slot,
                       std::uint32_t row) {
  const State first = needle_state(state, 0);
  const Support* found = nullptr;
  for_each_particle(model, first, [&](std::uint32_t index) {
    const Particle& p = particle_at(first, index);
    for (std::uint32_t i = 0; i < p.support_count; ++i) {
      if (p.support[i].slot == slot) found = &p.support[i];
    }
  });
  if (found != nullptr) {
    return {found->turn, found->goal_m - rotation_matrix(found->turn) * found->offset_m};
  }
  const Corners corners = sum_corners(model, state, slot, row);
  return {corner_rotation(state, slot, corners),
          rest_centre(model, slot, model.row[row]) + corners.mean_m};
}

std::uint32_t gather_coupled(const Model& model, State& state, Scratch& scratch) {
  ScratchHead& head = *scratch.head;
  head.coupled_count = 0;
  head.substeps_to_come = 0;
  std::uint32_t flags = 0, members = 0;
  for_each_particle(model, state, [&](std::uint32_t index) {
    Particle& p = particle_at(state, index);
    const std::uint32_t room = room_for(model, index);
    std::uint32_t voxels[kSupportsPerParticle], count = 0, found = 0;
    for (std::uint32_t s = 0; s < p.support_count; ++s) {
      const std::uint32_t voxel = coupled_index(scratch, p.support[s], room);
      if (voxel == kNoVoxel) continue;
      voxels[count++] = voxel;
      found |= 1U << s;
    }
    if (count < p.support_count) {
      state.head->cp_voxel_pool_full += p.support_count - count;
      flags = kFlagCpVoxelPoolFull;
      keep_supports(*state.head, p, found);
    }
    for (std::uint32_t s = 0; s < count; ++s) {
      CoupledVoxel& c = scratch.coupled[voxels[s]];
      (c.member_count == 0 ? c.first_member : scratch.member[c.last_member].next) = members;
      ++c.member_count;
      c.last_member = members;
      scratch.member[members++] = {static_cast<std::uint16_t>(index), static_cast<std::uint16_t>(s),
                                   0};
    }
  });
  sort_by_plane(model, scratch);
  fill_groups(model, scratch);
  if (has_true_mass(model)) bound_held(model, state, scratch);
  state.head->coupled_max =
      head.coupled_count > state.head->coupled_max ? head.coupled_count : state.head->coupled_max;
  return flags;
}

namespace {

// Sums over the CPs of one voxel; positions are from the mean of the corners.
struct CpSums {
  float stiffness;
  Vec3 place, offset;  // weighted sums
  float product[9];    // sum of place * offset^T, weighted
  float offset_square;
};

void add_member(const Particle& p, const Support& support, Vec3 centre_m, CpSums& s) {
  const float w = p.stiffness_n_per_m * support.weight;
  const Vec3 x = (p.position_m - p.slack_m) - centre_m;
  const Vec3 r = support.offset_m;
  s.stiffness = s.stiffness + w;
  s.place = s.place + w * x;
  s.offset = s.offset + w * r;
  s.offset_square = s.offset_square + w * dot(r, r);
  const float xs[3] = {x.x, x.y, x.z}, rs[3] = {r.x, r.y, r.z};
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) s.product[3 * a + b] += w * xs[a] * rs[b];
  }
}

// Matrix whose rotation is the match of corners and CPs together: join_members (match_lanes.h) for
// one voxel.
void match_matrix(const Corners& corners, const CpSums& s, float k, float edge_m, float a_out[9]) {
  const float whole = 8 * k + s.stiffness;
  const float corner = 2 * k * edge_m * edge_m;
  const float trace = 3 * corner + (s.offset_square - dot(s.offset, s.offset) / whole);
  const float scale = 3 / trace;
  const float place[3] = {s.place.x, s.place.y, s.place.z};
  const float offset[3] = {s.offset.x, s.offset.y, s.offset.z};
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const float unit = a == b ? 1.0F : 0.0F;
      a_out[3 * a + b] = scale * (corner * (unit + corners.gradient[3 * a + b]) +
                                  (s.product[3 * a + b] - place[a] * offset[b] / whole));
    }
  }
}

}  // namespace

// A slip takes work at the mean of the forces before and after, like the hand's work in the books.
// A force that would push the slip on does not count: slip_after_step takes it back.
void measure_forces(const Model& model, State& state) {
  for_each_particle(model, state, [&](std::uint32_t index) {
    Particle& p = particle_at(state, index);
    const Vec3 f = force_on_tissue(p);
    const float work = 0.5F * (dot(p.force_n, p.slip_m) + max_of(dot(f, p.slip_m), 0));
    (is_tip(index) ? state.head->cutting_j : state.head->friction_j) +=
        static_cast<double>(max_of(work, 0));
    p.force_n = f;
  });
}

namespace {

double square_sum(const Mat3& r, const float gradient[9]) {
  double sum = 0;
  for (int i = 0; i < 9; ++i) {
    const double f = static_cast<double>(gradient[i]) + (i % 4 == 0 ? 1.0 : 0.0);
    const double off = f - static_cast<double>(r.m[i / 3][i % 3]);
    sum += off * off;
  }
  return sum;
}

// The match of a voxel and its CPs, with all of them where they are now.
struct PresentMatch {
  Mat3 rotation;
  Vec3 centre_m;
  double corners_j;     // energy of the corners beyond their own match
  std::uint32_t first;  // first particle in the voxel, so that each voxel is counted once
};

PresentMatch present_match(const Model& model, const State& state, const Support& own) {
  const Corners corners = sum_corners(model, state, own.slot, own.row);
  const Vec3 centre = rest_centre(model, own.slot, model.row[own.row]) + corners.mean_m;
  CpSums sums = {};
  std::uint32_t first = kNoVoxel;
  for_each_particle(model, state, [&](std::uint32_t index) {
    const Particle& p = particle_at(state, index);
    for (std::uint32_t s = 0; s < p.support_count; ++s) {
      if (p.support[s].slot != own.slot) continue;
      if (first == kNoVoxel) first = index;
      add_member(p, p.support[s], centre, sums);
    }
  });
  const float k = model.slot_k[own.slot], h = level_of(model, model.row[own.row]).edge_m;
  const Quat alone = corner_rotation(state, own.slot, corners);
  float a[9];
  match_matrix(corners, sums, k, h, a);
  const Mat3 r8 = rotation_matrix(alone);
  const Mat3 r = rotation_matrix(rotation_of(a, rotation_of(a, alone)));
  const Vec3 shift = (1 / (8 * k + sums.stiffness)) * (sums.place - r * sums.offset);
  const double turned = square_sum(r, corners.gradient) - square_sum(r8, corners.gradient);
  const double energy =
      static_cast<double>(4 * k * dot(shift, shift)) + static_cast<double>(k * h * h) * turned;
  return {r, centre + shift, energy, first};
}

}  // namespace

double rematch(const Model& model, const State& state, std::uint32_t index,
               Particle& particle_out) {
  particle_out = particle_at(state, index);
  double corners_j = 0;
  for (std::uint32_t i = 0; i < particle_out.support_count; ++i) {
    Support& support = particle_out.support[i];
    const PresentMatch match = present_match(model, state, support);
    if (match.first == index) corners_j += match.corners_j;
    support.goal_m = match.centre_m + match.rotation * support.offset_m;
  }
  return corners_j;
}

}  // namespace stylet
