// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/simulated_hand.h"

#include <algorithm>
#include <cmath>

#include "hal/base/angle.h"

namespace stylet::hal {
namespace {

struct HandTarget {
  double position_m[3];
  double velocity_m_per_s[3];
  double turns;
  float plunger_n;
};

// Turns since the start, at `fraction` of the motion from a to b.
double turns_at(const ScriptPoint& a, const ScriptPoint& b, double fraction) {
  const double due = fraction * (b.turns - a.turns);
  const double whole = std::trunc(due);
  const double part = (due - whole) / b.duty;
  return a.turns + whole + std::clamp(part, -1.0, 1.0);
}

// Keeps the segment found last, because the script is only ever read forward.
HandTarget target_at(SimulatedHand& hand, double t_s) {
  const std::vector<ScriptPoint>& script = hand.script;
  while (hand.segment + 2 < script.size() && t_s >= script[hand.segment + 1].t_s) ++hand.segment;
  const ScriptPoint& a = script[hand.segment];
  const ScriptPoint& b = script[std::min(hand.segment + 1, script.size() - 1)];
  const double span = b.t_s - a.t_s;
  if (!(span > 0) || t_s >= b.t_s) return {{b.x_m, b.y_m, b.z_m}, {0, 0, 0}, b.turns, b.plunger_n};
  const double fraction = (t_s - a.t_s) / span;
  const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, dz = b.z_m - a.z_m;
  return {{a.x_m + fraction * dx, a.y_m + fraction * dy, a.z_m + fraction * dz},
          {dx / span, dy / span, dz / span},
          turns_at(a, b, fraction),
          b.plunger_n};
}

double of(float value) {
  return static_cast<double>(value);
}

// Fraction of the velocity left when Coulomb friction takes up to `most`, but not more than all.
double rubbed(const double (&velocity)[3], double most) {
  const double speed =
      std::sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2]);
  return speed > most ? 1 - most / speed : 0;
}

// m a = k (target - x) + c (target velocity - v) + force - device, by the implicit midpoint rule.
void step(SimulatedHand& hand, const HandTarget& target, double h) {
  const DeviceDynamics& device = hand.config.device;
  const double m = of(hand.config.mass_kg) + of(device.mass_kg);
  const double k = of(hand.config.stiffness_n_per_m), c = of(hand.config.damping_n_s_per_m);
  const double b = of(device.damping_n_s_per_m);
  const double inertia = m + 0.5 * h * (c + b) + 0.25 * h * h * k;
  const double force[3] = {of(hand.force_n.x), of(hand.force_n.y), of(hand.force_n.z)};
  double(&v)[3] = hand.velocity_m_per_s;
  double change[3], taken[3] = {};
  for (int i = 0; i < 3; ++i) {
    const double pull = k * (target.position_m[i] - hand.position_m[i] - 0.5 * h * v[i]) +
                        c * (target.velocity_m_per_s[i] - v[i]) - b * v[i] + force[i];
    change[i] = h * pull / inertia;
  }
  if (device.friction_n > 0) {
    const double next[3] = {v[0] + change[0], v[1] + change[1], v[2] + change[2]};
    const double left = rubbed(next, h * of(device.friction_n) / inertia);
    for (int i = 0; i < 3; ++i) {
      taken[i] = (1 - left) * next[i] * inertia / h;
      change[i] = left * next[i] - v[i];
    }
  }
  for (int i = 0; i < 3; ++i) {
    const double mean = v[i] + 0.5 * change[i];
    hand.position_m[i] += h * mean;
    v[i] += change[i];
    hand.received_j += h * mean * (b * mean + taken[i] - force[i]);
  }
  hand.least_received_j = std::min(hand.least_received_j, hand.received_j);
}

// The position that the device tells: that of `delay_s` ago, rounded to its resolution.
Vec3 measured_m(const SimulatedHand& hand, std::uint64_t steps) {
  const double late = of(hand.config.device.delay_s) / hand.period_s * kHandStepsPerTick;
  const auto ago = static_cast<std::uint64_t>(std::clamp(late + 0.5, 0.0, kHandHistory - 1.0));
  const auto& at = hand.history_m[(std::max(steps, ago) - ago) % kHandHistory];
  const double grain = of(hand.config.device.resolution_m);
  const auto told = [grain](double x) {
    return static_cast<float>(grain > 0 ? grain * std::floor(x / grain + 0.5) : x);
  };
  return {told(at[0]), told(at[1]), told(at[2])};
}

bool read(void* self, std::int64_t now_ns, Sample& sample_out) {
  SimulatedHand& hand = *static_cast<SimulatedHand*>(self);
  const double h = hand.period_s / kHandStepsPerTick;
  const double start_s = static_cast<double>(hand.tick) * hand.period_s;
  std::uint64_t steps = hand.tick * kHandStepsPerTick;
  for (std::uint32_t i = 0; i < kHandStepsPerTick; ++i) {
    step(hand, target_at(hand, start_s + (i + 0.5) * h), h);
    ++steps;
    std::copy_n(hand.position_m, 3, hand.history_m[steps % kHandHistory].begin());
  }
  ++hand.tick;
  const double now_s = static_cast<double>(hand.tick) * hand.period_s;
  const HandTarget now = target_at(hand, now_s);
  const SineCosine half = sine_cosine(0.5 * now.turns);
  sample_out = {hand.tick,
                now_ns,
                {measured_m(hand, steps),
                 {static_cast<float>(half.cosine), 0, 0, static_cast<float>(half.sine)}},
                hand.tick > 1 ? hand.config.held_buttons : 0,
                now.plunger_n};
  return true;
}

void write(void* self, const Command& command) {
  static_cast<SimulatedHand*>(self)->force_n = command.force_n;
}

void close(void* self) {
  static_cast<SimulatedHand*>(self)->force_n = {};
}

}  // namespace

double seconds_between(const Waypoint& from, const Waypoint& to) {
  if (!(to.speed_m_per_s > 0)) return static_cast<double>(to.time_s);
  const double ahead = static_cast<double>(to.travel_m) - static_cast<double>(from.travel_m);
  const double right = static_cast<double>(to.right_m) - static_cast<double>(from.right_m);
  const double up = static_cast<double>(to.up_m) - static_cast<double>(from.up_m);
  return std::sqrt(ahead * ahead + right * right + up * up) / static_cast<double>(to.speed_m_per_s);
}

std::vector<ScriptPoint> make_script(const std::vector<Waypoint>& waypoints, float start_m) {
  const double start = static_cast<double>(start_m);
  std::vector<ScriptPoint> script = {{0, 0, 0, 0}};
  Waypoint last;
  last.travel_m = -start_m;
  for (const Waypoint& w : waypoints) {
    ScriptPoint to = script.back();
    to.t_s += seconds_between(last, w);
    to.x_m = static_cast<double>(w.right_m);
    to.y_m = static_cast<double>(w.up_m);
    to.z_m = -(static_cast<double>(w.travel_m) + start);
    to.turns += static_cast<double>(w.turns);
    to.duty = static_cast<double>(w.duty);
    to.plunger_n = w.plunger_n;
    script.push_back(to);
    last = w;
    if (w.hold_s > 0) {
      to.t_s += static_cast<double>(w.hold_s);
      script.push_back(to);
    }
  }
  return script;
}

std::uint64_t script_ticks(const std::vector<ScriptPoint>& script, double period_s) {
  return static_cast<std::uint64_t>(std::ceil(script.back().t_s / period_s - 1e-6));
}

Device simulated_hand_device(SimulatedHand& hand, const DeviceInfo& info) {
  return {&hand, info, read, write, close};
}

}  // namespace stylet::hal
