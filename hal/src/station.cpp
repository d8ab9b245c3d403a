// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/station.h"

#include <algorithm>
#include <array>

namespace stylet::hal {
namespace {

constexpr int kMostPerTick = 64;
constexpr float kFadeInS = 0.1F;

void take_models(StationState& state, const Link& link) {
  std::array<std::byte, kMaxPacketBytes> room;
  for (int i = 0; i < kMostPerTick; ++i) {
    const std::size_t size = link.receive(link.self, room);
    if (size == 0) return;
    ForcePacket packet;
    const bool newer = decode(std::span(room).first(size), packet) && packet.seq > state.newest.seq;
    if (newer) state.newest = packet;
    ++(newer ? state.models : state.refused);
  }
}

// The model's force, faded in after every time without one, and out in the second half of its life:
// at the end nothing is left that the guard would let fall slowly.
Vec3 model_force(const StationConfig& config, StationState& state, std::int64_t now_ns) {
  const std::int64_t age_ns = now_ns - state.newest.echo_t_ns;
  if (state.models == 0 || age_ns >= state.newest.life_ns) {
    state.fade_tick = 0;
    ++state.starved;
    return {};
  }
  const float ticks = kFadeInS / config.guard.period_s;
  const float in = std::min(static_cast<float>(++state.fade_tick) / ticks, 1.0F);
  const auto left_ns = static_cast<float>(state.newest.life_ns - age_ns);
  const float out = std::min(2 * left_ns / static_cast<float>(state.newest.life_ns), 1.0F);
  const float share = std::min(in, out);
  const Vec3 force = force_at(state.newest, now_ns, state.sample.pose.position_m);
  return {share * force.x, share * force.y, share * force.z};
}

}  // namespace

StationState station_start(std::uint32_t session) {
  StationState state;
  state.sent.session = session;
  return state;
}

void station_tick(const StationConfig& config, StationState& state, const Device& device,
                  const Link& link, std::int64_t now_ns) {
  const bool answered = device.read(device.self, now_ns, state.sample);
  const bool usable = guard_sample(config.guard, state.guard, answered, state.sample, now_ns);
  take_models(state, link);
  state.force_n = guard_force(config.guard, state.guard, model_force(config, state, now_ns));
  device.write(device.self, {.force_n = state.force_n, .max_force_n = config.guard.max_force_n});
  if (!usable || state.guard.fault != Fault::kNone) return;
  ++state.sent.seq;
  state.sent.t_ns = now_ns;
  state.sent.echo = state.newest.seq;
  state.sent.pose = state.sample.pose;
  state.sent.buttons = state.sample.buttons;
  link.send(link.self, encode(state.sent));
}

}  // namespace stylet::hal
