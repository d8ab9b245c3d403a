// SPDX-License-Identifier: Apache-2.0
// The spring of a constraint particle (CP): residual, force, energy, and how its goals move.
//
// A CP is held by up to eight voxels. Each has a goal for it, the place where the voxel's match
// puts the CP; the needle's point less that goal is a residual. Their weighted mean, less what has
// relaxed and what gives way along the needle (`slack_m`), times the stiffness is the force on the
// tissue. Everything here reads and writes one CP and nothing else.
//
// Promises: bounded by kSupportsPerParticle, no allocation, fixed order of sums. Units SI, frame of
// the attachments. Source: paper section IV.A. PHYSICS 10.3, 12.4.
#pragma once

#include "base/math.h"
#include "state/layout.h"

namespace stylet {

// A shaft CP keeps at least this part of its spring, so that forces can be divided by it.
constexpr float kLeastPart = 0.002F;

// Mean of needle point minus goal over a CP's supports.
inline Vec3 residual(const Particle& p) {
  Vec3 sum = {};
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    sum = sum + p.support[i].weight * (p.position_m - p.support[i].goal_m);
  }
  return sum;
}

// On the tissue; `residual_m`, where it is known, is residual(p).
inline Vec3 force_on_tissue(const Particle& p, Vec3 residual_m) {
  if (p.support_count == 0) return {};
  return p.stiffness_n_per_m * (residual_m - p.slack_m);
}
inline Vec3 force_on_tissue(const Particle& p) {
  return force_on_tissue(p, residual(p));
}

// Point of the needle's axis where that force acts: the spring's end, behind the give.
inline Vec3 grip(const Particle& p) {
  return p.position_m - p.give_m;
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

// Energy in the Maxwell branch; of one CP, see creep.
inline double memory_energy(const Particle& p) {
  const float in_branch = p.relaxing_fraction * (1 - p.relaxing_fraction);
  return 0.5 * static_cast<double>(in_branch * max_of(dot(p.memory_n, p.memory_m), 0));
}

// How the supports of a CP lie: their mean residual, and how much they differ from it.
struct Residuals {
  Vec3 residual_m;
  float spread_m2;
};
inline Residuals residuals(const Particle& p) {
  const Vec3 mean = residual(p);
  return {mean, spread_of(p, mean)};
}

// Energy in a CP's spring, Maxwell branch and give; for the tip in contact see contact_energy.
inline double spring_energy(const Particle& p, const Residuals& d) {
  const Vec3 lasting = d.residual_m - p.slack_m;
  const float give = p.axial_fraction > 0
                         ? (1 - p.axial_fraction) / p.axial_fraction * dot(p.give_m, p.give_m)
                         : 0.0F;
  const float sum = dot(lasting, lasting) + d.spread_m2 + give;
  return 0.5 * static_cast<double>(p.stiffness_n_per_m * sum) + memory_energy(p);
}
inline double spring_energy(const Particle& p) {
  return spring_energy(p, residuals(p));
}

// The residual is the give, the relaxed part of the spring, and what pulls.
inline void set_slack(Particle& p) {
  p.slack_m = p.relaxing_fraction * p.memory_m + p.give_m;
}

// Fresh tissue, which has relaxed nothing yet.
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

// Draws each goal a part of the way to the needle.
inline void pull_goals(Particle& p, float part) {
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    shift_goal(p.support[i], part * (p.position_m - p.support[i].goal_m));
  }
}

// Draws the supports of a CP together, so that its residual is `residual_m` and their spread at
// most `spread_m2`: new weights must neither be felt nor bring energy along.
inline void gather_goals(Particle& p, Vec3 residual_m, float spread_m2) {
  const auto [mean, spread] = residuals(p);
  const float part = spread > spread_m2 ? 1 - std::sqrt(spread_m2 / spread) : 0.0F;
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    const Vec3 off = (p.position_m - p.support[i].goal_m) - mean;
    shift_goal(p.support[i], (mean - residual_m) + part * off);
  }
}

// Which support has the largest weight.
inline std::uint32_t heaviest(const Particle& p) {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < p.support_count; ++i) {
    if (p.support[i].weight > p.support[best].weight) best = i;
  }
  return best;
}

// The needle has turned: the give of a shaft CP is a way along it, and turns with it. Its spring is
// fixed to a point of the needle (grip), which a turn moves, and whose torque pays for it.
inline void turn_give(Particle& p, Vec3 direction) {
  if (p.axial_fraction == 0) return;
  const float size_m = norm(p.give_m);
  p.give_m = settle((dot(p.give_m, direction) < 0 ? -size_m : size_m) * direction);
  set_slack(p);
}

// By how much the needle's motion in this tick pulls the spring of a CP of the shaft, or of the
// tip, the last: substep by substep (place_members).
inline Vec3& stretch_of(const State& state, Scratch& scratch, std::uint32_t index) {
  return scratch.stretch[state.needle_index * kNeedleParticles + index];
}

}  // namespace stylet
