// SPDX-License-Identifier: Apache-2.0
#include "coupling/relaxation.h"

#include "coupling/spring.h"
#include "coupling/support.h"

namespace stylet {
namespace {

// Time constant of the damper over which the axial way goes to equilibrium.
constexpr float kAxialWayTimeS = 1e-3F;
// If a whole tick's creep would gain energy, at least this part of it is tried: with short times
// the spring yields faster than the lattice follows.
constexpr float kLeastCreep = 1.0F / 16;

// The whole force must relax, not only the part of the CP's own spring. Let d be the way of the
// needle's point from where its tissue lies unloaded. All CPs' forces are F = K d, where K is the
// springs and the lattice behind them, whatever that is. So each spring ends phi m behind that
// point, with m' = (d - m) / tau, and all of F relaxes by the part phi in the time tau. (d is the
// needle's way alone, so no swing of the tissue feeds back. Nor does d count how far others had
// moved the tissue before this needle came: that does not pull it.) That takes a Maxwell branch
// with the energy phi (1 - phi) m n / 2 summed over all CPs, n = K m. It needs no K: n' = (F + phi
// n - n) / tau. Where one CP's m n is below 0 it stores nothing.
//
// A CP's supports hold the tissue as it was deformed when the CP took hold of it. So their d
// differ. As these differences do not change, the places where they lie unloaded are moved together
// by that part.
//
// The branch goes this part of its way; `residual_m` is the CP's.
void creep(const Model& model, const State& state, Particle& p, Vec3 residual_m, float part) {
  const Vec3 rest_m = unloaded_place(model, p);
  const Vec3 d = (p.position_m - rest_m) - state.needle->moved_m;
  const Vec3 f = force_on_tissue(p, residual_m) + p.relaxing_fraction * p.memory_n;
  p.memory_m = settle(p.memory_m + part * (d - p.memory_m));
  p.memory_n = settle(p.memory_n + part * (f - p.memory_n));
  set_slack(p);
  const float before = p.memory_spread;
  p.memory_spread = before + part * (p.relaxing_fraction - before);
  if (p.memory_spread == before) return;
  const float drawn = (p.memory_spread - before) / max_of(1 - before, kLeastPart);
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    Support& support = p.support[i];
    const Vec3 step = drawn * (rest_m - unloaded_place(model, support));
    support.offset_m = support.offset_m + step;
    support.goal_m = support.goal_m + rotation_matrix(support.turn) * step;
  }
}

// The Maxwell branch creeps by this part of its way. What it dissipates is booked, and others may
// use it (`spare_j`). If energy would rise by more than that, nothing changes, and the excess is
// returned.
double try_creep(const Model& model, State& state, Particle& p, Residuals& d, float part,
                 double& spare_j) {
  if (p.relaxing_fraction == 0 || p.support_count == 0) return 0;
  const Particle before = p;
  const double before_j = spring_energy(p, d);
  creep(model, state, p, d.residual_m, part);
  const Residuals crept = residuals(p);
  const double rise_j = spring_energy(p, crept) - before_j;
  if (rise_j <= spare_j) {
    spare_j -= rise_j;
    state.head->relaxation_j -= rise_j;
    d = crept;
    return 0;
  }
  p = before;
  return rise_j;
}

// The Maxwell branch creeps for a tick. False: it did not, because energy would rise.
bool relax(const Model& model, State& state, Particle& p, Residuals& d, double& spare_j) {
  return try_creep(model, state, p, d, 1 - p.memory_keep, spare_j) == 0;
}

// The same for a CP whose creep the others must pay for: as far as they do.
void relax_late(const Model& model, State& state, Particle& p, Residuals& d, double& spare_j) {
  const float all = 1 - p.memory_keep;
  const double rise_j = try_creep(model, state, p, d, all, spare_j);
  if (rise_j == 0) return;
  const float part = all * max_of(kLeastCreep, static_cast<float>(spare_j / rise_j));
  (void)try_creep(model, state, p, d, part, spare_j);
}

// The axial way follows the force along the needle, as over a damper (implicit, so that no tick is
// too long for it). Only along: taking back a part that lies across would take work against the
// force there.
void follow_axially(const Model& model, StateHead& state, Particle& p, const Residuals& d,
                    Vec3 direction) {
  if (p.axial_fraction == 0) return;
  const double before_j = spring_energy(p, d);
  const float pull_m = dot(force_on_tissue(p, d.residual_m), direction) / p.stiffness_n_per_m;
  const float to_go_m =
      p.axial_fraction * pull_m - (1 - p.axial_fraction) * dot(p.axial_way_m, direction);
  const float period_s = model.head->config.period_s;
  const float part = period_s / (period_s + kAxialWayTimeS);
  p.axial_way_m = settle(p.axial_way_m + part * to_go_m * direction);
  set_slack(p);
  state.relaxation_j += before_j - spring_energy(p, d);
}

// A shaft CP moves with the needle.
void follow(const Model& model, State& state, const Needle& needle, Particle& p,
            const Residuals& d) {
  const NeedlePoint point = needle_point(needle, p.arc_m);
  follow_axially(model, *state.head, p, d, point.direction);
  p.position_m = point.place_m;
  turn_axial_way(p, point.direction);
}

}  // namespace

void relax_and_follow(const Model& model, State& state, const Needle& needle) {
  const NeedleState& own = *state.needle;
  Particle& tip = *state.tip;
  bool late[kMaxConstraintParticles] = {};
  double spare_j = 0;
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    Particle& p = state.shaft[i];
    refill_supports(model, state, p);
    Residuals d = residuals(p);
    late[i] = !relax(model, state, p, d, spare_j);
    if (!late[i]) follow(model, state, needle, p, d);
  }
  Residuals tip_d = residuals(tip);
  if (!relax(model, state, tip, tip_d, spare_j)) {
    relax_late(model, state, tip, tip_d, spare_j);
  }
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    if (!late[i]) continue;
    Particle& p = state.shaft[i];
    Residuals d = residuals(p);
    relax_late(model, state, p, d, spare_j);
    follow(model, state, needle, p, d);
  }
}

}  // namespace stylet
