// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylet::hal {
namespace {

double of(float value) {
  return static_cast<double>(value);
}

bool finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool finite(const Pose& pose) {
  const Quat& q = pose.rotation;
  return finite(pose.position_m) && std::isfinite(q.w) && std::isfinite(q.x) &&
         std::isfinite(q.y) && std::isfinite(q.z);
}

// Double: the square of any finite float stays finite.
double dot(Vec3 a, Vec3 b) {
  return of(a.x) * of(b.x) + of(a.y) * of(b.y) + of(a.z) * of(b.z);
}

double length(Vec3 v) {
  return std::sqrt(dot(v, v));
}

Vec3 scaled(Vec3 v, double s) {
  return {static_cast<float>(of(v.x) * s), static_cast<float>(of(v.y) * s),
          static_cast<float>(of(v.z) * s)};
}

Vec3 minus(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Vec3 plus(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

Vec3 shortened(Vec3 v, double most) {
  const double size = length(v);
  return size > most ? scaled(v, most / size) : v;
}

// How far a value that follows another with the time constant `slow_s` comes in `step_s`.
double share_of(double step_s, double slow_s) {
  return step_s / (step_s + slow_s);
}

bool plausible(const Pose& pose) {
  const Quat& q = pose.rotation;
  const double axis = length({q.x, q.y, q.z}), w = of(q.w);
  return length(pose.position_m) <= of(kMaxDistanceM) &&
         std::fabs(axis * axis + w * w - 1.0) <= kRotationTolerance;
}

// Ticks that fit into a time, at least one. Floored, so that a promise in seconds is kept; the
// small share more is for periods that are not exact in binary.
std::uint32_t whole_ticks(float time_s, float period_s) {
  const float ticks = time_s / period_s * 1.0001F;
  return ticks < 1.0F ? 1U : static_cast<std::uint32_t>(ticks);
}

bool is_latched(GuardMode mode) {
  return mode == GuardMode::kFading || mode == GuardMode::kFault;
}

bool is_armed(GuardMode mode) {
  return mode == GuardMode::kRamp || mode == GuardMode::kLive;
}

// ---- samples
// ---------------------------------------------------------------------------------------

// Since the last usable sample, this one included.
double since_last_s(const GuardConfig& config, const GuardState& state) {
  return (1.0 + state.blind_ticks) * of(config.period_s);
}

bool jumped(const GuardConfig& config, const GuardState& state, Vec3 position_m) {
  const double most = of(kJumpM) + of(config.max_speed_m_per_s) * since_last_s(config, state);
  return state.have_pose != 0 && length(minus(position_m, state.pose_m)) > most;
}

// The device is somewhere else, and what was drawn on the way is not known: it may be all that a
// spring can hold.
void lose_sight(const GuardConfig& config, EnergyObserver& energy) {
  if (energy.have_position != 0) energy.energy_j = of(config.stored_energy_j);
  energy.have_position = 0;
}

// One rule a line; what is wrong with the sample is counted where it is found.
Fault judge(const GuardConfig& config, GuardState& state, const Sample& sample,
            std::int64_t now_ns) {
  GuardCounters& count = state.counters;
  if (state.have_seq != 0 && sample.seq <= state.seq) {
    ++count.samples_repeated;
    return Fault::kStaleSamples;
  }
  if (state.have_seq != 0) count.samples_lost += sample.seq - state.seq - 1;
  state.have_seq = 1;
  state.seq = sample.seq;
  if (static_cast<double>(now_ns) - static_cast<double>(sample.t_ns) >
      of(config.watchdog_s) * 1e9) {
    ++count.samples_old;
    return Fault::kStaleSamples;
  }
  if (!finite(sample.pose)) {
    ++count.samples_not_finite;
    return Fault::kStaleSamples;
  }
  if (!plausible(sample.pose)) {
    ++count.samples_absurd;
    return Fault::kStaleSamples;
  }
  if (jumped(config, state, sample.pose.position_m)) {
    ++count.samples_jumped;
    if (!is_latched(state.mode)) return Fault::kTooFast;
    lose_sight(config, state.energy);  // without force it may come back anywhere
  }
  return Fault::kNone;
}

void note_button(const GuardConfig& config, GuardState& state, std::uint32_t buttons) {
  if (config.dead_man_button < 0) return;
  state.button_seen = 1;
  state.button = (buttons >> static_cast<std::uint32_t>(config.dead_man_button)) & 1U;
}

// Pressed while the fault came, it was pressed for something else.
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

// ---- energy
// ----------------------------------------------------------------------------------------

// The force that acted while the device made the motion it tells of now.
Vec3 force_then(const GuardConfig& config, const EnergyObserver& energy) {
  const double ticks = std::clamp(of(config.device.delay_s) / of(config.period_s), 0.0,
                                  static_cast<double>(kMaxDelayTicks));
  const auto whole = static_cast<std::size_t>(ticks);
  const double part = ticks - static_cast<double>(whole);
  return plus(scaled(energy.force_n[whole], 1 - part), scaled(energy.force_n[whole + 1], part));
}

// Work of the hand in this motion. A position within the resolution of the last is no motion, so
// that a count that flickers does no work.
void observe_motion(const GuardConfig& config, GuardState& state, Vec3 position_m) {
  EnergyObserver& energy = state.energy;
  if (energy.have_position == 0) energy.position_m = position_m;
  energy.have_position = 1;
  const Vec3 way = minus(position_m, energy.position_m);
  const double size = length(way), slack = of(config.device.resolution_m);
  const Vec3 before = energy.position_m;
  if (size > slack) energy.position_m = plus(before, scaled(way, 1 - slack / size));
  const Vec3 moved = minus(energy.position_m, before);
  const double time_s = since_last_s(config, state);
  const Vec3 slower = minus(scaled(moved, 1 / time_s), energy.velocity_m_per_s);
  energy.velocity_m_per_s =
      plus(energy.velocity_m_per_s, scaled(slower, share_of(time_s, of(kSpeedS))));
  const double damped =
      of(config.device.damping_n_s_per_m) * std::max(dot(energy.velocity_m_per_s, moved), 0.0);
  energy.energy_j += damped + of(config.device.friction_n) * length(moved) -
                     dot(force_then(config, energy), moved);
  energy.energy_j = std::min(energy.energy_j, of(config.stored_energy_j));
  energy.least_j = std::min(energy.least_j, energy.energy_j);
}

void remember_force(EnergyObserver& energy, Vec3 force_n) {
  std::copy_backward(energy.force_n.begin(), energy.force_n.end() - 1, energy.force_n.end());
  energy.force_n[0] = force_n;
}

// Takes back what was made, as far as damping can in this tick.
Vec3 damped(const GuardConfig& config, GuardState& state, Vec3 force_n) {
  const EnergyObserver& energy = state.energy;
  const double square = dot(energy.velocity_m_per_s, energy.velocity_m_per_s);
  const double most = of(config.passivity_damping_n_s_per_m);
  if (!(most > 0 && energy.energy_j < 0 && square > 0)) return force_n;
  ++state.counters.force_damped;
  const double damping = std::min(most, -energy.energy_j / (of(config.period_s) * square));
  return minus(force_n, scaled(energy.velocity_m_per_s, damping));
}

void trip_on_motion(const GuardConfig& config, GuardState& state) {
  const EnergyObserver& energy = state.energy;
  if (length(energy.velocity_m_per_s) > of(config.max_speed_m_per_s)) {
    guard_trip(state, Fault::kTooFast);
  }
  const bool controlled = config.passivity_damping_n_s_per_m > 0 && is_armed(state.mode);
  if (controlled && energy.energy_j < -kLostEnergyJ) guard_trip(state, Fault::kEnergy);
}

// ---- force
// -----------------------------------------------------------------------------------------

// The budget of the motors: full force while they are cool, the continuous one once they are warm;
// and never one whose fall, by slew or in a fade, would take more than is left.
double largest_force(const GuardConfig& config, const GuardState& state) {
  const double most = of(config.max_force_n), always = of(config.continuous_force_n);
  if (always >= most) return most;
  const double warm = state.heat_n2 / (always * always);
  const double back = std::max((warm - of(kWarmShare)) / (1 - of(kWarmShare)), 0.0);
  const double fall_s =
      std::max(most / of(config.max_slew_n_per_s), of(kDecayS)) / 3 + of(config.period_s);
  const double left_n2 = std::max(always * always - state.heat_n2, 0.0);
  const double falls = std::sqrt(left_n2 * of(config.thermal_s) / fall_s);
  return std::max(std::min(most + (always - most) * back, falls), always);
}

void note_heat(const GuardConfig& config, GuardState& state) {
  const double share = of(config.period_s) / of(config.thermal_s);
  state.heat_n2 += share * (dot(state.force_n, state.force_n) - state.heat_n2);
}

void watch_for_buzz(const GuardConfig& config, GuardState& state) {
  BuzzDetector& buzz = state.buzz;
  constexpr double kPi = 3.14159265358979324;
  const double share = share_of(of(config.period_s), 1 / (2 * kPi * of(kBuzzHz)));
  buzz.slow_n = plus(buzz.slow_n, scaled(minus(state.force_n, buzz.slow_n), share));
  const Vec3 quick = minus(state.force_n, buzz.slow_n);
  if (++buzz.ticks > whole_ticks(0.5F / kBuzzHz, config.period_s)) buzz.turns = 0;
  if (length(quick) < of(config.buzz_n)) return;
  if (buzz.turns != 0 && dot(quick, buzz.last_n) >= 0) return;
  ++buzz.turns;
  buzz.ticks = 0;
  buzz.last_n = quick;
  if (buzz.turns >= kBuzzTurns) guard_trip(state, Fault::kBuzz);
}

Vec3 limited(const GuardConfig& config, GuardState& state, Vec3 wanted) {
  const std::uint32_t ramp_ticks = whole_ticks(config.ramp_s, config.period_s);
  if (state.ramp_tick < ramp_ticks) ++state.ramp_tick;
  if (state.ramp_tick >= ramp_ticks) state.mode = GuardMode::kLive;
  const double gain = static_cast<double>(state.ramp_tick) / ramp_ticks;
  const double max_force = largest_force(config, state);
  Vec3 force = scaled(wanted, gain);
  if (const double size = length(force); size > max_force) {
    ++state.counters.force_limited;
    if (max_force < of(config.max_force_n)) ++state.counters.force_warm;
    force = scaled(force, max_force / size);
  }
  const Vec3 last = state.force_n;
  const Vec3 change = minus(force, last);
  const double max_change = of(config.max_slew_n_per_s) * of(config.period_s);
  if (const double size = length(change); size > max_change) {
    ++state.counters.slew_limited;
    force = plus(last, scaled(change, max_change / size));
  }
  return force;
}

// Towards zero; true once it is there.
bool faded(const GuardConfig& config, GuardState& state) {
  const std::uint32_t ticks = whole_ticks(kDecayS, config.period_s);
  ++state.fade_tick;
  const double left = static_cast<double>(ticks - state.fade_tick) / ticks;
  state.force_n = scaled(state.fade_from_n, left);
  return state.fade_tick == ticks;
}

void begin_fade(GuardState& state, GuardMode mode) {
  state.mode = mode;
  state.fade_tick = 0;
  state.fade_from_n = state.force_n;
}

// What the dead man's button does to the mode, before the force.
void follow_button(const GuardConfig& config, GuardState& state) {
  const bool needed = config.dead_man_button >= 0;
  const bool held = !needed || state.button != 0;
  const bool released = !needed || (state.button_seen != 0 && state.button == 0);
  if (state.mode == GuardMode::kLetGo && released) state.mode = GuardMode::kUnarmed;
  if (state.mode == GuardMode::kUnarmed && held) {
    state.mode = GuardMode::kRamp;
    state.ramp_tick = 0;
    state.buzz = {};
  }
  if (is_armed(state.mode) && !held) begin_fade(state, GuardMode::kRelease);
}

// The force of this tick, in the mode that it has come to.
void force_of_mode(const GuardConfig& config, GuardState& state, Vec3 force_n) {
  if (is_armed(state.mode)) {
    state.force_n = limited(config, state, damped(config, state, force_n));
    watch_for_buzz(config, state);
  } else if (state.mode == GuardMode::kRelease) {
    if (faded(config, state)) state.mode = GuardMode::kUnarmed;
  } else if (state.mode == GuardMode::kFading) {
    if (faded(config, state)) state.mode = GuardMode::kFault;
  } else {
    state.force_n = {};
  }
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
    case Fault::kTooFast:
      return "device too fast";
    case Fault::kBuzz:
      return "force buzzes";
    case Fault::kEnergy:
      return "energy made";
  }
  return "unknown fault";
}

const char* mode_name(GuardMode mode) {
  switch (mode) {
    case GuardMode::kLetGo:
      return "let go";
    case GuardMode::kUnarmed:
      return "unarmed";
    case GuardMode::kRamp:
      return "ramp";
    case GuardMode::kLive:
      return "live";
    case GuardMode::kRelease:
      return "release";
    case GuardMode::kFading:
      return "fading";
    case GuardMode::kFault:
      return "fault";
  }
  return "unknown mode";
}

GuardState guard_start() {
  return GuardState{};
}

void guard_trip(GuardState& state, Fault fault) {
  if (is_latched(state.mode)) return;
  state.fault = fault;
  state.may_acknowledge = 0;
  ++state.counters.faults;
  if (fault == Fault::kForceNotFinite) state.force_n = {};
  const bool nothing_left = dot(state.force_n, state.force_n) == 0;
  if (nothing_left) {
    state.mode = GuardMode::kFault;
  } else if (state.mode == GuardMode::kRelease) {
    state.mode = GuardMode::kFading;  // the fade goes on
  } else {
    begin_fade(state, GuardMode::kFading);
  }
}

bool guard_sample(const GuardConfig& config, GuardState& state, bool answered, const Sample& sample,
                  std::int64_t now_ns) {
  const Fault wrong = answered ? judge(config, state, sample, now_ns) : Fault::kDeviceSilent;
  if (wrong == Fault::kNone) {
    observe_motion(config, state, sample.pose.position_m);
    note_button(config, state, sample.buttons);
    state.have_pose = 1;
    state.pose_m = sample.pose.position_m;
    state.blind_ticks = 0;
    ++state.counters.samples_used;
    trip_on_motion(config, state);
    follow_acknowledge_button(config, state, sample.buttons);
    return true;
  }
  if (!answered) ++state.counters.samples_missing;
  if (state.blind_ticks < std::numeric_limits<std::uint32_t>::max()) ++state.blind_ticks;
  if (state.blind_ticks >= whole_ticks(config.watchdog_s, config.period_s)) {
    guard_trip(state, wrong);
    lose_sight(config, state.energy);
  }
  return false;
}

Vec3 guard_force(const GuardConfig& config, GuardState& state, Vec3 force_n) {
  if (!finite(force_n)) {
    ++state.counters.force_not_finite;
    guard_trip(state, Fault::kForceNotFinite);
    force_n = {};
    state.mode = GuardMode::kFault;  // out of a fade, too
  }
  follow_button(config, state);
  force_of_mode(config, state, force_n);
  // Without a full force the observer follows what the kernel asks: a spring that is switched on
  // gives back what it has stored, and did not make that.
  const bool full = state.mode == GuardMode::kLive;
  remember_force(state.energy, full ? state.force_n : shortened(force_n, of(config.max_force_n)));
  note_heat(config, state);
  return state.force_n;
}

Vec3 guard_torque(const GuardConfig& config, float max_torque_nm, GuardState& force_state,
                  GuardState& torque_state, Vec3 torque_nm) {
  if (!(max_torque_nm > 0)) return {};
  GuardConfig limits = config;
  limits.max_force_n = max_torque_nm;
  limits.max_slew_n_per_s = 2 * max_torque_nm / kDecayS;
  if (force_state.fault != Fault::kNone) guard_trip(torque_state, force_state.fault);
  if (force_state.fault == Fault::kNone) (void)guard_rearm(torque_state, torque_state.fault);
  torque_state.button_seen = force_state.button_seen;
  torque_state.button = force_state.button;
  const Vec3 result = guard_force(limits, torque_state, torque_nm);
  if (torque_state.fault != Fault::kNone) guard_trip(force_state, torque_state.fault);
  return result;
}

bool guard_rearm(GuardState& state, Fault seen) {
  const bool named = state.fault != Fault::kNone && state.fault == seen;
  if (!named || state.mode != GuardMode::kFault || state.blind_ticks != 0) return false;
  state.mode = GuardMode::kLetGo;
  state.fault = Fault::kNone;
  state.button_seen = 0;
  state.energy.energy_j = std::max(state.energy.energy_j, 0.0);
  ++state.counters.rearms;
  return true;
}

}  // namespace stylet::hal
