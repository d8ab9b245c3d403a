// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/guard.h"

#include <cmath>
#include <limits>

namespace stylet::hal {
namespace {

constexpr float kMaxDistanceM = 10.0F;
constexpr double kRotationTolerance = 0.1;

bool finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool finite(const Pose& pose) {
  const Quat& q = pose.rotation;
  return finite(pose.position_m) && std::isfinite(q.w) && std::isfinite(q.x) &&
         std::isfinite(q.y) && std::isfinite(q.z);
}

// Double: the square of any finite float stays finite.
double length(Vec3 v) {
  const double x = static_cast<double>(v.x), y = static_cast<double>(v.y),
               z = static_cast<double>(v.z);
  return std::sqrt(x * x + y * y + z * z);
}

Vec3 scaled(Vec3 v, double s) {
  return {static_cast<float>(static_cast<double>(v.x) * s),
          static_cast<float>(static_cast<double>(v.y) * s),
          static_cast<float>(static_cast<double>(v.z) * s)};
}

bool plausible(const Pose& pose) {
  const Quat& q = pose.rotation;
  const double axis = length({q.x, q.y, q.z}), w = static_cast<double>(q.w);
  return length(pose.position_m) <= static_cast<double>(kMaxDistanceM) &&
         std::fabs(axis * axis + w * w - 1.0) <= kRotationTolerance;
}

// Ticks that fit into a time, at least one. Floored, so that a promise in seconds is kept; the
// small share more is for periods that are not exact in binary.
std::uint32_t whole_ticks(float time_s, float period_s) {
  const float ticks = time_s / period_s * 1.0001F;
  return ticks < 1.0F ? 1U : static_cast<std::uint32_t>(ticks);
}

// One rule a line; what is wrong with the sample is counted where it is found.
bool usable(const GuardConfig& config, GuardState& state, const Sample& sample,
            std::int64_t now_ns) {
  GuardCounters& count = state.counters;
  if (state.have_seq != 0 && sample.seq <= state.seq) {
    ++count.samples_repeated;
    return false;
  }
  if (state.have_seq != 0) count.samples_lost += sample.seq - state.seq - 1;
  state.have_seq = 1;
  state.seq = sample.seq;
  if (static_cast<double>(now_ns) - static_cast<double>(sample.t_ns) >
      static_cast<double>(config.watchdog_s) * 1e9) {
    ++count.samples_old;
    return false;
  }
  if (!finite(sample.pose)) {
    ++count.samples_not_finite;
    return false;
  }
  if (!plausible(sample.pose)) {
    ++count.samples_absurd;
    return false;
  }
  return true;
}

Vec3 limited(const GuardConfig& config, GuardState& state, Vec3 wanted) {
  const std::uint32_t ramp_ticks = whole_ticks(config.ramp_s, config.period_s);
  if (state.ramp_tick < ramp_ticks) ++state.ramp_tick;
  const double gain = static_cast<double>(state.ramp_tick) / ramp_ticks;
  const double max_force = static_cast<double>(config.max_force_n);
  Vec3 force = scaled(wanted, gain);
  if (const double size = length(force); size > max_force) {
    ++state.counters.force_limited;
    force = scaled(force, max_force / size);
  }
  const Vec3 last = state.force_n;
  const Vec3 change = {force.x - last.x, force.y - last.y, force.z - last.z};
  const double max_change =
      static_cast<double>(config.max_slew_n_per_s) * static_cast<double>(config.period_s);
  if (const double size = length(change); size > max_change) {
    ++state.counters.slew_limited;
    const Vec3 step = scaled(change, max_change / size);
    force = {last.x + step.x, last.y + step.y, last.z + step.z};
  }
  return force;
}

}  // namespace

const char* fault_name(Fault fault) {
  switch (fault) {
    case Fault::kNone:
      return "none";
    case Fault::kForceNotFinite:
      return "force not finite";
    case Fault::kStaleSamples:
      return "no usable sample";
    case Fault::kDeviceSilent:
      return "device silent";
    case Fault::kTooLate:
      return "too many missed ticks in a row";
    case Fault::kKernelFault:
      return "kernel fault";
  }
  return "unknown fault";
}

GuardState guard_start() {
  return GuardState{};
}

void guard_trip(GuardState& state, Fault fault) {
  if (state.fault != Fault::kNone) return;
  state.fault = fault;
  state.decay_tick = 0;
  state.force_at_fault_n = fault == Fault::kForceNotFinite ? Vec3{} : state.force_n;
  ++state.counters.faults;
}

bool guard_sample(const GuardConfig& config, GuardState& state, bool answered, const Sample& sample,
                  std::int64_t now_ns) {
  if (answered && usable(config, state, sample, now_ns)) {
    state.blind_ticks = 0;
    ++state.counters.samples_used;
    return true;
  }
  if (!answered) ++state.counters.samples_missing;
  if (state.blind_ticks < std::numeric_limits<std::uint32_t>::max()) ++state.blind_ticks;
  if (state.blind_ticks >= whole_ticks(config.watchdog_s, config.period_s)) {
    guard_trip(state, answered ? Fault::kStaleSamples : Fault::kDeviceSilent);
  }
  return false;
}

Vec3 guard_force(const GuardConfig& config, GuardState& state, Vec3 force_n) {
  if (!finite(force_n)) {
    ++state.counters.force_not_finite;
    guard_trip(state, Fault::kForceNotFinite);
    state.force_at_fault_n = {};
  }
  if (state.fault == Fault::kNone) {
    state.force_n = limited(config, state, force_n);
    return state.force_n;
  }
  const std::uint32_t decay_ticks = whole_ticks(kDecayS, config.period_s);
  if (state.decay_tick < decay_ticks) ++state.decay_tick;
  const double left = static_cast<double>(decay_ticks - state.decay_tick) / decay_ticks;
  state.force_n = scaled(state.force_at_fault_n, left);
  return state.force_n;
}

bool guard_rearm(GuardState& state, Fault seen) {
  const bool at_zero = state.force_n.x == 0 && state.force_n.y == 0 && state.force_n.z == 0;
  if (state.fault == Fault::kNone || state.fault != seen || !at_zero) return false;
  state.fault = Fault::kNone;
  state.blind_ticks = 0;
  state.ramp_tick = 0;
  ++state.counters.rearms;
  return true;
}

}  // namespace stylet::hal
