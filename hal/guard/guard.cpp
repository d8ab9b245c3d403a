// SPDX-License-Identifier: Apache-2.0
#include "hal/guard/guard.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/base/vector.h"
#include "hal/base/wide.h"
#include "hal/guard/arithmetic.h"
#include "hal/guard/bounds.h"
#include "hal/guard/energy.h"

namespace stylet::hal {
namespace {

using namespace guarding;

// The largest force that the motors' heat allows: the full one while they are cool, the continuous
// one once they are warm. A force still heats the motors while it falls, by slew or in a fade; if
// that would take more than what is left of the budget, the force is too large.
double largest_force(const GuardConfig& config, const GuardState& state) {
  const double most = widened(config.max_force_n), always = widened(config.continuous_force_n);
  if (always >= most) return most;
  const double warm = state.heat_n2 / (always * always);
  const double back = std::max((warm - widened(kWarmFraction)) / (1 - widened(kWarmFraction)), 0.0);
  const double fall_s = std::max(most / widened(config.max_slew_n_per_s), widened(kDecayS)) / 3 +
                        widened(config.period_s);
  const double left_n2 = std::max(always * always - state.heat_n2, 0.0);
  const double falls = std::sqrt(left_n2 * widened(config.thermal_s) / fall_s);
  return std::max(std::min(most + (always - most) * back, falls), always);
}

// Uses the larger of the force sent and the force the motors report: a device that follows a spring
// by itself may have more force than was sent.
void note_heat(const GuardConfig& config, GuardState& state) {
  const double gain = std::min(step_s(config, state) / widened(config.thermal_s), 1.0);
  const double told_n2 = state.have_motor != 0 ? wide_dot(state.motor_n, state.motor_n) : 0.0;
  const double felt_n2 = std::max(wide_dot(state.force_n, state.force_n), told_n2);
  state.heat_n2 += gain * (felt_n2 - state.heat_n2);
}

void watch_for_buzz(const GuardConfig& config, GuardState& state) {
  BuzzDetector& buzz = state.buzz;
  constexpr double kPi = 3.14159265358979324;
  const double gain = gain_of(step_s(config, state), 1 / (2 * kPi * widened(kBuzzHz)));
  buzz.slow_n = buzz.slow_n + scaled(state.force_n - buzz.slow_n, gain);
  const Vec3 quick = state.force_n - buzz.slow_n;
  buzz.ns += state.step_ns;
  if (buzz.ns > in_ns(0.5F / kBuzzHz)) buzz.turns = 0;
  if (wide_length(quick) < widened(config.buzz_n)) return;
  if (buzz.turns != 0 && wide_dot(quick, buzz.last_n) >= 0) return;
  ++buzz.turns;
  buzz.ns = 0;
  buzz.last_n = quick;
  if (buzz.turns >= kBuzzTurns) guard_trip(state, Fault::kBuzz);
}

Vec3 limited(const GuardConfig& config, GuardState& state, Vec3 wanted) {
  state.ramp_ns = std::min(state.ramp_ns + state.step_ns, in_ns(config.ramp_s));
  const bool full = is_over(config, state.ramp_ns, config.ramp_s);
  if (full) state.mode = GuardMode::kLive;
  const double gain =
      full ? 1.0 : static_cast<double>(state.ramp_ns) / static_cast<double>(in_ns(config.ramp_s));
  const double max_force = largest_force(config, state);
  // Limited before the ramp scales it: the other way round, a force asked ten times too large was
  // let in in a tenth of the time.
  Vec3 force = wanted;
  if (const double size = wide_length(force); size > max_force) {
    ++state.counters.force_limited;
    if (max_force < widened(config.max_force_n)) ++state.counters.force_warm;
    force = scaled(force, max_force / size);
  }
  force = scaled(force, gain);
  const Vec3 last = state.force_n;
  const Vec3 change = force - last;
  // A late tick allows no larger change than one in time: the motors may not have moved meanwhile.
  const double change_s = std::min(step_s(config, state), widened(config.period_s));
  const double max_change = widened(config.max_slew_n_per_s) * change_s;
  if (const double size = wide_length(change); size > max_change) {
    ++state.counters.slew_limited;
    force = last + scaled(change, max_change / size);
  }
  return force;
}

// Fades towards zero; true once the force is there, which is at the last tick before kDecayNs are
// over. After a late tick too few ticks may be left for that; then R3 has precedence, as R6 says.
bool faded(const GuardConfig& config, GuardState& state) {
  const std::int64_t step_ns = forced_step_ns(config, state), period_ns = in_ns(config.period_s);
  state.fade_ns += step_ns;
  const std::int64_t ticks_left = std::max<std::int64_t>(kDecayNs - state.fade_ns, 0) / period_ns;
  const auto now = static_cast<double>(state.fade_ns);
  const auto end = static_cast<double>(state.fade_ns + ticks_left * period_ns);
  const double wanted = ticks_left > 0 ? 1 - now / end : 0.0;
  const double size = wide_length(state.fade_from_n);
  const double fall_n = (1 + kRoundingFraction) * widened(config.max_slew_n_per_s) *
                        static_cast<double>(step_ns) * 1e-9;
  const double least = size > fall_n ? state.fade_left - fall_n / size : 0.0;
  state.fade_left = std::max({wanted, least, 0.0});
  state.force_n = scaled(state.fade_from_n, state.fade_left);
  return !(state.fade_left > 0);
}

void begin_fade(GuardState& state, GuardMode mode) {
  state.mode = mode;
  state.fade_ns = 0;
  state.fade_left = 1;
  // The force let through may not have reached the motors yet, and their report may be old: the
  // fade begins at the smaller of the two.
  const bool less =
      state.have_motor != 0 && wide_length(state.motor_n) < wide_length(state.force_n);
  state.fade_from_n = less ? state.motor_n : state.force_n;
}

// Goes towards zero; true once it is there and the mode is one without force.
bool ended(const GuardConfig& config, GuardState& state) {
  const bool falls = guard_falls(state);
  if (!falls && wide_dot(state.force_n, state.force_n) == 0) return true;
  if (!falls) begin_fade(state, GuardMode::kRelease);
  if (!faded(config, state)) return false;
  state.mode = state.mode == GuardMode::kFading ? GuardMode::kFault : GuardMode::kUnarmed;
  return true;
}

// Changes the mode as the dead man's button demands, before the force is computed.
void follow_button(const GuardConfig& config, GuardState& state) {
  const bool needed = config.dead_man_button >= 0;
  const bool held = !needed || state.button != 0;
  const bool released = !needed || (state.button_seen != 0 && state.button == 0);
  if (state.mode == GuardMode::kLetGo && released) state.mode = GuardMode::kUnarmed;
  if (state.mode == GuardMode::kUnarmed && held && state.have_pose != 0) {
    state.mode = GuardMode::kRamp;
    state.ramp_ns = 0;
    state.step_ns = std::min(state.step_ns, in_ns(config.period_s));  // earlier time does not count
    state.buzz = {};
  }
  if (is_armed(state.mode) && !held) begin_fade(state, GuardMode::kRelease);
}

// The force of this tick, in the mode that has been reached.
void force_of_mode(const GuardConfig& config, GuardState& state, Vec3 force_n) {
  if (is_armed(state.mode)) {
    state.force_n = limited(config, state, damped(config, state, force_n));
    watch_for_buzz(config, state);  // a fade begins with the next tick
  } else if (state.mode == GuardMode::kRelease) {
    if (faded(config, state)) state.mode = GuardMode::kUnarmed;
  } else if (state.mode == GuardMode::kFading) {
    if (faded(config, state)) state.mode = GuardMode::kFault;
  } else {
    state.force_n = {};
  }
}

}  // namespace

GuardState guard_start() {
  GuardState state = {};
  state.arming = 1;
  return state;
}

void guard_resume(const GuardConfig& config, GuardState& state, std::int64_t idle_ns) {
  const double idle_s = static_cast<double>(std::max<std::int64_t>(idle_ns, 0)) * 1e-9;
  state.heat_n2 /= 1 + idle_s / widened(config.thermal_s);  // falls more slowly than motors cool
  lose_sight(config, state.energy);
  state.have_seq = state.have_pose = 0;
  state.have_time = state.force_due = state.torque_due = 0;
  state.step_ns = state.due_ns = state.lost_ns = state.jumped_ns = 0;
  state.button_seen = state.may_acknowledge = 0;
  state.force_n = {};
  state.have_motor = 0;
  state.buzz = {};
  if (is_latched(state.mode)) {
    state.mode = GuardMode::kFault;
    return;
  }
  state.mode = GuardMode::kLetGo;
  ++state.arming;
}

void guard_motor(GuardState& state, const MotorReport& report) {
  state.have_motor = finite(report.force_n) ? 1 : 0;
  state.motor_n = report.force_n;
  if (wide_dot(report.force_n, report.force_n) != 0) state.forced = 1;
  // If the motors' own fade is ahead of the guard's, it shall not push them back up.
  if (const double ours = wide_length(state.force_n), theirs = wide_length(report.force_n);
      guard_falls(state) && theirs < ours) {
    state.fade_from_n = scaled(state.fade_from_n, theirs / ours);
    state.force_n = scaled(state.force_n, theirs / ours);
  }
  if (!report.stopped || report.arming != state.arming) return;
  if (!finite(report.force_n) || wide_length(report.force_n) < wide_length(state.force_n)) {
    state.force_n = finite(report.force_n) ? report.force_n : Vec3{};
  }
  const bool nothing_left = wide_dot(state.force_n, state.force_n) == 0;
  if (!is_latched(state.mode)) {
    if (report.failed) state.refused = {};
    guard_trip(state, report.failed ? Fault::kDeviceSilent : Fault::kForceExpired);
  } else if (state.mode == GuardMode::kFading && nothing_left) {
    state.mode = GuardMode::kFault;
  } else if (state.mode == GuardMode::kFading) {
    begin_fade(state, GuardMode::kFading);
  }
}

bool guard_withdraws_force(const GuardState& state) {
  return !is_armed(state.mode);
}

bool guard_falls(const GuardState& state) {
  return state.mode == GuardMode::kFading || state.mode == GuardMode::kRelease;
}

bool guard_end(const GuardConfig& config, GuardState& force_state, GuardState& torque_state,
               std::int64_t now_ns) {
  note_time(config, force_state, now_ns);  // earlier ticks may have been lost during a fade
  torque_state.step_ns = force_state.step_ns;
  const bool force_gone = ended(config, force_state);
  const bool torque_gone = ended(config, torque_state);
  return force_gone && torque_gone;
}

void guard_trip(GuardState& state, Fault fault) {
  if (is_latched(state.mode)) return;
  state.fault = fault;
  state.may_acknowledge = 0;
  ++state.counters.faults;
  if (fault == Fault::kForceNotFinite) state.force_n = {};
  const bool nothing_left = wide_dot(state.force_n, state.force_n) == 0;
  if (nothing_left) {
    state.mode = GuardMode::kFault;
  } else if (state.mode == GuardMode::kRelease) {
    state.mode = GuardMode::kFading;  // the fade goes on
  } else {
    begin_fade(state, GuardMode::kFading);
  }
}

Vec3 guard_force(const GuardConfig& config, GuardState& state, Vec3 force_n) {
  const bool due = std::exchange(state.force_due, 0U) != 0;
  if (!due && !guard_falls(state) && finite(force_n)) return state.force_n;
  state.step_ns = std::exchange(state.due_ns, 0);  // perhaps the time of more than one sample
  if (!finite(force_n)) {
    ++state.counters.force_not_finite;
    guard_trip(state, Fault::kForceNotFinite);
    force_n = {};
    state.mode = GuardMode::kFault;  // also out of a fade
  }
  if (state.have_pose == 0) force_n = {};  // the observer does not count it either
  follow_button(config, state);
  force_of_mode(config, state, force_n);
  // While the force is less than full the observer uses what the kernel asks for: a spring that is
  // switched on gives back energy that it has stored, and has not made that energy.
  const bool full = state.mode == GuardMode::kLive;
  remember(state.energy.force_n,
           full ? state.force_n : shortened(force_n, widened(config.max_force_n)));
  note_heat(config, state);
  if (wide_dot(state.force_n, state.force_n) != 0) state.forced = 1;
  return state.force_n;
}

Vec3 guard_torque(const GuardConfig& config, float max_torque_nm, GuardState& force_state,
                  GuardState& torque_state, Vec3 torque_nm) {
  if (!(max_torque_nm > 0)) return {};
  GuardConfig limits = config;
  limits.max_force_n = max_torque_nm;
  limits.max_slew_n_per_s = 2 * max_torque_nm / kDecayS;
  // The same fractions of a limit as for a force; what damps a motion does not damp a turn.
  const float torque_per_force_m = max_torque_nm / config.max_force_n;
  limits.buzz_n = torque_per_force_m * config.buzz_n;
  limits.continuous_force_n = torque_per_force_m * config.continuous_force_n;
  limits.passivity_damping_n_s_per_m = 0;
  if (force_state.fault != Fault::kNone) guard_trip(torque_state, force_state.fault);
  if (force_state.fault == Fault::kNone) (void)guard_rearm(torque_state, torque_state.fault);
  torque_state.button_seen = force_state.button_seen;
  torque_state.button = force_state.button;
  torque_state.have_pose = force_state.have_pose;
  torque_state.due_ns = force_state.step_ns;
  const bool due = std::exchange(force_state.torque_due, 0U) != 0;
  torque_state.force_due = due ? 1 : 0;
  if (!due && !guard_falls(torque_state) && finite(torque_nm)) return torque_state.force_n;
  const Vec3 result = guard_force(limits, torque_state, torque_nm);
  force_state.forced |= torque_state.forced;
  if (torque_state.fault != Fault::kNone) guard_trip(force_state, torque_state.fault);
  const bool full = torque_state.mode == GuardMode::kLive && finite(torque_nm);
  remember(force_state.energy.torque_nm, full ? result : Vec3{});
  return result;
}

Command guard_command(const GuardConfig& config, const GuardState& force_state,
                      const GuardState& torque_state) {
  return {.force_n = force_state.force_n,
          .torque_nm = torque_state.force_n,
          .place_m = force_state.pose_m,
          .max_force_n = config.max_force_n,
          .arming = force_state.arming,
          .falls = guard_withdraws_force(force_state)};
}

bool guard_rearm(GuardState& state, Fault seen) {
  const bool named = state.fault != Fault::kNone && state.fault == seen;
  if (!named || state.mode != GuardMode::kFault || state.blind_ns != 0) return false;
  state.mode = GuardMode::kLetGo;
  state.fault = Fault::kNone;
  state.refused = {};
  state.button_seen = 0;
  state.energy.energy_j = std::max(state.energy.energy_j, 0.0);
  ++state.arming;
  ++state.counters.rearms;
  return true;
}

}  // namespace stylet::hal
