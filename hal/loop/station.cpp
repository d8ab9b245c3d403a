// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/station.h"

#include <algorithm>
#include <array>
#include <optional>

#include "hal/base/vector.h"

namespace stylet::hal {
namespace {

constexpr int kMostPerTick = 64;
constexpr std::int64_t kFadeInNs = 100'000'000;

void take_models(StationState& state, const Link& link, std::int64_t now_ns) {
  std::array<std::byte, kMaxPacketBytes> room;
  for (int i = 0; i < kMostPerTick; ++i) {
    const std::optional<std::size_t> size = link.receive(link.self, room);
    if (!size) return;
    ForcePacket packet;
    const bool taken =
        decode(std::span(room).first(*size), packet) && obey(state.obeyed, packet, now_ns);
    ++(taken ? state.models : state.refused);
  }
}

// How much of the model is felt: it fades in each time models come again, and fades out in the
// second half of its life. So nothing is left at its end that the guard would have to let fall
// slowly.
float model_fraction(StationState& state, std::int64_t now_ns) {
  const float out = obeyed_fraction(state.obeyed, now_ns);
  if (!(out > 0)) {
    state.fade_ns = 0;
    ++state.starved;
    return 0;
  }
  state.fade_ns = std::min(state.fade_ns + state.guard.step_ns, kFadeInNs);
  const float in = static_cast<float>(state.fade_ns) / static_cast<float>(kFadeInNs);
  return std::min(in, out);
}

// Shortened to `most`, the most the guard lets through, and then scaled by the fraction: so the
// fade begins at the force that is felt.
Vec3 faded(float share, float most, Vec3 v) {
  const float size = length(v);
  return (size > most ? share * most / size : share) * v;
}

// The newest model, through the guard.
void render(const StationConfig& config, StationState& state, std::int64_t now_ns) {
  const float share = model_fraction(state, now_ns);
  const Vec3 at_m = state.guard.pose_m;  // never the position of a sample that the guard refused
  const ForcePacket& newest = state.obeyed.newest;
  state.force_n =
      guard_force(config.guard, state.guard,
                  faded(share, config.guard.max_force_n, force_at(newest, now_ns, at_m)));
  state.torque_nm =
      guard_torque(config.guard, config.max_torque_nm, state.guard, state.torque_guard,
                   faded(share, config.max_torque_nm, torque_at(newest, now_ns, at_m)));
}

// Tells the motors when the model's life is over, so that no force is left then, even if the guard
// still fades or the station is held up.
void write(const StationConfig& config, const StationState& state, const Device& device) {
  Command command = guard_command(config.guard, state.guard, state.torque_guard);
  const ForcePacket& newest = state.obeyed.newest;
  command.end_ns = newest.echo_t_ns + newest.life_ns;  // 0 if no model came yet, which means no end
  device.write(device.self, command);
}

}  // namespace

StationConfig station_config(const DeviceInfo& info) {
  StationConfig config;
  GuardConfig& guard = config.guard;
  if (info.max_force_n > 0) guard.max_force_n = std::min(guard.max_force_n, info.max_force_n);
  constexpr float kFadeS = 0.5e-9F * static_cast<float>(kForceLifeNs);  // of a model's end
  const float slew = std::min(guard.max_slew_n_per_s, info.max_slew_n_per_s);
  guard.max_slew_n_per_s = std::max(slew, guard.max_force_n / kFadeS);
  if (info.continuous_force_n > 0) guard.continuous_force_n = info.continuous_force_n;
  guard.watchdog_s = watchdog_of(info, 5e-3F);
  config.max_torque_nm = info.max_torque_nm;
  config.limits = {guard.max_force_n, info.max_stiffness_n_per_m, info.continuous_force_n,
                   info.max_torque_nm};
  return config;
}

StationState station_start(std::uint32_t session) {
  StationState state;
  state.sent.session = session;
  return state;
}

void station_tick(const StationConfig& config, StationState& state, const Device& device,
                  const Link& link, std::int64_t now_ns) {
  MotorReport motor;
  const bool tells = device.motor != nullptr && device.motor(device.self, motor);
  if (tells) guard_motor(state.guard, motor);
  const bool answered = device.read(device.self, now_ns, state.sample);
  const bool usable = guard_sample(config.guard, state.guard, answered, state.sample, now_ns);
  take_models(state, link, now_ns);
  render(config, state, now_ns);
  write(config, state, device);
  if (!usable || state.guard.fault != Fault::kNone) return;
  ++state.sent.seq;
  state.sent.t_ns = now_ns;
  state.sent.echo = state.obeyed.newest.seq;
  state.sent.arming = state.obeyed.newest.arming;
  state.sent.stopped = state.obeyed.stopped ? 1 : 0;
  state.sent.force_n = tells ? motor.force_n : state.force_n;
  state.sent.pose = state.sample.pose;
  state.sent.buttons = state.sample.buttons;
  state.sent.limits = config.limits;
  link.send(link.self, encode(state.sent));
}

bool station_end(const StationConfig& config, StationState& state, const Device& device,
                 std::int64_t now_ns) {
  (void)device.read(device.self, now_ns, state.sample);  // a relay learns the time from this read
  const bool gone = guard_end(config.guard, state.guard, state.torque_guard, now_ns);
  write(config, state, device);
  return gone;
}

}  // namespace stylet::hal
