// SPDX-License-Identifier: Apache-2.0
#include "hal/device/packet.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "hal/base/crc32.h"
#include "hal/base/vector.h"
#include "hal/device/motor.h"

namespace stylet::hal {
namespace {

static_assert(std::endian::native == std::endian::little, "packets are copied as they lie");

constexpr std::array kSampleMagic = {'S', 'T', 'Y', 'S'};
constexpr std::array kForceMagic = {'S', 'T', 'Y', 'F'};
constexpr std::size_t kCrcBytes = sizeof(std::uint32_t);

// One order of fields, for writing and for reading.
template <typename Visit>
void fields(SamplePacket& p, Visit&& visit) {
  visit(p.session);
  visit(p.buttons);
  visit(p.seq);
  visit(p.t_ns);
  visit(p.echo);
  visit(p.pose);
  visit(p.limits);
  visit(p.arming);
  visit(p.stopped);
  visit(p.force_n);
}
template <typename Visit>
void fields(ForcePacket& p, Visit&& visit) {
  visit(p.seq);
  visit(p.echo);
  visit(p.echo_t_ns);
  visit(p.life_ns);
  visit(p.model);
  visit(p.arming);
}
static_assert(sizeof(Pose) == 28 && sizeof(RenderLimits) == 16 && sizeof(ForceModel) == 80,
              "no padding in a packet");

template <std::size_t kBytes, typename Packet>
std::array<std::byte, kBytes> encoded(Packet packet, const std::array<char, 4>& magic) {
  std::array<std::byte, kBytes> bytes = {};
  std::size_t at = 0;
  const auto put = [&](const auto& value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
    at += sizeof value;
  };
  put(magic);
  put(kPacketVersion);
  put(static_cast<std::uint16_t>(kBytes));
  fields(packet, put);
  put(crc32_of(std::span(bytes).first(kBytes - kCrcBytes)));
  return bytes;
}

template <std::size_t kBytes, typename Packet>
bool decoded(std::span<const std::byte> bytes, const std::array<char, 4>& magic, Packet& out) {
  if (bytes.size() != kBytes) return false;
  std::size_t at = 0;
  const auto get = [&](auto& value) {
    std::memcpy(&value, bytes.data() + at, sizeof value);
    at += sizeof value;
  };
  std::array<char, 4> seen = {};
  std::uint16_t version = 0, size = 0;
  get(seen);
  get(version);
  get(size);
  if (seen != magic || version != kPacketVersion || size != kBytes) return false;
  Packet packet;
  fields(packet, get);
  std::uint32_t crc = 0;
  get(crc);
  if (crc != crc32_of(bytes.first(kBytes - kCrcBytes))) return false;
  out = packet;
  return true;
}

// Written so that NaN gives no force.
bool near(const ForceModel& model, Vec3 away_m) {
  return model.radius_m == 0 || length(away_m) <= model.radius_m;
}

// Works for any two times, however far apart.
std::uint64_t age_ns(const ForcePacket& packet, std::int64_t now_ns) {
  return static_cast<std::uint64_t>(now_ns) - static_cast<std::uint64_t>(packet.echo_t_ns);
}

bool lives(const ForcePacket& packet, std::int64_t now_ns) {
  return packet.echo_t_ns <= now_ns && packet.life_ns > 0 &&
         age_ns(packet, now_ns) < static_cast<std::uint64_t>(packet.life_ns);
}

}  // namespace

Vec3 force_at(const ForceModel& model, Vec3 position_m) {
  const Vec3 away = position_m - model.at_m;
  if (!near(model, away)) return {};
  const auto& k = model.stiffness_n_per_m;
  const Vec3 spring = {dot({k[0], k[1], k[2]}, away), dot({k[3], k[4], k[5]}, away),
                       dot({k[6], k[7], k[8]}, away)};
  const Vec3 force = model.force_n - spring;
  const float size = length(force);
  if (size <= model.max_force_n) return force;
  if (!(std::isfinite(size) && model.max_force_n > 0)) return {};
  return model.max_force_n / size * force;
}

Vec3 force_at(const ForcePacket& packet, std::int64_t now_ns, Vec3 position_m) {
  return lives(packet, now_ns) ? force_at(packet.model, position_m) : Vec3{};
}

Vec3 torque_at(const ForcePacket& packet, std::int64_t now_ns, Vec3 position_m) {
  const ForceModel& model = packet.model;
  const bool felt = lives(packet, now_ns) && near(model, position_m - model.at_m) &&
                    std::isfinite(length(model.torque_nm));
  return felt ? model.torque_nm : Vec3{};
}

bool obey(ObeyedForce& obeyed, const ForcePacket& packet, std::int64_t now_ns) {
  const bool first = obeyed.newest.life_ns == 0;
  const bool older = !first && (packet.seq <= obeyed.newest.seq ||
                                is_newer_arming(obeyed.newest.arming, packet.arming));
  // A force answers a sample that was taken, and lives no longer than forces may.
  if (older || packet.life_ns > kForceLifeNs || !lives(packet, now_ns)) return false;
  (void)obeyed_fraction(obeyed, now_ns);  // a force that has ended stays ended, whatever comes now
  if (first || packet.arming != obeyed.newest.arming) obeyed.stopped = false;
  obeyed.newest = packet;
  return true;
}

float obeyed_fraction(ObeyedForce& obeyed, std::int64_t now_ns) {
  const ForcePacket& newest = obeyed.newest;
  if (newest.life_ns == 0) return 0;
  if (!lives(newest, now_ns)) obeyed.stopped = true;
  if (obeyed.stopped) return 0;
  const auto left_ns = static_cast<float>(newest.life_ns - (now_ns - newest.echo_t_ns));
  return std::min(1.0F, 2 * left_ns / static_cast<float>(newest.life_ns));
}

std::array<std::byte, kSamplePacketBytes> encode(const SamplePacket& packet) {
  return encoded<kSamplePacketBytes>(packet, kSampleMagic);
}
std::array<std::byte, kForcePacketBytes> encode(const ForcePacket& packet) {
  return encoded<kForcePacketBytes>(packet, kForceMagic);
}
std::uint16_t packet_version(std::span<const std::byte> bytes) {
  std::array<char, 4> magic = {};
  std::uint16_t version = 0;
  if (bytes.size() < sizeof magic + sizeof version) return 0;
  std::memcpy(magic.data(), bytes.data(), sizeof magic);
  std::memcpy(&version, bytes.data() + sizeof magic, sizeof version);
  return magic == kSampleMagic || magic == kForceMagic ? version : 0;
}

bool decode(std::span<const std::byte> bytes, SamplePacket& out) {
  return decoded<kSamplePacketBytes>(bytes, kSampleMagic, out);
}
bool decode(std::span<const std::byte> bytes, ForcePacket& out) {
  return decoded<kForcePacketBytes>(bytes, kForceMagic, out);
}

}  // namespace stylet::hal
