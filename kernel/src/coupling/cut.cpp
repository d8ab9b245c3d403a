// SPDX-License-Identifier: Apache-2.0
#include "coupling/cut.h"

#include "coupling/deformation.h"
#include "coupling/layers.h"
#include "coupling/membranes.h"
#include "coupling/return_map.h"
#include "coupling/sideways.h"
#include "coupling/spring.h"
#include "coupling/stiffness.h"
#include "coupling/support.h"
#include "coupling/track.h"
#include "state/events.h"
#include "state/layout.h"

namespace stylet {
namespace {

// The tip reaches the material at its goal within this length of travel.
constexpr float kMaterialPullM = 1e-3F;
// The same where parts slide: behind their face lies another place than at rest, at once. With the
// length above, a tip that crosses parts which have slid by two voxels lags for 3 mm.
constexpr float kSlidPullM = 1e-5F;

}  // namespace

float puncture_force(const Model& model, const State& state, std::uint32_t material,
                     float given_n) {
  const float faster = relative_speed(state.needle->press_m_per_s);
  return given_n * power(faster, -model.head->material[material].puncture_exponent);
}

namespace {

// Moves the tissue that the tip holds forward by `move_m` along the needle, integrated in the rest
// frame. While it moves, or when they are voxels apart, the tip's rest place is pulled to the
// material that really lies at its goal, so that errors of the integration do not add up; but not
// through a membrane. A tip that moves back has its own hole.
void advance_tip(const Model& model, State& state, Particle& tip, Vec3 direction, float move_m) {
  const Gradient g = gradient_around(model, state, tip);
  const Vec3 step = move_m * direction;
  Vec3 image = tip.support_count > 0 ? pull_back_step(g, step) : step;
  if (move_m > 0 && tip.support_count > 0) image = free_part(model, state, image).clear * image;
  shift_goals(tip, step);
  tip.rest_m = tip.rest_m + image;
  tip.track_m += move_m < 0 ? -norm(image) : norm(image);
  if (move_m != 0 && tip.support_count > 0) note_place(model, state);
  Vec3 present = {};
  if (tip.support_count == 0 || !present_place(model, state, tip.rest_m, present)) return;
  const Vec3 off = (tip.position_m - residual(tip)) - present;
  const float size = move_m < 0 ? -move_m : move_m;
  const float pull_m = has_slides(model) ? kSlidPullM : kMaterialPullM;
  Vec3 miss = (size / (size + pull_m)) * pull_back_step(g, off);
  miss = free_part(model, state, miss).clear * miss;
  tip.rest_m = tip.rest_m + miss;
  if (move_m != 0) note_place(model, state);
  const Vec3 along = pull_back(g, direction);
  tip.track_m += dot(miss, along) / norm(along);
}

// Gives the tip the spring for the material that it has reached. A stiffer spring holds at the same
// force, and fresh tissue has not relaxed yet. The energy that is lost counts as cutting.
void enter_material(const Model& model, State& state, Particle& tip, Role role = Role::kTip) {
  const double before = spring_energy(tip);
  const float old = tip.stiffness_n_per_m;
  shift_goals(tip, tip.slack_m);
  forget(tip);
  set_stiffness(model, state, tip, role);
  if (tip.stiffness_n_per_m > old) pull_goals(tip, 1 - old / tip.stiffness_n_per_m);
  state.head->cutting_j += before - spring_energy(tip);
}

// The tip presses against a membrane: a film, unless its tissue has no tension.
void press_against(const Model& model, State& state, Particle& tip, std::uint32_t membrane) {
  const std::uint32_t there = tip.material;
  tip.material = membrane;
  const bool film = model.forces[membrane].film.force_n > 0;
  enter_material(model, state, tip, film ? Role::kMembrane : Role::kTip);
  tip.material = there;
  state.needle->spring_layer = membrane;
  tip.force_n = force_on_tissue(tip);  // what slips in this tick begins from it
}

// The tip has the spring of the tissue that it lies in again.
void leave_film(const Model& model, State& state, Particle& tip) {
  enter_material(model, state, tip);
  state.needle->spring_layer = tip.material;
  tip.force_n = force_on_tissue(tip);
}

// A membrane that holds the tip breaks once it is pressed hard enough.
void press_membrane(const Model& model, State& state, Particle& tip, Vec3 direction) {
  const std::uint32_t held = holding_membrane(model, state);
  if (held == kNoTissue) return;
  // As the hand feels it: what a stiff spring takes before the tissue has yielded does not count.
  const float axial = dot(tip.force_n, direction);
  if (axial < puncture_force(model, state, held, model.forces[held].layer_n)) return;
  let_go(model, state, true);
  leave_film(model, state, tip);
  const std::uint32_t layer = state.needle->layer;
  state.needle->layer = held;
  add_event(state, EventKind::kPuncture, axial);
  state.needle->layer = layer;
}

// How much of a slip of the tip by `slip_m` no membrane is in the way of; what is in the way holds
// the tip from then on.
float slip_to_membrane(const Model& model, State& state, Particle& tip, Vec3 direction,
                       float slip_m) {
  if (!has_membranes(model) || !(slip_m > 0)) return 1;
  const Vec3 way = pull_back_step(gradient_around(model, state, tip), slip_m * direction);
  const MembraneCrossing met = free_part(model, state, way);
  if (met.material == kNoTissue || holding_membrane(model, state) == met.material) return met.clear;
  hold_at(state, met);
  press_against(model, state, tip, met.material);
  return met.clear;
}

// A tip that moves back, or is outside the tissue, is not held.
void leave_membrane(const Model& model, State& state, Particle& tip) {
  const bool held = holding_membrane(model, state) != kNoTissue;
  let_go(model, state, false);
  if (held && tip.support_count > 0) leave_film(model, state, tip);
}

// The tip has reached another material. A layer that must be punctured holds the tip until it is
// pressed hard enough, except a layer it has been through before: in a track, or on the way back.
void enter_layer(const Model& model, State& state, Particle& tip, Vec3 direction, bool in_track) {
  NeedleState& own = *state.needle;
  const ModelHead& head = *model.head;
  if (tip.material == own.layer) return;
  const float axial = dot(force_on_tissue(tip), direction);
  if (own.spring_layer != tip.material) enter_material(model, state, tip);
  own.spring_layer = tip.material;
  // A tip at the face between two layers does not change layers with every tremor.
  const float since = tip.track_m - own.layer_track_m;
  if (tip.material == own.layer_before && since < kLayerSkinM && since > -kLayerSkinM) return;
  const NeedleForces& f = model.forces[tip.material];
  const bool must = f.layer_n > f.cutting_n && !in_track && own.phase != Phase::kRetracting &&
                    head.rules.layer_punctures;
  if (must && axial < puncture_force(model, state, tip.material, f.layer_n)) return;
  own.layer_before = own.layer;
  own.layer_track_m = tip.track_m;
  own.layer = tip.material;
  if (must) {
    add_event(state, EventKind::kPuncture, max_of(axial, 0));
  } else {
    tell_layer(state, max_of(axial, 0));
  }
}

// Force that the tip may carry: nothing when pulled, the cutting force when pushed into new tissue,
// a fraction of it in an existing track, the puncture force at a layer or membrane that holds it.
float tip_limit(const Model& model, const State& state, const Particle& tip, bool in_track) {
  const NeedleForces& f = model.forces[tip.material];
  const float cut_n = cutting_n(f, tip.slip_m_per_s);
  const std::uint32_t held = holding_membrane(model, state);
  if (held != kNoTissue) {
    return max_of(puncture_force(model, state, held, model.forces[held].layer_n), cut_n);
  }
  if (in_track) return f.recut_n;
  if (tip.material == state.needle->layer) return cut_n;
  return max_of(puncture_force(model, state, tip.material, f.layer_n), cut_n);
}

// Where the tip cuts after `advance_m` more; a tip without bevel cuts in its own direction.
Vec3 turn_cut(const Model& model, const State& state, const Needle& needle, float advance_m) {
  const float bevel = model.needle_config().bevel_per_m;
  if (!(bevel > 0)) return needle.tip_direction;
  return turn_cut(state.needle->cut, needle, bevel, advance_m);
}

}  // namespace

void cut_tip(const Model& model, State& state, const Needle& needle, float moved_m) {
  const ModelHead& head = *model.head;
  NeedleState& own = *state.needle;
  Particle& tip = *state.tip;
  const Vec3 direction = turn_cut(model, state, needle, 0);
  float move = moved_m;  // outside the tissue the tip carries nothing and follows the needle
  float all = move;
  if (tip.support_count > 0) {
    const bool in_track = tip.track_m < own.track_end_m;
    press_membrane(model, state, tip, direction);
    if (holding_membrane(model, state) == kNoTissue) {
      enter_layer(model, state, tip, direction, in_track);
    }
    const float axial = dot(force_on_tissue(tip), direction);
    move = overshoot(model, tip, axial, 0, tip_limit(model, state, tip, in_track));
    all = move + renew(model, tip, direction, move, moved_m, state.head->cutting_j);
    const float part = slip_to_membrane(model, state, tip, direction, all);
    move *= part;
    all *= part;
  } else {
    leave_membrane(model, state, tip);
  }
  const Vec3 cut = turn_cut(model, state, needle, 0.5F * all);
  advance_tip(model, state, tip, cut, all);
  if (all < 0) leave_membrane(model, state, tip);
  own.cut = cut;  // half of the turn is done before the advance
  own.cut = turn_cut(model, state, needle, 0.5F * all);
  note_slip(head, tip, all);
  tip.slip_m = move * cut;
  const NeedleForces& forces = model.forces[tip.material];
  const bool cuts_aside = forces.sideways_n_per_m > 0 && tip.support_count > 0;
  if (cuts_aside && !head.rules.unit_slips) {
    (void)cut_sideways(model, state, tip, own.cut, cutting_n(forces, tip.slip_m_per_s));
  }
  if (move > 0) own.phase = Phase::kInserted;
  if (move < 0) own.phase = Phase::kRetracting;
}

void rehome_tip(const Model& model, State& state) {
  NeedleState& own = *state.needle;
  Particle& tip = *state.tip;
  const double before = spring_energy(tip);
  renew_supports(model, state, tip);
  if (!holds_track(model, tip.rest_m, tip.track_m)) {
    tip.support_count = 0;
    forget(tip);
  }
  state.head->cutting_j += before - spring_energy(tip);
  if (tip.support_count > 0) own.tissue_track_m = tip.track_m;
  own.track_end_m = max_of(own.track_end_m, tip.track_m);
}

void cut_after_step(const Model& model, State& state) {
  NeedleState& own = *state.needle;
  Particle& tip = *state.tip;
  if (own.phase == Phase::kFree || own.phase == Phase::kContact || tip.support_count == 0) return;
  if (tip.material != own.spring_layer) return;
  const float limit = kEndTolerance * tip_limit(model, state, tip, tip.track_m < own.track_end_m);
  const float before_n = dot(tip.force_n, own.cut);
  const float back_m = max_of(-dot(tip.slip_m, own.cut), 0);
  const float high_n = clamp(before_n - back_m * tip.stiffness_n_per_m, 0, limit);
  float move = overshoot(model, tip, before_n, -limit, high_n);
  if (move > 0 && has_membranes(model)) {
    const Gradient g = gradient_around(model, state, tip);
    move *= free_part(model, state, pull_back_step(g, move * own.cut)).clear;
  }
  if (move == 0) return;
  advance_tip(model, state, tip, own.cut, move);
  tip.slip_m = tip.slip_m + move * own.cut;
  tip.force_n = force_on_tissue(tip);
  const float work = 0.5F * move * (before_n + dot(tip.force_n, own.cut));
  state.head->cutting_j += static_cast<double>(work);
}

}  // namespace stylet
