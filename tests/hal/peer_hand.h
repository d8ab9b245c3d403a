// SPDX-License-Identifier: Apache-2.0
// Programs at the other end of a link, for sessions in virtual time: one that keeps the rules of
// hal/device/packets.md, and a station with a device of its own; and the disturbances between them
// and Stylet.
#pragma once

#include <algorithm>
#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "hal/base/clock.h"
#include "hal/device/devices.h"
#include "hal/device/link.h"
#include "hal/device/packet.h"
#include "hal/loop/loop.h"
#include "hal/loop/station.h"
#include "motor_draw.h"

namespace stylet::hal {

// A network that loses, delays and reorders packets, and stands still at times.
struct Weather {
  Link inner;
  Draw draw{0};
  double loss = 0;
  std::int64_t delay_ns = 0, jitter_ns = 0;
  Stalls stalls;
  using Packet = std::pair<std::int64_t, std::vector<std::byte>>;  // when it is due
  std::vector<Packet> going, coming;

  std::int64_t due() {
    const std::int64_t now_ns = monotonic_now_ns();
    const std::int64_t from_ns = stalls.busy(draw, now_ns) ? stalls.until_ns : now_ns;
    return from_ns + delay_ns +
           static_cast<std::int64_t>(draw.unit() * static_cast<double>(jitter_ns));
  }
  void put(std::vector<Packet>& way, std::span<const std::byte> bytes) {
    if (!draw.chance(loss)) way.push_back({due(), {bytes.begin(), bytes.end()}});
  }
  template <typename Give>
  static void deliver(std::vector<Packet>& way, std::size_t most, Give give) {
    const std::int64_t now_ns = monotonic_now_ns();
    for (std::size_t i = 0; i < way.size() && most > 0;) {
      if (way[i].first > now_ns) {
        ++i;
        continue;
      }
      give(way[i].second);
      way.erase(way.begin() + static_cast<std::ptrdiff_t>(i));
      --most;
    }
  }
  void flush() {
    deliver(going, going.size(), [this](const auto& bytes) { inner.send(inner.self, bytes); });
  }
  std::optional<std::size_t> receive(std::span<std::byte> room) {
    flush();
    while (const auto got = inner.receive(inner.self, room)) put(coming, room.first(*got));
    std::optional<std::size_t> size;
    deliver(coming, 1, [&](const auto& bytes) {
      std::copy(bytes.begin(), bytes.end(), room.begin());
      size = bytes.size();
    });
    return size;
  }
  Link link() {
    return {this,
            [](void* self, std::span<const std::byte> packet) {
              Weather& weather = *static_cast<Weather*>(self);
              weather.put(weather.going, packet);
            },
            [](void* self, std::span<std::byte> room) {
              return static_cast<Weather*>(self)->receive(room);
            },
            nullptr, [](void*) {}};
  }
};

// The four rules of packets.md.
class PeerHand {
 public:
  static constexpr float kMostN = 3;
  static constexpr float kSlewNPerS = 1000;

  PeerHand(Weather weather, Stalls own, double silence)
      : weather_(std::move(weather)), own_(own), silence_(silence), thread_([this] { run(); }) {}
  ~PeerHand() {
    stop_ = true;
    thread_.join();
    weather_.inner.close(weather_.inner.self);
  }
  PeerHand(const PeerHand&) = delete;
  PeerHand& operator=(const PeerHand&) = delete;

  std::atomic<bool> begun{false};  // stalls may come
  Pose pose = {{}, {1, 0, 0, 0}};
  Vec3 force_n = {};
  int steps = 0;
  bool strange_place = false;

 private:
  void run() {
    const Clock clock = monotonic_clock();
    for (std::int64_t next_ns = clock.now_ns(clock.self); !stop_; next_ns += kMs) {
      next_ns = std::max(next_ns, clock.now_ns(clock.self));
      clock.sleep_until_ns(clock.self, next_ns);
      if (begun && own_.busy(weather_.draw, next_ns))
        clock.sleep_until_ns(clock.self, own_.until_ns);
      tick(clock.now_ns(clock.self));
    }
  }

  void tick(std::int64_t now_ns) {
    const Link link = weather_.link();
    std::array<std::byte, kMaxPacketBytes> room;
    ForcePacket packet;
    while (const auto got = link.receive(link.self, room)) {
      if (!decode(std::span(room).first(*got), packet)) continue;
      // Hands of these sessions move along one axis, except in samples that must not be used.
      const Vec3 place = packet.model.at_m;
      strange_place |= place.x != 0 || place.y != 0 || !std::isfinite(place.z);
      (void)obey(obeyed_, packet, now_ns);
    }
    step(now_ns);
    if (now_ns < silent_until_ns_) return;
    if (weather_.draw.chance(silence_)) silent_until_ns_ = now_ns + weather_.draw.ms(5, 60);
    ++sample_.seq;
    sample_.session = 77;
    sample_.limits = {.max_force_n = kMostN, .max_stiffness_n_per_m = 2000};
    sample_.t_ns = now_ns;
    sample_.pose = pose;
    sample_.echo = obeyed_.newest.seq;
    sample_.arming = obeyed_.newest.arming;
    sample_.stopped = obeyed_.stopped ? 1 : 0;
    sample_.force_n = force_n;
    link.send(link.self, encode(sample_));
    weather_.flush();
  }

  void step(std::int64_t now_ns) {
    const std::int64_t passed_ns = stepped_ns_ == 0 ? 0 : now_ns - stepped_ns_;
    stepped_ns_ = now_ns;
    ++steps;
    if (passed_ns > 10 * kMs) {
      obeyed_.stopped = obeyed_.newest.life_ns != 0;
      force_n = {};
    }
    const float share = obeyed_fraction(obeyed_, now_ns);
    const Vec3 whole = force_at(obeyed_.newest.model, pose.position_m);
    const double size_n = size(whole);
    const float scale =
        size_n > static_cast<double>(kMostN) ? share * kMostN / static_cast<float>(size_n) : share;
    const Vec3 goal = {scale * whole.x, scale * whole.y, scale * whole.z};
    const Vec3 way = {goal.x - force_n.x, goal.y - force_n.y, goal.z - force_n.z};
    const double most = static_cast<double>(kSlewNPerS) * 1e-9 * static_cast<double>(passed_ns);
    const auto part = static_cast<float>(size(way) > most ? most / size(way) : 1.0);
    force_n = {force_n.x + part * way.x, force_n.y + part * way.y, force_n.z + part * way.z};
  }

  Weather weather_;
  Stalls own_;
  double silence_;
  std::int64_t stepped_ns_ = 0, silent_until_ns_ = 0;
  SamplePacket sample_;
  ObeyedForce obeyed_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// `stylet station` with a device of its own.
class StationHand {
 public:
  StationHand(Weather weather, Stalls own, const Device& device)
      : weather_(std::move(weather)), own_(own), device_(device), thread_([this] { run(); }) {}
  ~StationHand() {
    stop_ = true;
    thread_.join();
    weather_.inner.close(weather_.inner.self);
    device_.close(device_.self);
  }
  StationHand(const StationHand&) = delete;
  StationHand& operator=(const StationHand&) = delete;

  std::atomic<bool> begun{false};        // stalls may come
  std::atomic<bool> acknowledges{true};  // somebody acknowledges its faults
  StationState state = station_start(5);

 private:
  void run() {
    const Clock clock = monotonic_clock();
    StationConfig config = station_config(device_.info);
    config.guard.ramp_s = 0;
    config.guard.max_speed_m_per_s = 1e3F;
    config.guard.stored_energy_j = 1e6F;
    std::int64_t next_ns = clock.now_ns(clock.self);
    while (!stop_) {
      next_ns = std::max(next_ns, clock.now_ns(clock.self) - kMs) + kMs;
      clock.sleep_until_ns(clock.self, next_ns);
      if (begun && own_.busy(weather_.draw, next_ns))
        clock.sleep_until_ns(clock.self, own_.until_ns);
      guard_late(state.guard, clock.now_ns(clock.self) - next_ns);
      station_tick(config, state, device_, weather_.link(), next_ns);
      weather_.flush();
      if (acknowledges && weather_.draw.chance(0.02)) {
        (void)guard_rearm(state.guard, state.guard.fault);
      }
    }
    for (bool gone = false; !gone; next_ns += kMs) {
      clock.sleep_until_ns(clock.self, next_ns);
      gone = station_end(config, state, device_, next_ns);
    }
  }

  Weather weather_;
  Stalls own_;
  Device device_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace stylet::hal
