// SPDX-License-Identifier: Apache-2.0
#include "coupling/contact_spring.h"

#include "coupling/spring.h"

namespace stylet {

double contact_energy(const Model& model, const State& state, const Particle& p) {
  if (!model.head->rules.contact_law) return spring_energy(p);
  const Vec3 d = residual(p);
  return contact_energy(law_of(model, state), d, p.full_stiffness_n_per_m * p.memory_m) +
         0.5 * static_cast<double>(p.stiffness_n_per_m * spread_of(p, d));
}

double tip_energy(const Model& model, const State& state, const Particle& tip) {
  const bool contact = state.needle->phase == Phase::kContact;
  return contact ? contact_energy(model, state, tip) : spring_energy(tip);
}

namespace {

// The spring of the next match: the law's tangent. Where the needle has just pressed on, tissue
// yields until the depth is about what it was before. There the tangent would lie far below the
// law: the hand would spend less than is stored. So there it is the chord to that depth.
float contact_spring(const ContactLaw& law, float depth_m, float before_m) {
  const float tangent = cone_tangent(law.now, depth_m);
  if (!(depth_m - before_m > kChordM)) return tangent;
  const float change =
      contact_secant(law, depth_m) * depth_m - contact_secant(law, before_m) * before_m;
  return min_of(tangent, change / (depth_m - before_m));
}

}  // namespace

void relax_contact(const Model& model, State& state, Vec3 direction, Vec3 step_m) {
  Particle& p = *state.tip;
  const ContactLaw law = law_of(model, state);
  const double before = contact_energy(model, state, p);
  const Vec3 d = residual(p);
  const float depth = norm(d), period_s = model.head->config.period_s;
  const Vec3 force = contact_secant(law, depth) * d;
  const Vec3 all = missing_secant(law, depth) * d;
  const float k = p.full_stiffness_n_per_m;
  const float time_s =
      model.head->material[p.material].relaxation_time_s * relaxation_pace(law, depth);
  const float keep = exp_minus(period_s / max_of(time_s, period_s));
  Vec3 missing = all + keep * (k * p.memory_m - all);
  const float pull = dot(missing - force, direction);
  if (pull > 0 && law.fraction > 0) missing = missing - pull * direction;
  p.memory_m = settle((1 / k) * missing);
  state.head->relaxation_j += before - contact_energy(model, state, p);
  const float old = p.stiffness_n_per_m;
  p.stiffness_n_per_m = max_of(contact_spring(law, depth, norm(d - step_m)), kLeastPart * k);
  gather_goals(p, d, spread_of(p, d) * min_of(old / p.stiffness_n_per_m, 1));
  p.slack_m = settle(d - (1 / p.stiffness_n_per_m) * (force - missing));
}

}  // namespace stylet
