// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/simulated_hand.h"

#include <algorithm>
#include <cmath>

#include "stylet/hal/angle.h"

namespace stylet::hal {
namespace {

constexpr int kStepsPerTick = 8;

struct Target {
  double position_m[3];
  double velocity_m_per_s[3];
  double turns;
};

// Turns since the start, `share` of the way from a to b.
double turns_at(const ScriptPoint& a, const ScriptPoint& b, double share) {
  const double due = share * (b.turns - a.turns);
  const double whole = std::trunc(due);
  const double part = (due - whole) / b.duty;
  return a.turns + whole + std::clamp(part, -1.0, 1.0);
}

// Remembers the segment it was in: the script is only ever read forward.
Target target_at(SimulatedHand& hand, double t_s) {
  const std::vector<ScriptPoint>& script = hand.script;
  while (hand.segment + 2 < script.size() && t_s >= script[hand.segment + 1].t_s) ++hand.segment;
  const ScriptPoint& a = script[hand.segment];
  const ScriptPoint& b = script[std::min(hand.segment + 1, script.size() - 1)];
  const double span = b.t_s - a.t_s;
  if (!(span > 0) || t_s >= b.t_s) return {{b.x_m, b.y_m, b.z_m}, {0, 0, 0}, b.turns};
  const double share = (t_s - a.t_s) / span;
  const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, dz = b.z_m - a.z_m;
  return {{a.x_m + share * dx, a.y_m + share * dy, a.z_m + share * dz},
          {dx / span, dy / span, dz / span},
          turns_at(a, b, share)};
}

// m a = k (target - x) + c (target velocity - v) + force, by the implicit midpoint rule.
void step(SimulatedHand& hand, const Target& target, double h) {
  const double m = static_cast<double>(hand.config.mass_kg);
  const double k = static_cast<double>(hand.config.stiffness_n_per_m);
  const double c = static_cast<double>(hand.config.damping_n_s_per_m);
  const double force[3] = {static_cast<double>(hand.force_n.x), static_cast<double>(hand.force_n.y),
                           static_cast<double>(hand.force_n.z)};
  for (int i = 0; i < 3; ++i) {
    double& x = hand.position_m[i];
    double& v = hand.velocity_m_per_s[i];
    const double pull = k * (target.position_m[i] - x - 0.5 * h * v) +
                        c * (target.velocity_m_per_s[i] - v) + force[i];
    const double change = h * pull / (m + 0.5 * h * c + 0.25 * h * h * k);
    x += h * (v + 0.5 * change);
    v += change;
  }
}

bool read(void* self, std::int64_t now_ns, Sample& sample_out) {
  SimulatedHand& hand = *static_cast<SimulatedHand*>(self);
  const double h = hand.period_s / kStepsPerTick;
  const double start_s = static_cast<double>(hand.tick) * hand.period_s;
  for (int i = 0; i < kStepsPerTick; ++i) step(hand, target_at(hand, start_s + (i + 0.5) * h), h);
  ++hand.tick;
  const double now_s = static_cast<double>(hand.tick) * hand.period_s;
  const SineCosine half = sine_cosine(0.5 * target_at(hand, now_s).turns);
  sample_out = {hand.tick,
                now_ns,
                {{static_cast<float>(hand.position_m[0]), static_cast<float>(hand.position_m[1]),
                  static_cast<float>(hand.position_m[2])},
                 {static_cast<float>(half.cosine), 0, 0, static_cast<float>(half.sine)}},
                0};
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
