// SPDX-License-Identifier: Apache-2.0
// The spring of a constraint particle (CP): residual, force, energy, and how its goals move.
//
// Up to eight voxels hold a CP. Each has a goal for it: the place where the voxel's match puts the
// CP. The needle's point less that goal is a residual. The weighted mean of the residuals, less
// what has relaxed and the axial way (`slack_m`), times the stiffness is the force on the tissue.
// Every function here reads and writes only one CP.
//
// Promises: bounded by kSupportsPerParticle, no allocation, fixed order of sums. Units SI, frame of
// the attachments. Source: paper section IV.A. PHYSICS 10.3, 12.4.
#pragma once

#include "base/math.h"
#include "lattice/voxel.h"
#include "state/layout.h"

namespace stylet {

// A shaft CP keeps at least this part of its spring, so that divisions by the spring are possible.
constexpr float kLeastPart = 0.002F;

// Mean of needle point minus goal over a CP's supports.
inline Vec3 residual(const Particle& p) {
  Vec3 sum = {};
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    sum = sum + p.support[i].weight * (p.position_m - p.support[i].goal_m);
  }
  return sum;
}

// Force on the tissue; `residual_m`, if it is known, is residual(p).
inline Vec3 force_on_tissue(const Particle& p, Vec3 residual_m) {
  if (p.support_count == 0) return {};
  return p.stiffness_n_per_m * (residual_m - p.slack_m);
}
inline Vec3 force_on_tissue(const Particle& p) {
  return force_on_tissue(p, residual(p));
}

// The point of the needle's axis where that force acts: the spring's end, less the axial way.
inline Vec3 grip(const Particle& p) {
  return p.position_m - p.axial_way_m;
}

// Mean square of how the supports' residuals differ from their mean.
inline float spread_of(const Particle& p, Vec3 mean_m) {
  float sum = 0;
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    const Vec3 off = (p.position_m - p.support[i].goal_m) - mean_m;
    sum += p.support[i].weight * dot(off, off);
  }
  return sum;
}

// Energy in the Maxwell branch, for one CP: see creep.
inline double memory_energy(const Particle& p) {
  const float in_branch = p.relaxing_fraction * (1 - p.relaxing_fraction);
  return 0.5 * static_cast<double>(in_branch * max_of(dot(p.memory_n, p.memory_m), 0));
}

// The mean residual of a CP's supports, and their spread.
struct Residuals {
  Vec3 residual_m;
  float spread_m2;
};
inline Residuals residuals(const Particle& p) {
  const Vec3 mean = residual(p);
  return {mean, spread_of(p, mean)};
}

// Energy in a CP's spring, Maxwell branch and axial way; for a tip in contact see contact_energy.
inline double spring_energy(const Particle& p, const Residuals& d) {
  const Vec3 lasting = d.residual_m - p.slack_m;
  const float give = p.axial_fraction > 0 ? (1 - p.axial_fraction) / p.axial_fraction *
                                                dot(p.axial_way_m, p.axial_way_m)
                                          : 0.0F;
  const float sum = dot(lasting, lasting) + d.spread_m2 + give;
  return 0.5 * static_cast<double>(p.stiffness_n_per_m * sum) + memory_energy(p);
}
inline double spring_energy(const Particle& p) {
  return spring_energy(p, residuals(p));
}

// The slack, which is the axial way and the relaxed part; only the rest of the residual gives
// force.
inline void set_slack(Particle& p) {
  p.slack_m = p.relaxing_fraction * p.memory_m + p.axial_way_m;
}

// For fresh tissue, which has not relaxed yet.
inline void forget(Particle& p) {
  p.memory_m = p.memory_n = {};
  p.memory_spread = 0;
  set_slack(p);
}

// Lets a voxel hold tissue that lies `step_m` farther on.
inline void shift_goal(Support& support, Vec3 step_m) {
  support.offset_m = support.offset_m + transposed_times(rotation_matrix(support.turn), step_m);
  support.goal_m = support.goal_m + step_m;
}

// Lets a CP hold tissue that lies `step_m` farther on: its goals move by that.
inline void shift_goals(Particle& p, Vec3 step_m) {
  for (std::uint32_t i = 0; i < p.support_count; ++i) shift_goal(p.support[i], step_m);
}

// Moves each goal towards the needle by a part of the distance.
inline void pull_goals(Particle& p, float part) {
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    shift_goal(p.support[i], part * (p.position_m - p.support[i].goal_m));
  }
}

// Moves the supports of a CP closer together, so that its residual is `residual_m` and their
// spread at most `spread_m2`: new weights must neither be felt nor add energy.
inline void gather_goals(Particle& p, Vec3 residual_m, float spread_m2) {
  const auto [mean, spread] = residuals(p);
  const float part = spread > spread_m2 ? 1 - std::sqrt(spread_m2 / spread) : 0.0F;
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    const Vec3 off = (p.position_m - p.support[i].goal_m) - mean;
    shift_goal(p.support[i], (mean - residual_m) + part * off);
  }
}

// Index of the support with the largest weight.
inline std::uint32_t heaviest(const Particle& p) {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < p.support_count; ++i) {
    if (p.support[i].weight > p.support[best].weight) best = i;
  }
  return best;
}

// The level of the voxels around it: that of the heaviest.
inline const Level& level_of(const Model& model, const Particle& p) {
  if (p.support_count == 0) return model.head->level[0];
  return level_of(model, model.row[p.support[heaviest(p)].row]);
}

// Call after a turn of the needle: the axial way of a shaft CP lies along the needle and turns with
// it. The CP's spring is fixed to a point of the needle (grip); the turn moves that point, and the
// work of the torque is the change of energy.
inline void turn_axial_way(Particle& p, Vec3 direction) {
  if (p.axial_fraction == 0) return;
  const float size_m = norm(p.axial_way_m);
  p.axial_way_m = settle((dot(p.axial_way_m, direction) < 0 ? -size_m : size_m) * direction);
  set_slack(p);
}

// By how much the motion of the needle in this tick stretches the spring of CP `index` (a shaft CP
// or, as the last index, the tip). The substeps do it in equal parts (place_members).
inline Vec3& stretch_of(const State& state, Scratch& scratch, std::uint32_t index) {
  return scratch.stretch[state.needle_index * kNeedleParticles + index];
}

}  // namespace stylet
