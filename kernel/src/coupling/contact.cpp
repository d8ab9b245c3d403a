// SPDX-License-Identifier: Apache-2.0
#include "coupling/contact.h"

#include "coupling/contact_spring.h"
#include "coupling/cut.h"
#include "coupling/deformation.h"
#include "coupling/insertion.h"
#include "coupling/spring.h"
#include "coupling/support.h"
#include "coupling/surface.h"
#include "coupling/track.h"
#include "state/events.h"

namespace stylet {
namespace {

// A tip in contact must be this far clear of its goal to leave it: so a tip that only slides
// sideways does not leave and return with every rounding.
constexpr float kReleaseSkinM = 2e-5F;
// A bend in contact uses the tangent from before it as spring. In it, the tip of an elastic needle
// takes tissue aside by at most kChordM plus this part of its present offset. The tangent's force
// is then 0.8 % below that of a quadratic law. A choice; nothing is sensitive to it.
constexpr float kAsideFraction = 0.1F;

// The tip of a needle that lies this deep under a place of the surface. It holds the tissue it lies
// in, without force. If the deformation at the surface says nothing about the tissue there, it
// holds the surface.
Particle tip_under(const Model& model, State& state, const Needle& needle, Vec3 rest_m,
                   Vec3 place_m, float buried_m, Role role) {
  Particle tip = new_particle(model, state, needle, rest_m, place_m, 0, 0, role);
  if (tip.support_count > 0 && buried_m > 0) {
    const Vec3 step = buried_m * needle.tip_direction;
    const Vec3 image = pull_back_step(gradient_around(model, state, tip), step);
    const Particle under =
        new_particle(model, state, needle, rest_m + image, place_m + step, 0, 0, role);
    if (under.support_count > 0) {
      tip = under;
    } else {
      shift_goals(tip, step);
    }
    if (role == Role::kTip) tip.track_m = norm(image);
  }
  tip.position_m = needle.tip_m;
  return tip;
}

// A tip in contact, held without force by the tissue it now lies in.
Particle tip_here(const Model& model, State& state, const Needle& needle) {
  const Particle& before = *state.tip;
  const Vec3 step = pull_back_step(gradient_around(model, state, before), residual(before));
  return new_particle(model, state, needle, before.rest_m + step, needle.tip_m, 0, 0,
                      Role::kSurface);
}

// For a contact from which the tip is drawn back. If tissue has come over the tip from elsewhere,
// or the tip has come in from the side, it is not clear yet: it now holds what it lies in, without
// force. The surface may be anywhere behind it.
bool hold_on(const Model& model, State& state, const Needle& needle, std::uint32_t& flags_out) {
  Vec3 rest = {}, place = {};
  const Contact contact = find_contact(model, state, needle.tip_m, needle.tip_direction,
                                       model.needle_config().length_m, {}, rest, place, flags_out);
  if (contact != Contact::kFound) return false;
  Particle tip = tip_here(model, state, needle);
  if (tip.support_count == 0) {
    const float buried = dot(needle.tip_m - place, needle.tip_direction);
    tip = tip_under(model, state, needle, rest, place, buried, Role::kSurface);
  }
  if (tip.support_count == 0) return false;
  *state.tip = tip;
  state.needle->layer = tip.material;
  return true;
}

void end_contact(State& state) {
  add_event(state, EventKind::kRelease, 0);
  state.needle->phase = Phase::kFree;
  state.needle->tip_alive = 0;
}

}  // namespace

void begin_contact(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                   Vec3 rest_m, Vec3 place_m, float advance_m) {
  NeedleState& own = *state.needle;
  const float depth = dot(needle.tip_m - place_m, needle.tip_direction);
  const float buried = depth - max_of(advance_m, 0);
  if (own.leaving != 0 && buried <= mouth_m(model)) return;
  own.leaving = 0;
  own.moved_m = model.head->counts.needles > 1 ? place_m - rest_m : Vec3{};
  const Particle entry =
      new_particle(model, state, needle, rest_m, place_m, 0, buried, Role::kShaft);
  const std::uint32_t track =
      buried > mouth_m(model) ? track_of(model, state, needle, entry) : kNoTrack;
  const Role role = track != kNoTrack ? Role::kTip : Role::kSurface;
  const Particle tip = tip_under(model, state, needle, rest_m, place_m, buried, role);
  if (tip.support_count == 0) return;
  *state.tip = tip;
  own.tip_alive = 1;
  if (track != kNoTrack) {
    take_in(model, state, scratch, needle, track, entry);
    return;
  }
  // update_contact presses it in as far as it then is: see contact_spring.
  state.tip->position_m = needle.tip_m - residual(tip);
  own.phase = Phase::kContact;
  own.layer = tip.material;
  add_event(state, EventKind::kContact, 0);
}

void update_contact(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                    Vec3 step_m, std::uint32_t& flags_out) {
  const ModelHead& head = *model.head;
  Particle& tip = *state.tip;
  const float felt = dot(tip.force_n, needle.tip_direction);
  const float ahead_m = dot(residual(tip), needle.tip_direction);
  if (ahead_m < -kReleaseSkinM) {
    if (!hold_on(model, state, needle, flags_out)) end_contact(state);
    return;
  }
  if (head.rules.contact_law) relax_contact(model, state, needle.tip_direction, step_m);
  const std::uint32_t track = track_of(model, state, needle, tip);
  const bool node_inside = ahead_m > model.needle_config().unit_m;
  const bool through = head.rules.unit_punctures
                           ? node_inside
                           : felt >= puncture_force(model, state, tip.material,
                                                    model.forces[tip.material].puncture_n);
  if (through || track != kNoTrack) begin_insertion(model, state, scratch, needle, track, felt);
}

void throw_aside(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                 Vec3 moved_m) {
  Particle& tip = *state.tip;
  if (state.needle->phase != Phase::kContact) return;
  if (!model.head->rules.contact_law) return;
  const Vec3 aside = moved_m - dot(moved_m, needle.tip_direction) * needle.tip_direction;
  const float before_m = max_of(norm(residual(tip) - moved_m), needle.off_m);
  const float held_m = kChordM + kAsideFraction * before_m;
  if (!(norm(residual(tip)) > before_m + held_m && dot(aside, aside) > held_m * held_m)) return;
  tip = tip_here(model, state, needle);
  stretch_of(state, scratch, kMaxConstraintParticles) = {};
  if (tip.support_count == 0) end_contact(state);
}

void stretch_tip(const State& state, Scratch& scratch, Vec3 moved_m) {
  Vec3& stretch = stretch_of(state, scratch, kMaxConstraintParticles);
  stretch = stretch + moved_m;
}

}  // namespace stylet
