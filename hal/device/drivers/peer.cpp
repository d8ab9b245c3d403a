// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/peer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include "hal/base/vector.h"
#include "hal/device/devices.h"
#include "hal/device/driver.h"
#include "hal/device/patience.h"

namespace stylet::hal {
namespace {

constexpr std::int64_t kMostTimeNs = std::int64_t{1} << 60;  // 36 years, the most on any clock
constexpr std::uint64_t kMicrosecondsAnArming = 1'000'000 / 16;

// A limit is not trusted: a value that makes no sense counts as not told.
float told(float value, float most, float otherwise) {
  return value > 0 && value <= most ? value : otherwise;
}

// The limits told by the sender of the first sample.
DeviceInfo told_info(const SamplePacket& first, const DeviceInfo& otherwise) {
  const RenderLimits& limits = first.limits;
  DeviceInfo info = otherwise;
  info.max_force_n = told(limits.max_force_n, 100, info.max_force_n);
  info.max_stiffness_n_per_m = told(limits.max_stiffness_n_per_m, 1e6F, 0);
  info.continuous_force_n = told(limits.continuous_force_n, 100, 0);
  info.max_torque_nm = told(limits.max_torque_nm, 10, 0);
  return info;
}

// When the force that a sample has seen was sent, or a time before; 0: unknown.
std::int64_t echo_sent_ns(const PeerDevice& peer, const SamplePacket& packet) {
  const bool known = packet.echo > peer.first_sent && packet.echo <= peer.sent &&
                     peer.sent - packet.echo < kSentKept;
  return known ? peer.sent_ns[packet.echo % kSentKept] : 0;
}

// Whatever the network does, a newer sample is taken later, and after the force it has seen was
// sent: if its time says otherwise, the sender's clock was set.
void follow_clock(PeerDevice& peer, const SamplePacket& packet, std::int64_t now_ns) {
  const std::int64_t offset_ns = now_ns - packet.t_ns;
  peer.offset_ns = std::min(peer.offset_ns, offset_ns);
  const std::int64_t seen_ns = echo_sent_ns(peer, packet);
  const bool early = seen_ns != 0 && packet.t_ns + peer.offset_ns < seen_ns - kClockSlackNs;
  if (peer.doubt_ns == 0 && (early || packet.t_ns < peer.newest.t_ns)) {
    peer.doubt_ns = now_ns;
    peer.doubt_offset_ns = offset_ns;
  } else if (seen_ns != 0 && !early) {
    peer.doubt_ns = 0;
  }
  if (peer.doubt_ns == 0) return;
  peer.doubt_offset_ns = std::min(peer.doubt_offset_ns, offset_ns);
  if (now_ns - peer.doubt_ns < kClockDoubtNs) return;
  peer.offset_ns = peer.doubt_offset_ns;
  peer.doubt_ns = 0;
  peer.clock_sets.fetch_add(1, std::memory_order_relaxed);
}

void count_late(PacketCount& packets) {
  ++packets.late;
  if (packets.lost > 0) --packets.lost;
}

// True if it is the newest sample of the session that counts.
bool accept(PeerDevice& peer, const SamplePacket& packet, std::int64_t now_ns) {
  if (packet.t_ns < -kMostTimeNs || packet.t_ns > kMostTimeNs) return false;
  const bool another = packet.session != peer.newest.session;
  if (peer.heard && another && packet.limits != peer.newest.limits) {
    peer.other_device.store(true, std::memory_order_relaxed);
    return false;
  }
  if (!peer.heard || (another && now_ns - peer.heard_ns > kSilenceNs)) {
    peer.offset_ns = now_ns - packet.t_ns;
    peer.doubt_ns = 0;
    ++peer.seq;
  } else {
    if (!another && packet.seq <= peer.newest.seq) count_late(peer.packets);
    if (another || packet.seq <= peer.newest.seq) return false;
    peer.packets.lost += packet.seq - peer.newest.seq - 1;
    peer.seq += packet.seq - peer.newest.seq;
    follow_clock(peer, packet, now_ns);
  }
  if (packet.echo != 0 && packet.echo != peer.newest.echo) peer.echo_ns = now_ns;
  ++peer.packets.came;
  peer.packets.forces_arrive |= packet.echo > peer.first_sent && packet.echo <= peer.sent;
  peer.heard = true;
  peer.heard_ns = now_ns;
  peer.newest = packet;
  return true;
}

// When the newest sample was taken, in time of our clock.
std::int64_t taken_ns(const PeerDevice& peer) {
  return peer.newest.t_ns + peer.offset_ns;
}

void drain(PeerDevice& peer, std::int64_t now_ns) {
  std::array<std::byte, kMaxPacketBytes> room;
  SamplePacket packet;
  for (int i = 0; i < kMostPerRead; ++i) {
    const std::optional<std::size_t> size = peer.link.receive(peer.link.self, room);
    if (!size) return;
    const auto bytes = std::span(room).first(*size);
    const bool whole = decode(bytes, packet);
    if (!whole && !bytes.empty()) ++peer.packets.useless;
    const bool good = whole && accept(peer, packet, now_ns);
    if (good && peer.link.answer != nullptr) peer.link.answer(peer.link.self);
    const std::uint16_t version = packet_version(bytes);
    if (version != 0 && version != kPacketVersion) peer.other_version = version;
  }
}

bool read(void* self, std::int64_t /*tick_ns*/, Sample& sample_out) {
  PeerDevice& peer = *static_cast<PeerDevice*>(self);
  const std::int64_t now_ns = peer.clock.now_ns(peer.clock.self);
  peer.offset_ns += (now_ns - peer.looked_ns) / kDriftPart;
  peer.looked_ns = now_ns;
  drain(peer, now_ns);
  if (!peer.heard || now_ns - peer.heard_ns > kQuietNs) return false;
  sample_out = {peer.seq, std::min(taken_ns(peer), now_ns), peer.newest.pose, peer.newest.buttons};
  return true;
}

// The force that the hand has there. It is not trusted: more than the device renders is ignored.
Vec3 felt_force(const PeerDevice& peer) {
  const Vec3 told = peer.newest.force_n;
  const bool tells =
      peer.newest.arming != 0 && dot(told, told) <= peer.info.max_force_n * peer.info.max_force_n;
  return tells ? told : force_at(peer.model, peer.newest.pose.position_m);
}

// A force ends by itself if the sample it answers is too old, or if no packet of ours arrives: the
// newest echo tells which have arrived. A device that never echoes does not tell.
bool motor(void* self, MotorReport& report_out) {
  const PeerDevice& peer = *static_cast<const PeerDevice*>(self);
  if (!peer.heard || peer.sent == peer.first_sent) return false;
  const bool silent = peer.looked_ns - taken_ns(peer) > kForceLifeNs;
  const bool deaf = peer.echo_ns != 0 && peer.looked_ns - peer.echo_ns > kForceLifeNs;
  const bool ended =
      peer.newest.stopped != 0 && peer.newest.arming == peer.arming_base + peer.given.arming;
  report_out = {felt_force(peer), peer.given.torque_nm, peer.given.arming, silent || deaf || ended,
                peer.looked_ns - peer.heard_ns > kForceLifeNs};
  if (report_out.stopped) report_out.force_n = report_out.torque_nm = {};
  return true;
}

bool is_none(Vec3 v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}

// The last forces of a fade end with the fade, even if the network fails meanwhile; and no force
// lives longer than ordered.
std::int64_t life_of(PeerDevice& peer, const Command& command) {
  if (!command.falls) peer.falls_ns = 0;
  if (command.falls && peer.falls_ns == 0) peer.falls_ns = peer.looked_ns;
  if (is_none(command.force_n) && is_none(command.torque_nm)) return kForceLifeNs;
  std::int64_t left_ns = kForceLifeNs;
  if (command.falls) left_ns = std::min(left_ns, peer.falls_ns + kGoneNs - taken_ns(peer));
  if (command.end_ns != 0) left_ns = std::min(left_ns, command.end_ns - taken_ns(peer));
  return std::max<std::int64_t>(left_ns, 0);
}

void write(void* self, const Command& command) {
  PeerDevice& peer = *static_cast<PeerDevice*>(self);
  if (!peer.heard) return;
  ForcePacket packet;
  packet.seq = ++peer.sent;
  peer.sent_ns[packet.seq % kSentKept] = peer.looked_ns;
  packet.echo = peer.newest.seq;
  packet.echo_t_ns = peer.newest.t_ns;
  packet.life_ns = life_of(peer, command);
  packet.arming = peer.arming_base + command.arming;
  packet.model.force_n = command.force_n;
  packet.model.torque_nm = command.torque_nm;
  packet.model.at_m = command.place_m;
  for (std::size_t i : {0U, 4U, 8U}) packet.model.stiffness_n_per_m[i] = command.stiffness_n_per_m;
  packet.model.radius_m = kModelRadiusM;
  packet.model.max_force_n = command.max_force_n;
  peer.given = command;
  peer.model = packet.model;
  peer.link.send(peer.link.self, encode(packet));
}

void close(void* self) {
  PeerDevice& peer = *static_cast<PeerDevice*>(self);
  write(self, {.force_n = {}, .place_m = peer.given.place_m, .arming = peer.given.arming});
  peer.link.close(peer.link.self);
}

void close_and_free(void* self) {
  close(self);
  delete static_cast<PeerDevice*>(self);
}

std::string trouble(void* self) {
  const PeerDevice& peer = *static_cast<const PeerDevice*>(self);
  if (peer.link.trouble != nullptr) {
    if (std::string lost = peer.link.trouble(peer.link.self); !lost.empty()) return lost;
  }
  if (!peer.other_device.load(std::memory_order_relaxed)) return "";
  return "another device, with other limits, wants to take the place of the first: end the run and "
         "start it again";
}

std::string note(void* self) {
  const std::uint32_t sets =
      static_cast<const PeerDevice*>(self)->clock_sets.load(std::memory_order_relaxed);
  if (sets == 0) return "";
  return fmt::format(
      "the clock of its samples was set ({} time{}): their times are matched to ours again", sets,
      sets == 1 ? "" : "s");
}

// Why no device has come, and what to do.
std::string nobody(const PeerDevice& peer, double patience_s) {
  if (peer.other_version == 0) {
    return fmt::format("no sample came in {:g} s: start the program that sends them", patience_s);
  }
  return fmt::format(
      "packets of version {} came: expected version {}: bring both sides to one "
      "version",
      peer.other_version, kPacketVersion);
}

Device wait_for_peer(const Link& link, const std::string& uri, double patience_s) {
  auto peer = std::make_unique<PeerDevice>();
  peer->link = link;
  peer->sent = static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch() /
                                          std::chrono::microseconds(1));
  peer->first_sent = peer->sent;
  // Derived from the time of day as well; nobody acknowledges more often than this.
  peer->arming_base = static_cast<std::uint32_t>(peer->sent / kMicrosecondsAnArming);
  const Patience patience(patience_s);
  for (Sample sample; !read(peer.get(), 0, sample);) {
    if (patience.over()) {
      link.close(link.self);
      throw DeviceError(fmt::format("{}: {}", uri, nobody(*peer, patience_s)));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  peer->info = told_info(peer->newest, peer->info);
  return peer_device(*peer.release(), true);
}

}  // namespace

Device peer_device(PeerDevice& peer, bool close_frees) {
  Device device = {&peer, peer.info, read, write, close_frees ? close_and_free : close, trouble};
  device.motor = motor;
  device.note = note;
  device.packets = [](void* self) { return static_cast<const PeerDevice*>(self)->packets; };
  return device;
}

Device open_udp(const std::string& rest, double patience_s) {
  return wait_for_peer(udp_listen(rest), "udp:" + rest, patience_s);
}

// Shared memory keeps only the newest sample: one that was replaced before it was read is not lost.
Device open_shared_memory(const std::string& rest, double patience_s) {
  Device device = wait_for_peer(shared_memory(rest, Side::kStylet), "shm:" + rest, patience_s);
  device.packets = nullptr;
  return device;
}

namespace {

void search(const HostTree&, DeviceSighting& out) {
  out.presence = Presence::kUnknown;
  out.seen = "shows itself only when it is opened";
}

}  // namespace

constinit const DriverDescriptor udp_driver = {
    .scheme = "udp",
    .uri = "udp:7755",
    .name = "another program, over the network",
    .open = open_udp,
    .search = search,
    .row = {"`udp:PORT`, `udp:ADDRESS:PORT`", "another program, another machine", "6 / as it says",
            "a program that speaks in packets; `udp:PORT` listens to this machine only"},
};

constinit const DriverDescriptor shm_driver = {
    .scheme = "shm",
    .uri = "shm:NAME",
    .name = "another program, through shared memory",
    .open = open_shared_memory,
    .search = search,
    .row = {"`shm:NAME`", "another program here", "6 / as it says",
            "the same packets in `/dev/shm/stylet.NAME`"},
};

}  // namespace stylet::hal
