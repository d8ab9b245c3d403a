// SPDX-License-Identifier: Apache-2.0
#include "coupling/support.h"

#include "coupling/match.h"
#include "coupling/spring.h"

namespace stylet {

void renew_supports(const Model& model, const State& state, Particle& p, Weighting weighting) {
  const auto [residual_m, spread_m2] = residuals(p);
  Support found[kSupportsPerParticle];
  const std::uint32_t count = find_supports(model, p.rest_m, found, weighting);
  for (std::uint32_t i = 0; i < count; ++i) {
    Support& support = found[i];
    bool kept = false;
    for (std::uint32_t old = 0; old < p.support_count; ++old) {
      if (p.support[old].slot != support.slot) continue;
      support.offset_m = p.support[old].offset_m;
      support.goal_m = p.support[old].goal_m;
      support.turn = p.support[old].turn;
      kept = true;
    }
    if (kept) continue;
    const MatchFrame frame = match_frame(model, state, support.slot, support.row);
    support.turn = frame.turn;
    support.goal_m = p.position_m - residual_m;
    support.offset_m =
        transposed_times(rotation_matrix(frame.turn), support.goal_m - frame.centre_m);
  }
  for (std::uint32_t i = 0; i < count; ++i) p.support[i] = found[i];
  p.support_count = count;
  gather_goals(p, residual_m, spread_m2);
  if (count == 0) return;
  const std::uint32_t there = material_held_at(model, p.rest_m);
  p.material = there != kNoTissue ? there : model.slot_material[p.support[heaviest(p)].slot];
}

Vec3 unloaded_place(const Model& model, const Support& support) {
  return rest_centre(model, support.slot, model.row[support.row]) + support.offset_m;
}
Vec3 unloaded_place(const Model& model, const Particle& p) {
  Vec3 sum = {};
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    sum = sum + p.support[i].weight * unloaded_place(model, p.support[i]);
  }
  return sum;
}

namespace {

// For a CP that keeps its voxels: all voxels around it hold the needle equally. So a row of CPs is
// as stiff and as thick wherever it runs between voxel centres.
void support_evenly(const Model& model, const State& state, Particle& p) {
  const std::uint32_t material = p.material;
  renew_supports(model, state, p, Weighting::kEven);
  p.material = material;
  if (p.support_count > 0) p.rest_m = unloaded_place(model, p);
}

// How much of a skin's puncture force voxels without a skin carry at most, in G h^2. With 4 a
// liver's capsule in voxels of 5 mm that are half full is punctured at 3.4 mm instead of 4.4; with
// 2 contact with weak skins is up to 6 % too soft (tests/fidelity/coupling/contact_test.cpp).
constexpr float kBareMost = 3;

// How far below the face voxels hold a tip in contact, in edges: one; under a thin skin the
// farthest at which voxels without skin carry no more than that, or else as little as possible.
float depth_held(const Model& model, const Particle& p, Vec3 edge_down_m) {
  constexpr int kDepths = 7;  // quarters of an edge apart, from one below the face to half above
  const MaterialModel& m = model.head->material[p.material];
  const float force_n = model.forces[p.material].film.force_n;
  if (!(force_n > 0)) return 1;
  const float most = kBareMost * m.shear_pa * dot(edge_down_m, edge_down_m) / force_n;
  float depth = 1, least = 2;  // of the weights, which are 1 in all
  for (int i = 0; i < kDepths; ++i) {
    const float tried = 1 - 0.25F * static_cast<float>(i);
    Support found[kSupportsPerParticle];
    const std::uint32_t count =
        find_supports(model, p.rest_m + tried * edge_down_m, found, Weighting::kStiff);
    float bare = count > 0 ? 0 : 1;
    for (std::uint32_t k = 0; k < count; ++k) {
      if (!has_skin(model, found[k].slot)) bare += found[k].weight;
    }
    if (!(least > most) || !(bare < least)) continue;
    least = bare;
    depth = tried;
  }
  return depth;
}

// For the tip in contact: the voxels around a place one edge deeper hold it (depth_held). At a face
// these are voxels of two layers, weighted by stiffness (fat does not carry what presses on skin).
// Held by the outer layer alone, the tip presses the lattice in by an amount that no formula of
// Poisson's ratio and place gave.
void support_deeper(const Model& model, const State& state, Particle& p, Vec3 direction) {
  if (p.support_count == 0) return;
  const VoxelFrame frame =
      voxel_frame(model, state, p.support[heaviest(p)].slot, p.support[heaviest(p)].row);
  const Particle before = p;
  const Vec3 edge_down_m = level_of(model, p).edge_m * transposed_times(frame.rotation, direction);
  p.rest_m = p.rest_m + depth_held(model, p, edge_down_m) * edge_down_m;
  renew_supports(model, state, p, Weighting::kStiff);
  if (p.support_count == 0) p = before;
  p.rest_m = before.rest_m;
  p.material = before.material;
}

}  // namespace

Particle new_particle(const Model& model, State& state, const Needle& needle, Vec3 rest_m,
                      Vec3 place_m, float track_m, float arc_m, Role role) {
  Particle p = {};
  p.rest_m = rest_m;
  p.position_m = place_m;
  p.track_m = track_m;
  p.arc_m = arc_m;
  renew_supports(model, state, p);
  const Rules& rules = model.head->rules;
  if (role == Role::kShaft && !rules.one_support) support_evenly(model, state, p);
  if (role == Role::kSurface && !rules.one_support) {
    support_deeper(model, state, p, needle.tip_direction);
  }
  set_stiffness(model, state, p, role);
  // The depth is still zero, and there the law's spring is soft: a stiff one would hold an elastic
  // needle back until the next tick.
  if (role == Role::kSurface && rules.contact_law) {
    p.stiffness_n_per_m = kLeastPart * p.full_stiffness_n_per_m;
  }
  return p;
}

void refill_supports(const Model& model, State& state, Particle& p) {
  if (state.head->cp_voxel_pool_full == 0 || p.support_count == kSupportsPerParticle) return;
  const std::uint32_t material = p.material;
  const double before = spring_energy(p);
  renew_supports(model, state, p,
                 Weighting::kEven);  // one voxel per CP, as in paper mode, fills no pool
  p.material = material;
  state.head->friction_j += before - spring_energy(p);
}

void take_other_voxels(const Model& model, State& state, Particle& p) {
  const double before = spring_energy(p);
  renew_supports(model, state, p, Weighting::kTent);
  if (p.support_count == 0) {
    p.axial_way_m = {};
    forget(p);
  }
  state.head->cutting_j += before - spring_energy(p);
}

void keep_supports(StateHead& state, Particle& p, std::uint32_t kept) {
  const double before = spring_energy(p);
  const auto [residual_m, spread_m2] = residuals(p);
  std::uint32_t count = 0;
  float sum = 0;
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    if (((kept >> i) & 1U) == 0) continue;
    p.support[count++] = p.support[i];
    sum += p.support[i].weight;
  }
  p.support_count = count;
  for (std::uint32_t i = 0; i < count; ++i) p.support[i].weight = p.support[i].weight / sum;
  gather_goals(p, residual_m, spread_m2);
  if (count == 0) {
    p.axial_way_m = {};
    forget(p);
  }
  state.friction_j += before - spring_energy(p);
}

}  // namespace stylet
