// SPDX-License-Identifier: Apache-2.0
#include "coupling/friction.h"

#include "coupling/return_map.h"
#include "coupling/sideways.h"
#include "coupling/spring.h"
#include "lattice/voxel.h"

namespace stylet {
namespace {

// Number of places at which friction is sampled along the shaft that the tip passes in a tick.
constexpr std::uint32_t kFrictionSamples = 4;

// Tributary length of a CP.
float length_of(const Model& model, const State& state, const Particle& p) {
  return clamp(state.needle->tissue_track_m - p.track_m, 0, model.needle_config().unit_m);
}

}  // namespace

void take_tributary_spring(const Model& model, State& state, Particle& p) {
  const float part =
      model.head->rules.voxel_springs
          ? 1.0F
          : max_of(length_of(model, state, p) / model.needle_config().unit_m, kLeastPart);
  const float stiffness = part * p.full_stiffness_n_per_m;
  if (stiffness == p.stiffness_n_per_m) return;
  const double before = spring_energy(p);
  // New stiffness holds its tissue where it lies, without force.
  if (stiffness > p.stiffness_n_per_m) {
    const float old = p.stiffness_n_per_m / stiffness;
    pull_goals(p, 1 - old);
    p.memory_m = old * p.memory_m;
    p.axial_way_m = old * p.axial_way_m;
    p.slack_m = old * p.slack_m;
  } else {
    p.memory_n = (stiffness / p.stiffness_n_per_m) * p.memory_n;
  }
  p.stiffness_n_per_m = stiffness;
  state.head->friction_j += before - spring_energy(p);
}

namespace {

// No friction in a gap.
Friction friction_at(const Model& model, Vec3 rest_m) {
  const std::uint32_t there = material_at(model, rest_m);
  return there == kNoTissue ? Friction{} : model.forces[there].friction;
}

}  // namespace

void gather_friction(const Model& model, State& state, Vec3 from_m, float from_track_m) {
  const Particle& tip = *state.tip;
  for (std::uint32_t i = 0; i < state.needle->shaft_count; ++i) {
    Particle& p = state.shaft[i];
    const float length = length_of(model, state, p), grown = length - p.friction_length_m;
    if (!(grown > 0)) continue;
    const float step = grown * (1.0F / kFrictionSamples), all = tip.track_m - from_track_m;
    for (std::uint32_t k = 0; k < kFrictionSamples; ++k) {
      const float at = p.track_m + p.friction_length_m + 0.5F * step - from_track_m;
      const float part = all > 0 ? clamp(at / all, 0, 1) : 1.0F;
      p.friction_length_m += step;
      const Friction here = friction_at(model, from_m + part * (tip.rest_m - from_m));
      p.friction = mixed(p.friction, here, step / p.friction_length_m);
    }
    p.friction_length_m = length;  // exactly, or rounding would bring it here again and again
  }
}

float friction_limit_n(const Model& model, const State& state, const Particle& p) {
  return friction_n_per_m(p.friction, p.slip_m_per_s) * length_of(model, state, p);
}

void slip_shaft(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                float moved_m) {
  const ModelHead& head = *model.head;
  NeedleState& own = *state.needle;
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    Particle& p = state.shaft[i];
    // All changes of the spring come before the return map, which must decide the force
    // last.
    take_tributary_spring(model, state, p);
    const float limit = friction_limit_n(model, state, p);
    const Vec3 direction = needle_point(needle, p.arc_m).direction;
    const Vec3 residual_m = residual(p), force = force_on_tissue(p, residual_m);
    const float slip = overshoot(model, p, dot(force, direction), -limit, limit);
    stretch_of(state, scratch, i) =
        (1 / p.stiffness_n_per_m) * (force - p.force_n) - slip * direction;
    const float whole = slip + renew(model, p, direction, slip, moved_m, state.head->friction_j);
    p.arc_m += whole;
    p.position_m = needle_place(needle, p.arc_m);
    note_slip(head, p, whole);
    p.slip_m = slip * direction;
    const float length_m = length_of(model, state, p);
    const Vec3 aside = cut_shaft_sideways(model, state, p, direction, length_m);
    Vec3& stretch = stretch_of(state, scratch, i);
    stretch = stretch - aside;
  }
}

void slip_after_step(const Model& model, State& state, const Needle& needle, Particle& p) {
  const float loose_m = kEndTolerance * model.needle_config().unit_m;
  const float least = loose_m * least_friction_n_per_m(p.friction);
  const bool pushes = dot(p.force_n, p.slip_m) < 0;
  if (!(p.friction_length_m > 0) || (!pushes && dot(p.force_n, p.force_n) <= least * least)) return;
  const float limit = loose_m * friction_n_per_m(p.friction, p.slip_m_per_s);
  const Vec3 direction = needle_point(needle, p.arc_m).direction;
  const float before_n = dot(p.force_n, direction), slipped_m = dot(p.slip_m, direction);
  const float stuck_n = before_n + slipped_m * p.stiffness_n_per_m;  // had it not slipped
  const float low_n = slipped_m > 0 ? clamp(stuck_n, -limit, 0) : -limit;
  const float high_n = slipped_m < 0 ? clamp(stuck_n, 0, limit) : limit;
  const float slip = overshoot(model, p, before_n, low_n, high_n);
  if (slip == 0) return;
  p.arc_m += slip;
  p.position_m = needle_place(needle, p.arc_m);
  if (pushes) {
    // It still slides (slip_m): the next tick decides how far.
    note_no_slip(*model.head, p, slip);
  } else {
    p.slip_m = p.slip_m + slip * direction;
  }
  p.force_n = force_on_tissue(p);
  const float work = 0.5F * slip * (before_n + dot(p.force_n, direction));
  state.head->friction_j += static_cast<double>(work);
}

}  // namespace stylet
