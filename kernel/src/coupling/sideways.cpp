// SPDX-License-Identifier: Apache-2.0
#include "coupling/sideways.h"

#include "coupling/deformation.h"
#include "coupling/spring.h"
#include "coupling/support.h"

namespace stylet {

Vec3 cut_sideways(const Model& model, State& state, Particle& p, Vec3 direction, float limit_n) {
  const Vec3 force = force_on_tissue(p);
  const Vec3 across = force - dot(force, direction) * direction;
  const float across_n = norm(across);
  if (!(across_n > limit_n)) return {};
  const Vec3 step = ((across_n - limit_n) / (across_n * p.stiffness_n_per_m)) * across;
  const double before = spring_energy(p);
  p.rest_m = p.rest_m + pull_back_step(gradient_around(model, state, p), step);
  shift_goals(p, step);
  state.head->cutting_j += before - spring_energy(p);
  return step;
}

Vec3 cut_shaft_sideways(const Model& model, State& state, Particle& p, Vec3 direction,
                        float length_m) {
  const float sideways_n_per_m = model.forces[p.material].sideways_n_per_m;
  const bool cuts = sideways_n_per_m > 0 && p.support_count > 0 && !model.head->rules.unit_slips;
  if (!cuts) return {};
  const Vec3 step = cut_sideways(model, state, p, direction, sideways_n_per_m * length_m);
  if (dot(step, step) == 0) return {};
  take_other_voxels(model, state, p);
  return step;
}

}  // namespace stylet
