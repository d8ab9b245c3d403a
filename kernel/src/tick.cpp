// SPDX-License-Identifier: Apache-2.0
// One tick: the automaton of the paper, and the only place that knows the order of its steps
// (PHYSICS 1.3). Numbers of the paper are sections and their steps.
//
//                                                                      paper       PHYSICS
//   for each needle
//     1  input     the hand's pose, checked and clamped                              5, 6.6
//     2  place     the needle there, bent by the last tick's forces      IV.C, 1     6, 13
//     3  contact   free: does the tip meet the surface?                  IV.B, 1     7
//     4  carry     constraint particles (CPs) creep, go with the needle  IV.C, 2     10.5, 12.4
//     5  puncture  contact: it holds, ends, or breaks the surface        IV.B, 3     8, 9.1
//     6  cut       the tip moves on to other tissue                      IV.C, 3     9.3
//     7  slip      the shaft's CPs slip back to the limit of friction    IV.C, 3; V  12.1
//     8  add, remove  CPs behind a tip that goes on or comes back        IV.C, 4     10.4
//     9  bend      a tip in contact once more, by its pressing force;    IV.B, 4     6.4
//                  a tip that has just left its hole looks for the surface again     7
//   for all together
//     10 tissue    parts that slide press on each other; shape           IV.B, 2     2.8, 10.2,
//                  matching, CPs included: substep by substep                        2, 3
//   for each needle
//     11 slip      CPs that the tissue dragged along slip once more                  12.6
//     12 bend      by the new forces                                     IV.B, 4     6.4
//     13 force     on the hand, by cause                                 V           14.1
//     14 flow      of fluid through the needle, unless its hub is closed             9.9
//
// Phases: free -> contact (3) -> inserted (5) <-> retracting (6) -> free (8). A needle that finds
// its old hole enters it from contact (5), or from free if tissue has come over the needle (3).
//
// Promises: bounded by limits.h, no allocation, fixed order. Units SI, frame of the attachments.

#include "base/math.h"
#include "coupling/bend.h"
#include "coupling/contact.h"
#include "coupling/cut.h"
#include "coupling/flow.h"
#include "coupling/friction.h"
#include "coupling/insertion.h"
#include "coupling/layers.h"
#include "coupling/match.h"
#include "coupling/relaxation.h"
#include "coupling/roll.h"
#include "coupling/shaft.h"
#include "coupling/spring.h"
#include "coupling/surface.h"
#include "hand/force.h"
#include "hand/input.h"
#include "coupling/slides.h"
#include "state/attachment.h"
#include "state/invariants.h"

namespace stylet {
namespace {

// A needle in a tick, at its pose.
struct Moved {
  Pose before;
  bool known_before;
  std::uint32_t flags;
  Needle shape;
};

// ---- step 3: contact

struct Search {
  Vec3 turn;          // of the handle, in this tick
  bool known_before;  // whether the pose before is known
  bool has_left;      // its hole, in this very tick: the next tick must look around it again
};
// A tip that has just left its track lies in the mouth of the hole: it must be clear of the
// surface, or deeper than the mouth, before it can touch it again. For a tip that is swept aside,
// its way forward is measured along the mean of its directions before and after the `turn`: along
// the last direction it would press without anybody pushing. False: a bound of the search was
// reached, so nobody knows whether the tip touches.
bool seek_contact(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                  const Search& search, std::uint32_t& flags) {
  NeedleState& own = *state.needle;
  if (own.phase != Phase::kFree) return true;
  Vec3 rest = {}, place = {};
  const Vec3 step = needle.tip_m - state.tip->position_m;
  // Tissue that a needle had drawn along springs back over a tip that has left it, fast and far. A
  // needle that was nowhere before may lie in tissue at any depth.
  const bool anywhere = own.leaving != 0 || !search.known_before;
  const float reach_m = anywhere ? model.needle_config().length_m : contact_reach_m(model);
  const Contact contact = find_contact(model, state, needle.tip_m, needle.tip_direction, reach_m,
                                       search.known_before ? step : Vec3{}, rest, place, flags);
  const Vec3 forward = needle.tip_direction - 0.5F * cross(search.turn, needle.tip_direction);
  float advance_m = search.known_before ? dot(step, forward) : 0;
  if (contact == Contact::kSideways) advance_m = norm(step);  // the tip has come only this way
  const bool found = contact == Contact::kFound || contact == Contact::kSideways;
  if (found) begin_contact(model, state, scratch, needle, rest, place, advance_m);
  if (contact == Contact::kNone && !search.has_left) own.leaving = 0;
  return contact != Contact::kUnknown;
}

// A tip that may be in the tissue stays where it was: the hand feels that through its coupling.
std::uint32_t hold_needle(const Model& model, State& state, Scratch& scratch, const Pose& before,
                          Needle& shape_out) {
  ++state.head->input_clamped;
  state.needle->handle = before;
  return kFlagInputClamped | place_needle(model, state, scratch, shape_out);
}

// ---- steps 4 to 8: constraint particles

// Moves the tip to where the needle has it. How fast it presses decides how easily a surface
// breaks. Returns how far it has come along the needle.
float move_tip(const Model& model, State& state, const Needle& needle) {
  NeedleState& own = *state.needle;
  const float moved_m = dot(needle.tip_m - state.tip->position_m, needle.tip_direction);
  state.tip->position_m = needle.tip_m;
  const float speed = moved_m / model.head->config.period_s;
  own.press_m_per_s = settle(speed + model.head->velocity_keep * (own.press_m_per_s - speed));
  return moved_m;
}

// Removes the shaft's CPs behind a tip that comes back; with the last one the insertion ends.
// Adds CPs behind a tip that goes on. `from_m` (rest frame), `from_track_m`: where the tip was.
std::uint32_t add_and_remove(const Model& model, State& state, Scratch& scratch,
                             const Needle& needle, Vec3 from_m, float from_track_m) {
  NeedleState& own = *state.needle;
  while (own.shaft_count > 0 && is_behind(model, state, state.shaft[own.shaft_count - 1])) {
    --own.shaft_count;
  }
  if (own.shaft_count == 0) {
    end_insertion(state);
    return 0;
  }
  leave_layers(state);
  tell_layer_late(state);
  const std::uint32_t flags = drop_shaft(model, state, scratch, needle);
  gather_friction(model, state, from_m, from_track_m);
  return flags;
}

std::uint32_t move_particles(const Model& model, State& state, Scratch& scratch,
                             const Needle& needle) {
  NeedleState& own = *state.needle;
  Particle& tip = *state.tip;
  if (own.tip_alive == 0) {
    tip.position_m = needle.tip_m;  // seek_contact measures from here
    return 0;
  }
  if (own.phase != Phase::kContact) relax_and_follow(model, state, needle);  // 4: carry
  const Vec3 step = needle.tip_m - tip.position_m;
  const float moved_m = move_tip(model, state, needle);
  std::uint32_t flags = 0;
  if (own.phase == Phase::kContact) {
    update_contact(model, state, scratch, needle, step, flags);  // 5: puncture
  }
  if (own.phase == Phase::kFree || own.phase == Phase::kContact) return flags;
  const Vec3 from_m = tip.rest_m;
  const float from_track_m = tip.track_m;
  cut_tip(model, state, needle, moved_m);  // 6: cut
  rehome_tip(model, state);
  slip_shaft(model, state, scratch, needle, moved_m);                                  // 7: slip
  return flags | add_and_remove(model, state, scratch, needle, from_m, from_track_m);  // 8
}

// The tissue gets the pull of the needle's motion in this tick on the tip's spring substep by
// substep. In contact, too: if the needle moved before the first substep, the tissue would be
// pushed harder than the hand feels, because the hand's force is that of the last substep.
void stretch_tip_spring(const State& state, Scratch& scratch) {
  const Particle& tip = *state.tip;
  Vec3& stretch = stretch_of(state, scratch, kMaxConstraintParticles);
  stretch = {};
  if (state.needle->tip_alive == 0) return;
  stretch = (1 / tip.stiffness_n_per_m) * (force_on_tissue(tip) - tip.force_n);
}

// Steps 1 to 9.
void move_needle(const Model& model, State& state, Scratch& scratch, const Input& input,
                 Moved& out) {
  NeedleState& own = *state.needle;
  out.before = own.handle;
  out.known_before = own.handle_known != 0;
  out.flags = accept_input(model, state, input);  // 1: input
  out.flags |= accept_plunger(model, state, input);
  if (own.handle_known == 0) return;
  Vec3 turn = {};
  if (out.known_before) {
    turn = turn_between(out.before.rotation, own.handle.rotation);
    roll_tip(model, state, dot(turn, column(rotation_matrix(own.handle.rotation), 2)));
  }
  out.flags |= place_needle(model, state, scratch, out.shape);  // 2: place
  const bool was_free = own.phase == Phase::kFree;
  const Search from_outside = {turn, out.known_before, false};
  const bool known = seek_contact(model, state, scratch, out.shape, from_outside, out.flags);  // 3
  if (!known && out.known_before) {
    out.flags |= hold_needle(model, state, scratch, out.before, out.shape);
  }
  assert_needle(model, state);
  out.flags |= move_particles(model, state, scratch, out.shape);  // 4 to 8
  assert_needle(model, state);
  stretch_tip_spring(state, scratch);
  out.flags |= meet_tissue(model, state, scratch, out.shape);  // 9: bend
  // A needle may have left its hole under other tissue that is pressed or folded over it.
  if (!was_free) {
    const Search after_leaving = {turn, out.known_before, true};
    (void)seek_contact(model, state, scratch, out.shape, after_leaving, out.flags);
  }
  assert_needle(model, state);
}

// ---- steps 11 to 13: what the hand feels

// In the paper a CP moves by whole needle units, and only before the tissue's step.
void slip_again(const Model& model, State& state, const Needle& needle) {
  if (!model.head->rules.slips_again) return;
  cut_after_step(model, state);
  for (std::uint32_t i = 0; i < state.needle->shaft_count; ++i) {
    slip_after_step(model, state, needle, state.shaft[i]);
  }
}

bool output_finite(const Output& out) {
  return is_finite(out.force_n) && is_finite(out.torque_nm);
}

void describe(const Model& model, const State& state, const Needle& needle, Output& out) {
  const NeedleState& own = *state.needle;
  out.tick = state.head->tick;
  out.tip_m = own.handle_known != 0 ? needle.tip_m + attachment_shift(model, state) : Vec3{};
  out.phase = own.phase;
  out.layer = own.layer;
  out.depth_m = own.tip_alive != 0 ? max_of(own.tissue_track_m, 0) : 0;
  out.constraint_particles = own.shaft_count + own.tip_alive;
  out.events = state.head->event_count;
}

void latch_fault(StateHead& state) {
  if (state.latched_fault != 0) return;
  state.latched_fault = 1;
  ++state.fault_count;
}

void report_needle(const Model& model, State& state, Scratch& scratch, Moved& moved, Output& out) {
  out.flags |= moved.flags;
  if (state.needle->handle_known != 0) {
    slip_again(model, state, moved.shape);                           // 11: slip
    out.flags |= settle_needle(model, state, scratch, moved.shape);  // 12: bend
    sum_forces(model, state, moved.shape, out);                      // 13: force
    move_fluid(model, state, moved.shape, out);                      // 14: flow
  }
  describe(model, state, moved.shape, out);
  if (moved.known_before) book_work(state, moved.before, out);
  if (!output_finite(out)) latch_fault(*state.head);
}

Output faulted(const State& state) {
  Output out = {};
  out.tick = state.head->tick;
  out.flags = kFlagFault;
  out.layer = kNoLayer;
  out.events = state.head->event_count;
  return out;
}

}  // namespace

void tick(Kernel& kernel, std::span<const Input> inputs, std::span<Output> outputs) {
  auto [model, first, scratch] = view_of(kernel);  // `first`: the first needle's, and the tissue's
  StateHead& head = *first.head;
  const std::uint32_t count = model.head->counts.needles;
  ++head.tick;
  Moved moved[kMaxNeedles] = {};
  Output out[kMaxNeedles] = {};
  if (head.latched_fault == 0) {
    for (std::uint32_t i = 0; i < count; ++i) {
      State own = needle_state(first, i);
      const Input input = i < inputs.size() ? inputs[i] : Input{};
      move_needle(needle_model(model, i), own, scratch, input, moved[i]);
    }
    const std::uint32_t flags = gather_coupled(model, first, scratch);  // 10: tissue
    const std::uint32_t substeps = model.head->config.substeps;
    for (std::uint32_t s = 0; s < substeps; ++s) {
      scratch.head->substeps_to_come = substeps - 1 - s;
      press_slides(model, first, scratch);
      kernel.step(kernel);
    }
    // Tissue dragged to a hundredfold of its length may overflow, and a needle that has left the
    // tissue would not show it.
    if (!is_finite(head.max_displacement_m)) latch_fault(head);
    measure_forces(model, first);
    for (std::uint32_t i = 0; i < count; ++i) {
      out[i].flags = flags;
      State own = needle_state(first, i);
      report_needle(needle_model(model, i), own, scratch, moved[i], out[i]);
    }
  }
  // One needle's fault stops all needles: they share the tissue.
  for (std::uint32_t i = 0; i < count && i < outputs.size(); ++i) {
    outputs[i] = head.latched_fault == 0 ? out[i] : faulted(first);
  }
}

Output tick(Kernel& kernel, const Input& input) {
  Output out = {};
  tick(kernel, {&input, 1}, {&out, 1});
  return out;
}

}  // namespace stylet
