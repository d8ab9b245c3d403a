// SPDX-License-Identifier: Apache-2.0
#include "hal/doctor/probe.h"

#include <algorithm>
#include <cmath>

#include "hal/base/vector.h"
#include "hal/guard/fault_mailbox.h"

namespace stylet::hal {
namespace {

constexpr std::int64_t kPeriodNs = 1'000'000;
constexpr int kPushTicks = 500;
constexpr float kMostN = 1;

struct Probing {
  const Device& device;
  const Clock& clock;
  GuardConfig guard;
  GuardState state = guard_start();
  Sample last = {};
  bool have = false;
  std::int64_t next_ns = 0;
  std::int64_t new_ns = 0;  // when the newest sample was seen; 0: none was
};

void look_at_steps(const Sample& last, const Sample& now, DeviceProbe& out) {
  const Vec3 &a = last.pose.position_m, &b = now.pose.position_m;
  const std::array change = {std::fabs(b.x - a.x), std::fabs(b.y - a.y), std::fabs(b.z - a.z)};
  for (std::size_t i = 0; i < 3; ++i) {
    if (change[i] > 0 && (out.step_m[i] == 0 || change[i] < out.step_m[i])) {
      out.step_m[i] = change[i];
    }
  }
  out.low_m = {std::min(out.low_m.x, b.x), std::min(out.low_m.y, b.y), std::min(out.low_m.z, b.z)};
  out.high_m = {std::max(out.high_m.x, b.x), std::max(out.high_m.y, b.y),
                std::max(out.high_m.z, b.z)};
}

void look_at(Probing& p, const Sample& now, DeviceProbe& out) {
  ++out.samples;
  out.buttons_seen |= now.buttons;
  histogram_add(out.age, p.clock.now_ns(p.clock.self) - now.t_ns);
  if (p.have) {
    out.lost += now.seq - p.last.seq - 1;
    histogram_add(out.interval, now.t_ns - p.last.t_ns);
    look_at_steps(p.last, now, out);
  } else {
    out.low_m = out.high_m = now.pose.position_m;
  }
  p.have = true;
  p.last = now;
}

void tick(Probing& p, Vec3 force_n, DeviceProbe& out) {
  p.next_ns = std::max(p.next_ns, p.clock.now_ns(p.clock.self) - kPeriodNs) + kPeriodNs;
  p.clock.sleep_until_ns(p.clock.self, p.next_ns);
  const std::int64_t now_ns = p.clock.now_ns(p.clock.self);
  out.latest_tick_ns = std::max(out.latest_tick_ns, now_ns - p.next_ns);
  MotorReport motor;
  if (p.device.motor != nullptr && p.device.motor(p.device.self, motor)) {
    guard_motor(p.state, motor);
  }
  Sample now = {};
  const bool answered = p.device.read(p.device.self, p.next_ns, now);
  (void)guard_sample(p.guard, p.state, answered, now, p.next_ns);
  ++out.ticks;
  if (p.new_ns == 0) p.new_ns = now_ns;
  out.longest_gap_ns = std::max(out.longest_gap_ns, now_ns - p.new_ns);
  if (!answered) {
    ++out.unanswered;
  } else if (p.have && now.seq <= p.last.seq) {
    ++out.repeated;
  } else {
    p.new_ns = now_ns;
    look_at(p, now, out);
  }
  (void)guard_force(p.guard, p.state, force_n);
  p.device.write(p.device.self, guard_command(p.guard, p.state, guard_start()));
  out.fault = p.state.fault;
  out.refused = cause_of(p.state).why;
}

PacketCount since(const PacketCount& before, const PacketCount& now) {
  // A packet that comes late may have been lost before.
  const std::uint64_t lost = now.lost > before.lost ? now.lost - before.lost : 0;
  return {now.came - before.came, now.late - before.late, lost, now.useless - before.useless,
          now.forces_arrive};
}

// A triangle of force, up and down; the hand's motion is taken at the top.
PushSeen push(Probing& p, Vec3 direction, const std::atomic<bool>& stop, DeviceProbe& out) {
  const Vec3 from = p.last.pose.position_m;
  Vec3 top = from;
  for (int i = 0; i < kPushTicks && !stop.load(); ++i) {
    const int from_top = std::abs(i - kPushTicks / 2);
    const float fraction = 1 - static_cast<float>(from_top) / (kPushTicks / 2);
    const float f = fraction * p.guard.max_force_n;
    tick(p, f * direction, out);
    if (i <= kPushTicks / 2) top = p.last.pose.position_m;
  }
  return {p.guard.max_force_n, top - from};
}

}  // namespace

void probe_device(const Device& device, double seconds, bool pushes, const Clock& clock,
                  const std::atomic<bool>& stop, DeviceProbe& out) {
  Probing p = {.device = device, .clock = clock, .guard = {}};
  p.guard.max_force_n = std::min(kMostN, device.info.max_force_n / 3);
  p.guard.max_slew_n_per_s = 100;
  p.guard.ramp_s = 0;
  p.guard.watchdog_s = watchdog_of(device.info, p.guard.watchdog_s);
  const std::int64_t start_ns = clock.now_ns(clock.self);
  // What has queued up since the device was opened does not count.
  Sample queued;
  (void)device.read(device.self, start_ns, queued);
  if (device.packets != nullptr) out.packets = device.packets(device.self);
  const auto free_ticks = static_cast<std::uint64_t>(seconds * 1e3);
  while (out.ticks < free_ticks && !stop.load()) tick(p, {}, out);
  constexpr std::array<Vec3, 6> kWays = {
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  for (std::size_t i = 0; pushes && i < kWays.size() && !stop.load(); ++i) {
    (void)guard_rearm(p.state, p.state.fault);
    out.push[i] = push(p, kWays[i], stop, out);
  }
  if (out.packets) out.packets = since(*out.packets, device.packets(device.self));
  GuardState torque = guard_start();
  for (bool gone = false; !gone;) {  // a fade, 20 ms at most
    p.next_ns += kPeriodNs;
    gone = guard_end(p.guard, p.state, torque, p.next_ns);
    clock.sleep_until_ns(clock.self, p.next_ns);
    Sample unused;
    (void)device.read(device.self, p.next_ns, unused);  // a relay learns the time from this read
    device.write(device.self, guard_command(p.guard, p.state, torque));
  }
  out.seconds = static_cast<double>(clock.now_ns(clock.self) - start_ns) * 1e-9;
}

}  // namespace stylet::hal
