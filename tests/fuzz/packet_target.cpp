// SPDX-License-Identifier: Apache-2.0
// Any bytes where packets are expected: from a device over `udp:` and `shm:`, and from Stylet at a
// station. Whatever comes, and whenever it comes: the numbers of accepted packets count up, the
// force that is given is finite and within its limit, and every packet that is sent is valid and
// lives no longer than allowed.
//
// The first byte chooses who listens. Then each step is a tick, a wait, raw bytes, or a good packet
// with changed bytes and a correct checksum: with a wrong one it would get no further than the
// check.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "hal/device/devices.h"
#include "hal/device/drivers/peer.h"
#include "hal/device/link.h"
#include "hal/device/packet.h"
#include "hal/guard/guard.h"
#include "hal/loop/station.h"
#include "target.h"

namespace stylet::test {
namespace {

using namespace stylet::hal;  // NOLINT(google-build-using-namespace): all of it is about the hal

constexpr std::int64_t kMs = 1'000'000;
constexpr float kMostN = 3;

float size_of(Vec3 v) {
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

void promise_force(Vec3 force, float most, const char* what) {
  promise(std::isfinite(size_of(force)) && size_of(force) <= most * 1.0001F, what);
}

// ==== Both ends of a link, made once

struct Ends {
  Link ours;
  Link theirs;
};

// The first port that is free.
Ends udp_ends() {
  for (int port = 20000 + getpid() % 20000;; ++port) {
    try {
      const std::string where = "127.0.0.1:" + std::to_string(port);
      const Link ours = udp_listen(where);
      return {ours, udp_connect(where)};
    } catch (const DeviceError&) {
      promise(port < 60000, "no port is free");
    }
  }
}

Ends memory_ends() {
  const std::string name = "fuzz" + std::to_string(getpid());
  const Link ours = shared_memory(name, Side::kStylet);
  const Ends ends = {ours, shared_memory(name, Side::kDevice)};
  (void)unlink(("/dev/shm/stylet." + name).c_str());  // both have it open
  return ends;
}

Ends& ends_of(bool udp) {
  static std::array<Ends, 2> all = {memory_ends(), udp_ends()};
  return all[udp ? 1 : 0];
}

std::optional<std::vector<std::byte>> received(const Link& link) {
  std::array<std::byte, kMaxPacketBytes> room;
  const std::optional<std::size_t> size = link.receive(link.self, room);
  if (!size) return std::nullopt;
  return std::vector<std::byte>(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(*size));
}

// ==== What comes

// At most as large as a slot of shared memory.
std::vector<std::byte> raw(Bytes& bytes) {
  std::vector<std::byte> packet(1 + bytes.byte() % kMaxPacketBytes);
  for (std::byte& each : packet) each = static_cast<std::byte>(bytes.byte());
  return packet;
}

template <std::size_t kBytes>
std::vector<std::byte> changed(std::array<std::byte, kBytes> good, Bytes& bytes) {
  for (int i = bytes.byte() % 8; i > 0; --i) {
    const std::size_t at = bytes.byte() % kBytes;
    good[at] = static_cast<std::byte>(bytes.byte());
  }
  constexpr std::size_t kBody = kBytes - sizeof(std::uint32_t);
  const auto crc =
      static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(good.data()), kBody));
  std::memcpy(good.data() + kBody, &crc, sizeof crc);
  return {good.begin(), good.end()};
}

// ==== Stylet's side: a device at the other end, with its guard

struct Listening {
  Bytes& bytes;
  Ends& ends;
  std::int64_t now_ns = 1000 * kMs;
  PeerDevice peer;
  Device device = {};
  GuardConfig config;
  GuardState guard = guard_start(), torque_guard = guard_start();
  Sample sample = {};
  std::uint64_t last_seq = 0;
  SamplePacket good;

  Listening(Bytes& all, bool udp) : bytes(all), ends(ends_of(udp)) {
    while (received(ends.ours) || received(ends.theirs)) {
    }
    peer.link = ends.ours;
    peer.clock = {this, [](void* self) { return static_cast<Listening*>(self)->now_ns; }, nullptr};
    peer.looked_ns = now_ns;
    device = peer_device(peer);
    config.max_force_n = kMostN;
    config.ramp_s = 0;
    config.watchdog_s = watchdog_of(device.info, 3e-3F);
    good.session = 7;
  }

  void come() {
    ++good.seq;
    good.t_ns = now_ns - 500 * kMs;
    good.echo = peer.sent;
    good.arming = peer.arming_base + peer.given.arming;
    const std::vector<std::byte> packet = changed(encode(good), bytes);
    ends.theirs.send(ends.theirs.self, packet);
  }

  void tick() {
    now_ns += kMs;
    MotorReport motor;
    if (device.motor(device.self, motor)) guard_motor(guard, motor);
    const bool answered = device.read(device.self, now_ns, sample);
    promise(!answered || (sample.seq >= last_seq && sample.t_ns <= now_ns), "a sample goes back");
    last_seq = sample.seq;
    (void)guard_sample(config, guard, answered, sample, now_ns);
    if (guard.fault != Fault::kNone && bytes.byte() % 4 == 0) (void)guard_rearm(guard, guard.fault);
    promise_force(guard_force(config, guard, {bytes.small(), bytes.small(), bytes.any_float()}),
                  kMostN, "the guard lets too much through");
    const Command command = guard_command(config, guard, torque_guard);
    device.write(device.self, command);
    (void)trouble_of(device);
    (void)note_of(device);
    while (const auto sent = received(ends.theirs)) {
      ForcePacket force;
      promise(decode(*sent, force), "what is sent is not a packet");
      promise_force(force.model.force_n, kMostN, "what is sent is not a force");
      promise(std::isfinite(size_of(force.model.at_m)), "a force is nowhere");
      promise(force.life_ns >= 0 && force.life_ns <= kForceLifeNs, "a force lives too long");
    }
  }
  void send(const std::vector<std::byte>& packet) { ends.theirs.send(ends.theirs.self, packet); }
};

// ==== A station, with a device that moves

struct AtStation {
  Bytes& bytes;
  std::int64_t now_ns = 1000 * kMs;
  std::vector<std::vector<std::byte>> coming;
  StationConfig config;
  StationState state = station_start(7);
  ForcePacket good;
  Device device = {};
  Link link = {};
  std::uint64_t seq = 0;

  explicit AtStation(Bytes& all) : bytes(all) {
    device = {this,
              {.name = "one", .max_force_n = kMostN, .max_slew_n_per_s = 1000, .max_torque_nm = 1},
              [](void* self, std::int64_t at_ns, Sample& out) {
                AtStation& s = *static_cast<AtStation*>(self);
                out = {++s.seq, at_ns, {{0, 0, 1e-5F * s.bytes.small()}, {1, 0, 0, 0}}, 0};
                return s.bytes.byte() % 16 != 1;
              },
              [](void* self, const Command& command) {
                const AtStation& s = *static_cast<AtStation*>(self);
                promise_force(command.force_n, s.config.guard.max_force_n,
                              "the station lets too much through");
                promise_force(command.torque_nm, s.config.max_torque_nm, "too much torque");
              },
              nullptr};
    link = {this,
            [](void*, std::span<const std::byte> packet) {
              SamplePacket sample;
              promise(decode(packet, sample), "a station sends no packet");
            },
            [](void* self, std::span<std::byte> room) -> std::optional<std::size_t> {
              auto& queue = static_cast<AtStation*>(self)->coming;
              if (queue.empty()) return std::nullopt;
              const std::vector<std::byte> first = queue.front();
              queue.erase(queue.begin());
              std::copy(first.begin(), first.end(), room.begin());
              return first.size();
            },
            nullptr, nullptr};
    config = station_config(device.info);
    good.model = {{0, 0, 2}, {}, {}, {1000, 0, 0, 0, 1000, 0, 0, 0, 1000}, 0.02F, kMostN};
    good.life_ns = kForceLifeNs;
    good.arming = 1;
  }

  void come() {
    ++good.seq;
    good.echo = state.sent.seq;
    good.echo_t_ns = state.sent.t_ns;
    send(changed(encode(good), bytes));
  }
  void tick() {
    now_ns += kMs;
    station_tick(config, state, device, link, now_ns);
    if (state.guard.fault != Fault::kNone && bytes.byte() % 4 == 0) {
      (void)guard_rearm(state.guard, state.guard.fault);
    }
  }
  void send(const std::vector<std::byte>& packet) { coming.push_back(packet); }
};

template <typename Side>
void run(Side& side, Bytes& bytes) {
  while (!bytes.empty()) {
    switch (bytes.byte() % 8) {
      case 0:
        side.send(raw(bytes));
        break;
      case 1:
        side.now_ns += kMs * bytes.byte();
        break;
      case 2:
      case 3:
        side.come();
        break;
      default:
        side.come();
        side.tick();
    }
  }
  side.tick();
}

}  // namespace
}  // namespace stylet::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet::test;
  Bytes bytes{{data, size}};
  const int who = bytes.byte() % 3;
  if (who == 2) {
    AtStation station(bytes);
    run(station, bytes);
    return 0;
  }
  const auto listening = std::make_unique<Listening>(bytes, who == 1);
  run(*listening, bytes);
  return 0;
}
