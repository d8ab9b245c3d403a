// SPDX-License-Identifier: Apache-2.0
// One tick: the only place that knows the order of its parts.
//
//   check input -> place needle -> contact -> coupling (cut, slip, add, remove)
//     -> tissue substeps (the fits inside include the CPs) -> forces -> check output

#include "coupling.h"
#include "lattice.h"
#include "math.h"
#include "surface.h"

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
  if (input.valid == 0) {
    ++state.input_missing;
    return kFlagInputMissing;
  }
  Pose wanted = input.handle;
  if (!pose_finite(wanted) || !normalize(wanted.rotation, state.handle.rotation)) {
    ++state.input_not_finite;
    return kFlagInputNotFinite;
  }
  bool clamped = clamp_distance(view, wanted.position_m);
  if (state.handle_known != 0) {
    clamped |= clamp_motion(state.handle, view.model.head->config.period_s, wanted);
  }
  state.handle = wanted;
  state.handle_known = 1;
  if (!clamped) return 0;
  ++state.input_clamped;
  return kFlagInputClamped;
}

Needle place_needle(const View& view) {
  const StateHead& state = *view.state.head;
  const Mat3 r = rotation_matrix(state.handle.rotation);
  const Vec3 direction = -1.0F * column(r, 2);
  return {state.handle.position_m, direction,
          state.handle.position_m + view.model.head->config.needle.length_m * direction};
}

// A tip that has just left its track lies in the mouth of the hole: it must come clear of the
// surface before it can touch it again.
void seek_contact(const View& view, const Needle& needle, std::uint32_t& flags) {
  StateHead& state = *view.state.head;
  if (state.phase != Phase::kFree || state.handle_known == 0) return;
  Vec3 rest = {}, place = {};
  const std::uint32_t before = flags;
  const bool found = find_contact(view, needle, rest, place, flags);
  if (found && state.leaving == 0) begin_contact(view, needle, rest, place);
  if (!found && flags == before) state.leaving = 0;
}

// Work of the hand since the last tick: mean of the forces at both ends times the motion.
void book_work(const View& view, const Pose& before, const Output& out) {
  StateHead& state = *view.state.head;
  const Pose& now = state.handle;
  const Vec3 step = now.position_m - before.position_m;
  const Quat a = before.rotation, b = now.rotation;
  const Vec3 va = {a.x, a.y, a.z}, vb = {b.x, b.y, b.z};
  const Vec3 turn = 2.0F * (a.w * vb - b.w * va - cross(vb, va));
  const float work = -0.5F * (dot(out.force_n + state.last_force_n, step) +
                              dot(out.torque_nm + state.last_torque_nm, turn));
  state.work_by_hand_j += static_cast<double>(work);
  state.last_force_n = out.force_n;
  state.last_torque_nm = out.torque_nm;
}

bool output_finite(const Output& out) {
  return is_finite(out.force_n) && is_finite(out.torque_nm);
}

void describe(const View& view, const Needle& needle, Output& out) {
  const StateHead& state = *view.state.head;
  out.tick = state.tick;
  out.tip_m = needle.tip_m;
  out.phase = state.phase;
  out.layer = state.layer;
  out.depth_m = state.tip_alive != 0 ? max_of(state.tissue_track_m, 0) : 0;
  out.constraint_particles = state.shaft_count + state.tip_alive;
  out.events = state.event_count;
}

}  // namespace

Output tick(Kernel& kernel, const Input& input) {
  const View view = view_of(kernel);
  StateHead& state = *view.state.head;
  Output out = {};
  ++state.tick;
  if (state.latched_fault != 0) {
    out.tick = state.tick;
    out.flags = kFlagFault;
    out.layer = kNoLayer;
    return out;
  }
  const Pose before = state.handle;
  const bool known_before = state.handle_known != 0;
  out.flags = accept_input(view, input);
  const Needle needle = place_needle(view);
  seek_contact(view, needle, out.flags);
  out.flags |= couple_needle(view, needle);
  out.flags |= gather_coupled(view);
  for (std::uint32_t s = 0; s < view.model.head->config.substeps; ++s) kernel.step(kernel);
  measure_forces(view);
  sum_forces(view, needle, out);
  describe(view, needle, out);
  if (known_before) book_work(view, before, out);
  if (!output_finite(out)) {
    state.latched_fault = 1;
    ++state.fault_count;
    out.force_n = out.torque_nm = {};
    out.cause = {};
    out.flags |= kFlagFault;
  }
  return out;
}

}  // namespace stylet
