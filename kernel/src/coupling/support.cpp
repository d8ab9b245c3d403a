// SPDX-License-Identifier: Apache-2.0
#include "coupling/support.h"

#include "coupling/fit.h"
#include "coupling/spring.h"

namespace stylet {

void renew_shares(const Model& model, const State& state, Particle& p, Sharing sharing) {
  const auto [residual_m, spread_m2] = drawn(p);
  Share found[kSharesPerParticle];
  const std::uint32_t count = find_shares(model, p.rest_m, found, sharing);
  for (std::uint32_t i = 0; i < count; ++i) {
    Share& share = found[i];
    bool kept = false;
    for (std::uint32_t old = 0; old < p.share_count; ++old) {
      if (p.share[old].slot != share.slot) continue;
      share.offset_m = p.share[old].offset_m;
      share.goal_m = p.share[old].goal_m;
      share.turn = p.share[old].turn;
      kept = true;
    }
    if (kept) continue;
    const FitFrame frame = fit_frame(model, state, share.slot, share.row);
    share.turn = frame.turn;
    share.goal_m = p.position_m - residual_m;
    share.offset_m = transposed_times(rotation_matrix(frame.turn), share.goal_m - frame.centre_m);
  }
  for (std::uint32_t i = 0; i < count; ++i) p.share[i] = found[i];
  p.share_count = count;
  gather_goals(p, residual_m, spread_m2);
  if (count == 0) return;
  const std::uint32_t there = material_at(model, p.rest_m);
  p.material = there != kNoTissue ? there : model.slot_material[p.share[heaviest(p)].slot];
}

Vec3 unloaded_place(const Model& model, const Share& share) {
  return rest_centre(model, share.slot, model.row[share.row]) + share.offset_m;
}
Vec3 unloaded_place(const Model& model, const Particle& p) {
  Vec3 sum = {};
  for (std::uint32_t i = 0; i < p.share_count; ++i) {
    sum = sum + p.share[i].weight * unloaded_place(model, p.share[i]);
  }
  return sum;
}

namespace {

// For a CP that keeps its voxels: each of those around it holds the needle alike, so that a row of
// CPs is as stiff and as thick wherever it runs between voxel centres.
void share_evenly(const Model& model, const State& state, Particle& p) {
  const std::uint32_t material = p.material;
  renew_shares(model, state, p, Sharing::kEven);
  p.material = material;
  if (p.share_count > 0) p.rest_m = unloaded_place(model, p);
}

// For the tip in contact: the voxels around the place one edge deeper hold it, at a face those of
// two layers, each as much as it is stiff (fat does not carry what presses on skin). Held by the
// outer layer alone it presses the lattice in by an amount that no formula of Poisson's ratio and
// place gave.
void share_deeper(const Model& model, const State& state, Particle& p, Vec3 direction) {
  if (p.share_count == 0) return;
  const VoxelFrame frame =
      voxel_frame(model, state, p.share[heaviest(p)].slot, p.share[heaviest(p)].row);
  const Particle before = p;
  const float edge_m = model.head->edge_m;
  p.rest_m = p.rest_m + edge_m * transposed_times(frame.rotation, direction);
  renew_shares(model, state, p, Sharing::kStiff);
  if (p.share_count == 0) p = before;
  p.rest_m = before.rest_m;
  p.material = before.material;
}

}  // namespace

Particle new_particle(const Model& model, State& state, const Needle& needle, Vec3 rest_m,
                      Vec3 place_m, float track_m, float arc_m, Place place) {
  Particle p = {};
  p.rest_m = rest_m;
  p.position_m = place_m;
  p.track_m = track_m;
  p.arc_m = arc_m;
  renew_shares(model, state, p);
  const bool physical = model.head->config.mode == Mode::kPhysical;
  if (place == Place::kShaft && physical) share_evenly(model, state, p);
  if (place == Place::kSurface && physical) share_deeper(model, state, p, needle.tip_direction);
  set_stiffness(model, state, p, place);
  // No depth yet: the law's spring is soft there, and a stiff one would hold an elastic needle back
  // until the next tick lets it go.
  if (place == Place::kSurface && physical) {
    p.stiffness_n_per_m = kLeastPart * p.full_stiffness_n_per_m;
  }
  return p;
}

void refill_shares(const Model& model, State& state, Particle& p) {
  if (state.head->cp_voxel_pool_full == 0 || p.share_count == kSharesPerParticle) return;
  const std::uint32_t material = p.material;
  const double before = spring_energy(p);
  renew_shares(model, state, p, Sharing::kEven);  // a voxel a CP, as in paper mode, fills no pool
  p.material = material;
  state.head->friction_j += before - spring_energy(p);
}

void keep_shares(StateHead& state, Particle& p, std::uint32_t kept) {
  const double before = spring_energy(p);
  const auto [residual_m, spread_m2] = drawn(p);
  std::uint32_t count = 0;
  float sum = 0;
  for (std::uint32_t i = 0; i < p.share_count; ++i) {
    if (((kept >> i) & 1U) == 0) continue;
    p.share[count++] = p.share[i];
    sum += p.share[i].weight;
  }
  p.share_count = count;
  for (std::uint32_t i = 0; i < count; ++i) p.share[i].weight = p.share[i].weight / sum;
  gather_goals(p, residual_m, spread_m2);
  if (count == 0) {
    p.give_m = {};
    forget(p);
  }
  state.friction_j += before - spring_energy(p);
}

}  // namespace stylet
