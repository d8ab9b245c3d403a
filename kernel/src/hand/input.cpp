// SPDX-License-Identifier: Apache-2.0
#include "hand/input.h"

#include "base/math.h"

namespace stylet {
namespace {

bool pose_finite(const Pose& pose) {
  const Quat& q = pose.rotation;
  return is_finite(pose.position_m) && is_finite(q.w) && is_finite(q.x) && is_finite(q.y) &&
         is_finite(q.z);
}

// Unit length, on the same side as `reference`; false if it has no direction.
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

bool clamp_distance(const Model& model, Vec3& position_m) {
  const Vec3 from = position_m - model.organ().origin_m;
  const Vec3 near = {clamp(from.x, -kMaxHandleDistanceM, kMaxHandleDistanceM),
                     clamp(from.y, -kMaxHandleDistanceM, kMaxHandleDistanceM),
                     clamp(from.z, -kMaxHandleDistanceM, kMaxHandleDistanceM)};
  position_m = model.organ().origin_m + near;
  return near.x != from.x || near.y != from.y || near.z != from.z;
}

// Follows the wanted pose, at most as fast as the fastest hand.
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

}  // namespace

std::uint32_t accept_input(const Model& model, State& state, const Input& input) {
  NeedleState& own = *state.needle;
  if (input.valid == 0) {
    ++state.head->input_missing;
    return kFlagInputMissing;
  }
  Pose wanted = input.handle;
  if (!pose_finite(wanted) || !normalize(wanted.rotation, own.handle.rotation)) {
    ++state.head->input_not_finite;
    return kFlagInputNotFinite;
  }
  bool clamped = clamp_distance(model, wanted.position_m);
  if (own.handle_known != 0) {
    clamped |= clamp_motion(own.handle, model.head->config.period_s, wanted);
  }
  own.handle = wanted;
  own.handle_known = 1;
  if (!clamped) return 0;
  ++state.head->input_clamped;
  return kFlagInputClamped;
}

Vec3 turn_between(const Quat& a, const Quat& b) {
  const Vec3 va = {a.x, a.y, a.z}, vb = {b.x, b.y, b.z};
  return 2.0F * (a.w * vb - b.w * va - cross(vb, va));
}

}  // namespace stylet
