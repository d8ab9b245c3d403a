// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/grip.h"

#include <algorithm>
#include <cmath>

#include "hal/base/rotation.h"
#include "hal/base/vector.h"
#include "hal/loop/mapping.h"

namespace stylet::hal {
namespace {

constexpr Vec3 kInwards = {0, 0, -1};

// The vector from base to point of entry, as length and direction.
struct Lever {
  float length_m;
  Vec3 direction;
};
Lever lever_of(const GripConfig& config, Vec3 base_m) {
  const Vec3 way = {-base_m.x, -base_m.y, -config.pivot_depth_m - base_m.z};
  const float size = length(way);
  return {size, 1 / size * way};
}

// The part of a rotation that is about z; no rotation if that part is undefined.
Quat roll_of(const Quat& q) {
  const float size = std::sqrt(q.w * q.w + q.z * q.z);
  if (!(size > 1e-3F)) return {1, 0, 0, 0};
  return {q.w / size, 0, 0, q.z / size};
}

Pose placed(const GripConfig& config, Vec3 wanted_m, const Quat& rotation) {
  const Vec3 &low = config.box_low_m, &high = config.box_high_m;
  Vec3 base = {std::clamp(wanted_m.x, low.x, high.x), std::clamp(wanted_m.y, low.y, high.y),
               std::clamp(wanted_m.z, low.z, high.z)};
  if (!config.pivots) return {base, rotation};
  base.z = std::max(base.z, kHubM - config.pivot_depth_m);
  const Quat aim = needle_rotation(lever_of(config, base).direction);
  return {base, product(aim, roll_of(rotation))};
}

// Virtual work of the torque when the base moves: its direction d turns by d x (change of d), and
// the shortest rotation from the start's direction to d also turns about d itself.
Vec3 force_of_torque(const GripConfig& config, Vec3 base_m, Vec3 torque_nm) {
  const Lever lever = lever_of(config, base_m);
  const Vec3 d = lever.direction;
  const float twist_nm = dot(torque_nm, d) / (1 + dot(d, kInwards));
  const Vec3 swing = cross(d, torque_nm);
  const Vec3 spin = twist_nm * cross(kInwards, d);
  return 1 / lever.length_m * (swing + spin);
}

bool is_pressed(std::int32_t button, const Sample& sample) {
  return button != kNoButton && ((sample.buttons >> static_cast<std::uint32_t>(button)) & 1U) != 0;
}

}  // namespace

float plunger_force(const GripConfig& config, const Sample& sample) {
  return sample.plunger_n + (is_pressed(config.plunger_button, sample) ? config.plunger_n : 0);
}

Pose grip_pose(const GripConfig& config, GripState& state, const Sample& sample) {
  if (!config.enabled) return sample.pose;
  const bool pressed = is_pressed(config.clutch_button, sample) || state.waits;
  const bool takes_up = !pressed && (state.held || !state.started);
  state.held = pressed;
  if (pressed) return state.needle;
  const Vec3 place = config.motion_scale * rotate(config.turn, sample.pose.position_m);
  const Quat turned = product(product(config.turn, sample.pose.rotation), inverse(config.turn));
  if (takes_up) {
    state.started = true;
    state.offset_m = state.needle.position_m - place;
    state.offset_rotation = product(state.rotation, inverse(turned));
  }
  state.rotation = product(state.offset_rotation, turned);
  state.needle = placed(config, place + state.offset_m, state.rotation);
  return state.needle;
}

void grip_take_up(GripState& state) {
  state.started = false;
}

Wrench grip_wrench(const GripConfig& config, GripState& state, const Wrench& needle) {
  if (!config.enabled) return needle;
  const float step = state.held ? -config.period_s / kLetGoS : config.period_s / kTakeUpS;
  state.gain = std::clamp(state.gain + step, 0.0F, 1.0F);
  Wrench felt = needle;
  if (config.pivots) {
    felt.force_n =
        felt.force_n + force_of_torque(config, state.needle.position_m, needle.torque_nm);
    felt.torque_nm = {};
  }
  const float force_scale = state.gain * config.force_scale;
  const Quat back = inverse(config.turn);
  return {force_scale * rotate(back, felt.force_n),
          force_scale / config.motion_scale * rotate(back, felt.torque_nm)};
}

float grip_stiffness(const GripConfig& config, const GripState& state) {
  return config.enabled ? state.gain * config.force_scale * config.motion_scale : 1.0F;
}

}  // namespace stylet::hal
