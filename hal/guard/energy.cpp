// SPDX-License-Identifier: Apache-2.0
#include "hal/guard/energy.h"

#include <algorithm>

#include "hal/base/vector.h"
#include "hal/base/wide.h"
#include "hal/guard/arithmetic.h"

namespace stylet::hal::guarding {

namespace {

// The force, or torque, that acted during the motion that the device reports now.
Vec3 acted_then(const GuardConfig& config,
                const std::array<Vec3, kMaxDelayTicks + 2>& newest_first) {
  const double ticks = std::clamp(widened(config.device.delay_s) / widened(config.period_s), 0.0,
                                  static_cast<double>(kMaxDelayTicks));
  const auto whole = static_cast<std::size_t>(ticks);
  const double part = ticks - static_cast<double>(whole);
  return scaled(newest_first[whole], 1 - part) + scaled(newest_first[whole + 1], part);
}

// The small turn from one rotation to the next, as a vector along its axis, rad.
Vec3 turn_between(Quat from, Quat to) {
  const double w = widened(to.w) * widened(from.w) + widened(to.x) * widened(from.x) +
                   widened(to.y) * widened(from.y) + widened(to.z) * widened(from.z);
  const double twice = w < 0 ? -2 : 2;  // both signs are the same rotation
  const auto part = [&](float a, float b, float c, float d, float e, float f, float g, float h) {
    return static_cast<float>(twice * (widened(a) * widened(b) - widened(c) * widened(d) -
                                       widened(e) * widened(f) + widened(g) * widened(h)));
  };
  return {part(to.x, from.w, to.w, from.x, to.y, from.z, to.z, from.y),
          part(to.y, from.w, to.w, from.y, to.z, from.x, to.x, from.z),
          part(to.z, from.w, to.w, from.z, to.x, from.y, to.y, from.x)};
}

}  // namespace

void lose_sight(const GuardConfig& config, EnergyObserver& energy) {
  if (energy.have_position != 0) energy.energy_j = widened(config.stored_energy_j);
  energy.have_position = energy.have_rotation = 0;
  energy.path_m_per_s = 0;
}

void observe_path(const GuardConfig& config, GuardState& state, Vec3 position_m) {
  if (state.energy.have_position == 0) return;
  const double time_s = since_last_s(config, state);
  const double speed = wide_length(position_m - state.pose_m) / time_s;
  double& path = state.energy.path_m_per_s;
  path += (speed - path) * gain_of(time_s, widened(kPathS));
}

void observe_motion(const GuardConfig& config, GuardState& state, Vec3 position_m) {
  EnergyObserver& energy = state.energy;
  if (energy.have_position == 0) energy.position_m = position_m;
  energy.have_position = 1;
  const Vec3 way = position_m - energy.position_m;
  const double size = wide_length(way), slack = widened(config.device.resolution_m);
  const Vec3 before = energy.position_m;
  if (size > slack) energy.position_m = before + scaled(way, 1 - slack / size);
  const Vec3 moved = energy.position_m - before;
  const double time_s = since_last_s(config, state);
  const Vec3 slower = scaled(moved, 1 / time_s) - energy.velocity_m_per_s;
  energy.velocity_m_per_s =
      energy.velocity_m_per_s + scaled(slower, gain_of(time_s, widened(kSpeedS)));
  const double damped = widened(config.device.damping_n_s_per_m) *
                        std::max(wide_dot(energy.velocity_m_per_s, moved), 0.0);
  energy.energy_j += damped + widened(config.device.friction_n) * wide_length(moved) -
                     wide_dot(acted_then(config, energy.force_n), moved);
  energy.energy_j = std::min(energy.energy_j, widened(config.stored_energy_j));
  energy.least_j = std::min(energy.least_j, energy.energy_j);
}

void observe_turn(const GuardConfig& config, EnergyObserver& energy, Quat rotation) {
  if (energy.have_rotation != 0) {
    const Vec3 turned = turn_between(energy.rotation, rotation);
    energy.energy_j -= wide_dot(acted_then(config, energy.torque_nm), turned);
  }
  energy.have_rotation = 1;
  energy.rotation = rotation;
}

void remember(std::array<Vec3, kMaxDelayTicks + 2>& newest_first, Vec3 value) {
  std::copy_backward(newest_first.begin(), newest_first.end() - 1, newest_first.end());
  newest_first[0] = value;
}

Vec3 damped(const GuardConfig& config, GuardState& state, Vec3 force_n) {
  const EnergyObserver& energy = state.energy;
  const double square = wide_dot(energy.velocity_m_per_s, energy.velocity_m_per_s);
  const double most = widened(config.passivity_damping_n_s_per_m);
  if (!(most > 0 && energy.energy_j < 0 && square > 0)) return force_n;
  ++state.counters.force_damped;
  const double damping = std::min(most, -energy.energy_j / (step_s(config, state) * square));
  return force_n - scaled(energy.velocity_m_per_s, damping);
}

}  // namespace stylet::hal::guarding
