// SPDX-License-Identifier: Apache-2.0
// One tick: the only place that knows the order of its parts.
//
//   check input -> place needle -> contact -> coupling (cut, slip, add, remove)
//     -> bend once more where the tip is in contact -> tissue substeps (the fits inside include the
//     CPs) -> slip once more -> settle needle -> forces -> check output

#include "base/math.h"
#include "coupling/coupling.h"
#include "coupling/roll.h"
#include "coupling/surface.h"
#include "lattice/lattice.h"

namespace stylet {
namespace {

bool pose_finite(const Pose& pose) {
  const Quat& q = pose.rotation;
  return is_finite(pose.position_m) && is_finite(q.w) && is_finite(q.x) && is_finite(q.y) &&
         is_finite(q.z);
}

// Unit length, on the same side as `reference`; false when there is no direction in it.
bool normalize(Quat& q, const Quat& reference) {
  const float largest = max_of(max_of(max_of(q.w, -q.w), max_of(q.x, -q.x)),
                               max_of(max_of(q.y, -q.y), max_of(q.z, -q.z)));
  if (!(largest > 1e-6F) || !(largest < 1e6F)) return false;
  const float side = q.w * reference.w + q.x * reference.x + q.y * reference.y + q.z * reference.z;
  const float size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  const float scale = side < 0 ? -1 / size : 1 / size;
  q = {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
  return true;
}

bool clamp_distance(const View& view, Vec3& position_m) {
  const Vec3 from = position_m - view.organ.origin_m;
  const Vec3 near = {clamp(from.x, -kMaxHandleDistanceM, kMaxHandleDistanceM),
                     clamp(from.y, -kMaxHandleDistanceM, kMaxHandleDistanceM),
                     clamp(from.z, -kMaxHandleDistanceM, kMaxHandleDistanceM)};
  position_m = view.organ.origin_m + near;
  return near.x != from.x || near.y != from.y || near.z != from.z;
}

// Follows the wanted pose at most at the hand's highest speed.
bool clamp_motion(const Pose& last, float period_s, Pose& wanted) {
  bool clamped = false;
  const Vec3 step = wanted.position_m - last.position_m;
  const float length = norm(step);
  const float most = kMaxHandleSpeedMPerS * period_s;
  if (length > most) {
    wanted.position_m = last.position_m + (most / length) * step;
    clamped = true;
  }
  // Chord between unit quaternions: half the angle, for the small angles of one tick.
  const Quat a = last.rotation, b = wanted.rotation;
  const Quat turn = {b.w - a.w, b.x - a.x, b.y - a.y, b.z - a.z};
  const float chord =
      std::sqrt(turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
  const float widest = kMaxHandleSpinRadPerS * period_s * 0.5F;
  if (chord > widest) {
    const float s = widest / chord;
    wanted.rotation = {a.w + s * turn.w, a.x + s * turn.x, a.y + s * turn.y, a.z + s * turn.z};
    (void)normalize(wanted.rotation, a);
    clamped = true;
  }
  return clamped;
}

// Takes the sample into the state, or keeps the last pose; never an error.
std::uint32_t accept_input(const View& view, const Input& input) {
  StateHead& state = *view.state.head;
  NeedleState& own = *view.state.needle;
  if (input.valid == 0) {
    ++state.input_missing;
    return kFlagInputMissing;
  }
  Pose wanted = input.handle;
  if (!pose_finite(wanted) || !normalize(wanted.rotation, own.handle.rotation)) {
    ++state.input_not_finite;
    return kFlagInputNotFinite;
  }
  bool clamped = clamp_distance(view, wanted.position_m);
  if (own.handle_known != 0) {
    clamped |= clamp_motion(own.handle, view.model.head->config.period_s, wanted);
  }
  own.handle = wanted;
  own.handle_known = 1;
  if (!clamped) return 0;
  ++state.input_clamped;
  return kFlagInputClamped;
}

// The turn from one rotation to another, a vector along its axis.
Vec3 turn_between(const Quat& a, const Quat& b) {
  const Vec3 va = {a.x, a.y, a.z}, vb = {b.x, b.y, b.z};
  return 2.0F * (a.w * vb - b.w * va - cross(vb, va));
}

// A tip that has just left its track lies in the mouth of the hole: it must come clear of the
// surface, or lie deeper than the mouth, before it can touch it again. What a tip that is swept
// aside comes forward is counted along the mean of its directions before and after the `turn`:
// along the last one it would press without anybody pushing. False: it is not known whether it
// touches. `has_left`: in this very tick, so that the next one still has to look around it.
bool seek_contact(const View& view, const Needle& needle, Vec3 turn, bool known_before,
                  bool has_left, std::uint32_t& flags) {
  NeedleState& own = *view.state.needle;
  if (own.phase != Phase::kFree) return true;
  Vec3 rest = {}, place = {};
  const Vec3 step = needle.tip_m - view.state.tip->position_m;
  // Tissue that it had drawn along springs back over a tip that has left it, at once and far.
  const float reach_m = own.leaving != 0 ? view.needle_config().length_m : contact_reach_m(view);
  const Contact contact = find_contact(view, needle.tip_m, needle.tip_direction, reach_m,
                                       known_before ? step : Vec3{}, rest, place, flags);
  const Vec3 forward = needle.tip_direction - 0.5F * cross(turn, needle.tip_direction);
  float came = known_before ? dot(step, forward) : 0;
  if (contact == Contact::kSideways) came = norm(step);  // it has come by no other way
  const bool found = contact == Contact::kFound || contact == Contact::kSideways;
  if (found) begin_contact(view, needle, rest, place, came);
  if (contact == Contact::kNone && !has_left) own.leaving = 0;
  return contact != Contact::kUnknown;
}

// A tip that may be in the tissue goes no farther than it was: a hand feels that by its coupling.
std::uint32_t hold_needle(const View& view, const Pose& before, Needle& shape_out) {
  ++view.state.head->input_clamped;
  view.state.needle->handle = before;
  return kFlagInputClamped | place_needle(view, shape_out);
}

// Work of the hand since the last tick: mean of the forces at both ends times the motion.
void book_work(const View& view, const Pose& before, const Output& out) {
  StateHead& state = *view.state.head;
  NeedleState& own = *view.state.needle;
  const Pose& now = own.handle;
  const Vec3 step = now.position_m - before.position_m;
  const Vec3 turn = turn_between(before.rotation, now.rotation);
  const float work = -0.5F * (dot(out.force_n + own.last_force_n, step) +
                              dot(out.torque_nm + own.last_torque_nm, turn));
  state.work_by_hand_j += static_cast<double>(work);
  own.last_force_n = out.force_n;
  own.last_torque_nm = out.torque_nm;
}

bool output_finite(const Output& out) {
  return is_finite(out.force_n) && is_finite(out.torque_nm);
}

void describe(const View& view, const Needle& needle, Output& out) {
  const StateHead& state = *view.state.head;
  const NeedleState& own = *view.state.needle;
  out.tick = state.tick;
  out.tip_m = own.handle_known != 0 ? needle.tip_m + attachment_shift(view) : Vec3{};
  out.phase = own.phase;
  out.layer = own.layer;
  out.depth_m = own.tip_alive != 0 ? max_of(own.tissue_track_m, 0) : 0;
  out.constraint_particles = own.shaft_count + own.tip_alive;
  out.events = state.event_count;
}

// A needle of a tick, at its pose.
struct Moved {
  Pose before;
  bool known_before;
  std::uint32_t flags;
  Needle shape;
};

void move_needle(const View& view, const Input& input, Moved& out) {
  NeedleState& own = *view.state.needle;
  out.before = own.handle;
  out.known_before = own.handle_known != 0;
  out.flags = accept_input(view, input);
  if (own.handle_known == 0) return;
  Vec3 turn = {};
  if (out.known_before) {
    turn = turn_between(out.before.rotation, own.handle.rotation);
    roll_tip(view, dot(turn, column(rotation_matrix(own.handle.rotation), 2)));
  }
  out.flags |= place_needle(view, out.shape);
  const bool was_free = own.phase == Phase::kFree;
  const bool known = seek_contact(view, out.shape, turn, out.known_before, false, out.flags);
  if (!known && out.known_before) out.flags |= hold_needle(view, out.before, out.shape);
  out.flags |= couple_needle(view, out.shape);
  out.flags |= meet_tissue(view, out.shape);
  // One that has left its hole may have left it under other tissue, pressed or folded over it.
  if (!was_free) (void)seek_contact(view, out.shape, turn, out.known_before, true, out.flags);
}

void latch_fault(StateHead& state) {
  if (state.latched_fault != 0) return;
  state.latched_fault = 1;
  ++state.fault_count;
}

void report_needle(const View& view, Moved& moved, Output& out) {
  out.flags |= moved.flags;
  if (view.state.needle->handle_known != 0) {
    let_slip(view, moved.shape);
    out.flags |= settle_needle(view, moved.shape);
    sum_forces(view, moved.shape, out);
  }
  describe(view, moved.shape, out);
  if (moved.known_before) book_work(view, moved.before, out);
  if (!output_finite(out)) latch_fault(*view.state.head);
}

Output faulted(const View& view) {
  Output out = {};
  out.tick = view.state.head->tick;
  out.flags = kFlagFault;
  out.layer = kNoLayer;
  out.events = view.state.head->event_count;
  return out;
}

}  // namespace

void tick(Kernel& kernel, std::span<const Input> inputs, std::span<Output> outputs) {
  const View view = view_of(kernel);
  StateHead& state = *view.state.head;
  const std::uint32_t count = view.model.head->counts.needles;
  ++state.tick;
  Moved moved[kMaxNeedles] = {};
  Output out[kMaxNeedles] = {};
  if (state.latched_fault == 0) {
    for (std::uint32_t i = 0; i < count; ++i) {
      move_needle(needle_view(view, i), i < inputs.size() ? inputs[i] : Input{}, moved[i]);
    }
    const std::uint32_t flags = gather_coupled(view);
    const std::uint32_t substeps = view.model.head->config.substeps;
    for (std::uint32_t s = 0; s < substeps; ++s) {
      view.scratch.head->substeps_to_come = substeps - 1 - s;
      kernel.step(kernel);
    }
    // Tissue dragged to a hundredfold of its length may leave the numbers there are, and a needle
    // that has left it would not tell.
    if (!is_finite(state.max_displacement_m)) latch_fault(state);
    measure_forces(view);
    for (std::uint32_t i = 0; i < count; ++i) {
      out[i].flags = flags;
      report_needle(needle_view(view, i), moved[i], out[i]);
    }
  }
  // One needle's fault stops them all: they share the tissue.
  for (std::uint32_t i = 0; i < count && i < outputs.size(); ++i) {
    outputs[i] = state.latched_fault == 0 ? out[i] : faulted(view);
  }
}

Output tick(Kernel& kernel, const Input& input) {
  Output out = {};
  tick(kernel, {&input, 1}, {&out, 1});
  return out;
}

}  // namespace stylet
