// SPDX-License-Identifier: Apache-2.0
// Which samples of a device may be used, and what is a fault of the device or of the loop's time.
#include <algorithm>
#include <cmath>

#include "hal/base/vector.h"
#include "hal/base/wide.h"
#include "hal/guard/arithmetic.h"
#include "hal/guard/energy.h"
#include "hal/guard/guard.h"

namespace stylet::hal {
namespace {

using namespace guarding;

constexpr std::int64_t kBlindForEverNs = 1'000'000'000'000;

bool is_finite(const Pose& pose) {
  const Quat& q = pose.rotation;
  return finite(pose.position_m) && std::isfinite(q.w) && std::isfinite(q.x) &&
         std::isfinite(q.y) && std::isfinite(q.z);
}

bool plausible(const Pose& pose) {
  const Quat& q = pose.rotation;
  const double axis = wide_length({q.x, q.y, q.z}), w = widened(q.w);
  return wide_length(pose.position_m) <= widened(kMaxDistanceM) &&
         std::fabs(axis * axis + w * w - 1.0) <= kRotationTolerance;
}

bool jumped(const GuardConfig& config, const GuardState& state, Vec3 position_m) {
  const double most =
      widened(kJumpM) + widened(config.max_speed_m_per_s) * since_last_s(config, state);
  return state.have_pose != 0 && wide_length(position_m - state.pose_m) > most;
}

// A device may tell any time, so that whole numbers would overflow.
double age_of(const Sample& sample, std::int64_t now_ns) {
  return static_cast<double>(now_ns) - static_cast<double>(sample.t_ns);
}

// One rule a line; a fault of the sample is counted where it is found.
Refusal judge(const GuardConfig& config, GuardState& state, const Sample& sample,
              std::int64_t now_ns) {
  GuardCounters& count = state.counters;
  const bool repeated = state.have_seq != 0 && sample.seq <= state.seq;
  if (repeated || state.step_ns == 0) {  // nothing is new while no time passes
    ++count.samples_repeated;
    return Refusal::kRepeated;
  }
  if (state.have_seq != 0) count.samples_lost += sample.seq - state.seq - 1;
  state.have_seq = 1;
  state.seq = sample.seq;
  const double age_ns = age_of(sample, now_ns);
  if (age_ns > widened(config.watchdog_s) * 1e9 || age_ns < -static_cast<double>(kMaxLateNs)) {
    ++count.samples_old;
    return Refusal::kLate;
  }
  if (!is_finite(sample.pose)) {
    ++count.samples_not_finite;
    return Refusal::kNotFinite;
  }
  if (!plausible(sample.pose)) {
    ++count.samples_absurd;
    return Refusal::kAbsurd;
  }
  if (jumped(config, state, sample.pose.position_m)) {
    ++count.samples_jumped;
    if (!is_latched(state.mode)) return Refusal::kJumped;
    lose_sight(config, state.energy);  // without force the hand may come back anywhere
  }
  return Refusal::kNone;
}

Fault fault_of(Refusal why) {
  if (why == Refusal::kJumped) return Fault::kTooFast;
  return why == Refusal::kSilent ? Fault::kDeviceSilent : Fault::kStaleSamples;
}

// A new sample that was refused says more than the ticks around it in which nothing new came: which
// of them is the watchdog's last one is chance.
void note_refused(const GuardConfig& config, GuardState& state, Refusal why, const Sample& sample,
                  std::int64_t now_ns) {
  const bool is_new = why > Refusal::kRepeated;
  if (is_latched(state.mode) || (!is_new && state.refused.why > Refusal::kRepeated)) return;
  const double late_ns =
      std::clamp(age_of(sample, now_ns), 0.0, static_cast<double>(kBlindForEverNs));
  const std::int64_t for_ns =
      why == Refusal::kLate ? static_cast<std::int64_t>(late_ns) : state.blind_ns;
  state.refused = {why, for_ns, in_ns(config.watchdog_s)};
}

void note_button(const GuardConfig& config, GuardState& state, std::uint32_t buttons) {
  if (config.dead_man_button < 0) return;
  state.button_seen = 1;
  state.button = (buttons >> static_cast<std::uint32_t>(config.dead_man_button)) & 1U;
}

// A button pressed while the fault came was pressed for something else.
void follow_acknowledge_button(const GuardConfig& config, GuardState& state,
                               std::uint32_t buttons) {
  if (config.acknowledge_button < 0 || state.mode != GuardMode::kFault) return;
  const bool pressed = ((buttons >> static_cast<std::uint32_t>(config.acknowledge_button)) & 1U);
  if (!pressed) {
    state.may_acknowledge = 1;
  } else if (state.may_acknowledge != 0) {
    (void)guard_rearm(state, state.fault);
  }
}

// Nobody has felt anything yet, and the sample that has just come shows that the cause is gone, so
// there is nothing to acknowledge. The force fades in from zero as always.
void clear_before_any_force(GuardState& state) {
  if (guard_clears_itself(state)) (void)guard_rearm(state, state.fault);
}

void trip_on_motion(const GuardConfig& config, GuardState& state) {
  const EnergyObserver& energy = state.energy;
  const double most = widened(config.max_speed_m_per_s);
  if (wide_length(energy.velocity_m_per_s) > most || energy.path_m_per_s > most) {
    guard_trip(state, Fault::kTooFast);
  }
  const bool controlled = config.passivity_damping_n_s_per_m > 0 && is_armed(state.mode);
  if (controlled && energy.energy_j < -kLostEnergyJ) guard_trip(state, Fault::kEnergy);
}

// Whole periods by which this tick came too late are lost; each tick in time makes up for a part of
// one. A tick at the same time as the one before, on a clock of coarse steps, came a period too
// early and makes up for a whole one.
void note_lost(const GuardConfig& config, GuardState& state) {
  const std::int64_t period_ns = in_ns(config.period_s);
  const std::int64_t missed_ns = ((state.step_ns + period_ns / 2) / period_ns - 1) * period_ns;
  if (missed_ns <= 0) {
    const std::int64_t part_ns = std::min(state.step_ns, period_ns) / kLostTicksPart;
    const std::int64_t made_up_ns = state.step_ns == 0 ? period_ns : part_ns;
    state.lost_ns = std::max<std::int64_t>(state.lost_ns - made_up_ns, 0);
    return;
  }
  state.lost_ns = std::min(state.lost_ns + missed_ns, 2 * kMaxLateNs);
  guard_late(state, state.lost_ns);
}

void use(const GuardConfig& config, GuardState& state, const Sample& sample) {
  observe_path(config, state, sample.pose.position_m);
  observe_motion(config, state, sample.pose.position_m);
  observe_turn(config, state.energy, sample.pose.rotation);
  note_button(config, state, sample.buttons);
  state.have_pose = 1;
  state.pose_m = sample.pose.position_m;
  state.blind_ns = 0;
  if (!is_latched(state.mode)) state.refused = {};
  state.jumped_ns = std::max<std::int64_t>(state.jumped_ns - state.step_ns / kJumpedPart, 0);
  ++state.counters.samples_used;
  clear_before_any_force(state);
  trip_on_motion(config, state);
  follow_acknowledge_button(config, state, sample.buttons);
}

}  // namespace

bool guard_clears_itself(const GuardState& state) {
  const Fault fault = state.fault;
  const bool of_time = fault == Fault::kStaleSamples || fault == Fault::kDeviceSilent ||
                       fault == Fault::kTooLate || fault == Fault::kForceExpired;
  return of_time && state.forced == 0;
}

void guard_late(GuardState& state, std::int64_t late_ns) {
  if (late_ns >= kMaxLateNs) guard_trip(state, Fault::kTooLate);
}

void guard_skip(GuardState& state, std::int64_t now_ns) {
  state.have_time = 1;
  state.now_ns = now_ns;
}

bool guard_sample(const GuardConfig& config, GuardState& state, bool answered, const Sample& sample,
                  std::int64_t now_ns) {
  if (state.have_time != 0 && now_ns < state.now_ns) guard_trip(state, Fault::kTooLate);
  note_time(config, state, now_ns);
  note_lost(config, state);
  state.force_due = state.torque_due = 1;
  state.due_ns += state.step_ns;
  const Refusal why = answered ? judge(config, state, sample, now_ns) : Refusal::kSilent;
  if (why == Refusal::kNone) {
    use(config, state, sample);
    return true;
  }
  if (!answered) ++state.counters.samples_missing;
  // If samples jump to and fro, every second one may be usable, so that the guard is never blind
  // for long; yet nobody knows where the hand is.
  if (why == Refusal::kJumped) state.jumped_ns += state.step_ns;
  state.blind_ns = std::min(state.blind_ns + forced_step_ns(config, state), kBlindForEverNs);
  note_refused(config, state, why, sample, now_ns);
  if (state.jumped_ns > kMostJumpedNs) guard_trip(state, Fault::kTooFast);
  if (is_over(config, state.blind_ns, config.watchdog_s)) {
    guard_trip(state, fault_of(state.refused.why));
    lose_sight(config, state.energy);
  }
  return false;
}

}  // namespace stylet::hal
