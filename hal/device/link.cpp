// SPDX-License-Identifier: Apache-2.0
#include "hal/device/link.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>

#include "hal/base/clock.h"
#include "hal/base/lasting_pages.h"
#include "hal/device/devices.h"
#include "hal/device/packet.h"

namespace stylet::hal {
namespace {

// ==== UDP

// The same time after which the session of a silent peer is given up (drivers/peer.h).
constexpr std::int64_t kPeerSilenceNs = 100'000'000;

struct Udp {
  int socket = -1;
  sockaddr_in peer = {};
  sockaddr_in speaker = {};   // who sent the packet received last
  std::int64_t heard_ns = 0;  // when the peer was heard last
  std::atomic<bool> refused{false};
};

sockaddr_in parse_address(const std::string& where, const std::string& scheme, bool needs_address) {
  const std::size_t colon = where.rfind(':');
  const std::string address =
      colon == std::string::npos ? (needs_address ? "" : "127.0.0.1") : where.substr(0, colon);
  const std::string port = colon == std::string::npos ? where : where.substr(colon + 1);
  sockaddr_in result = {};
  result.sin_family = AF_INET;
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (inet_pton(AF_INET, address.c_str(), &result.sin_addr) != 1 || error != std::errc() ||
      end != port.data() + port.size() || number == 0) {
    throw DeviceError(fmt::format(
        "{}:{}: expected {}", scheme, where,
        needs_address ? "ADDRESS:PORT, as 192.168.0.5:7755" : "a port, as 7755, or ADDRESS:PORT"));
  }
  result.sin_port = htons(number);
  return result;
}

// The answer to an earlier packet is reported by the next call, whichever that is.
void note_refused(Udp& udp, ssize_t result) {
  if (result < 0 && errno == ECONNREFUSED) udp.refused.store(true, std::memory_order_relaxed);
}

void udp_send(void* self, std::span<const std::byte> packet) {
  Udp& udp = *static_cast<Udp*>(self);
  if (udp.peer.sin_port == 0) return;
  // A packet that cannot be sent counts as lost.
  const ssize_t sent = sendto(udp.socket, packet.data(), packet.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                              reinterpret_cast<const sockaddr*>(&udp.peer), sizeof udp.peer);
  note_refused(udp, sent);
}

std::optional<std::size_t> udp_receive(void* self, std::span<std::byte> room) {
  Udp& udp = *static_cast<Udp*>(self);
  sockaddr_in from = {};
  socklen_t size = sizeof from;
  const ssize_t got = recvfrom(udp.socket, room.data(), room.size(), MSG_DONTWAIT,
                               reinterpret_cast<sockaddr*>(&from), &size);
  const bool nothing = got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
  if (nothing) return std::nullopt;
  note_refused(udp, got);
  if (got <= 0) return 0;  // empty, or the error of an earlier send, reported here
  udp.refused.store(false, std::memory_order_relaxed);
  // Only one peer is served, until nothing has come from it for a while.
  const bool peer =
      from.sin_addr.s_addr == udp.peer.sin_addr.s_addr && from.sin_port == udp.peer.sin_port;
  const std::int64_t now_ns = monotonic_now_ns();
  if (!peer && udp.peer.sin_port != 0 && now_ns - udp.heard_ns < kPeerSilenceNs) return 0;
  if (peer) udp.heard_ns = now_ns;
  udp.speaker = from;
  return static_cast<std::size_t>(got);
}

void udp_answer(void* self) {
  Udp& udp = *static_cast<Udp*>(self);
  udp.peer = udp.speaker;
  udp.heard_ns = monotonic_now_ns();
}

void udp_close(void* self) {
  const std::unique_ptr<Udp> udp(static_cast<Udp*>(self));
  ::close(udp->socket);
}

std::string udp_trouble(void* self) {
  const bool refused = static_cast<const Udp*>(self)->refused.load(std::memory_order_relaxed);
  return refused ? "no program listens there: start it, or correct the port" : "";
}

Link udp_link(std::unique_ptr<Udp> udp) {
  return {udp.release(), udp_send, udp_receive, udp_answer, udp_close};
}

int udp_socket(const std::string& scheme) {
  const int made = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (made < 0) throw DeviceError(fmt::format("{}: no socket: {}", scheme, std::strerror(errno)));
  return made;
}

// ==== Shared memory

// A slot holds the newest packet. If it is read while it is being written its checksum fails, and
// it is read again in the next tick.
constexpr std::size_t kSlotWords = kMaxPacketBytes / sizeof(std::uint64_t);
using Slot = std::array<std::atomic<std::uint64_t>, kSlotWords>;
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
static_assert(kSamplePacketBytes <= kMaxPacketBytes && kForcePacketBytes <= kMaxPacketBytes);

struct Shared {
  Slot from_device;
  Slot from_stylet;
};

struct PacketMemory {
  Shared* shared = nullptr;
  Side side = Side::kStylet;
  std::string path;
  int file = -1;  // Stylet's side: locked for as long as the file is open
  std::array<std::byte, kMaxPacketBytes> last = {};
};

void memory_send(void* self, std::span<const std::byte> packet) {
  PacketMemory& memory = *static_cast<PacketMemory*>(self);
  Slot& slot =
      memory.side == Side::kStylet ? memory.shared->from_stylet : memory.shared->from_device;
  std::array<std::uint64_t, kSlotWords> words = {};
  std::memcpy(words.data(), packet.data(), packet.size());
  for (std::size_t i = 0; i < kSlotWords; ++i) slot[i].store(words[i], std::memory_order_relaxed);
}

std::optional<std::size_t> memory_receive(void* self, std::span<std::byte> room) {
  PacketMemory& memory = *static_cast<PacketMemory*>(self);
  const bool stylet = memory.side == Side::kStylet;
  const Slot& slot = stylet ? memory.shared->from_device : memory.shared->from_stylet;
  std::array<std::uint64_t, kSlotWords> words = {};
  for (std::size_t i = 0; i < kSlotWords; ++i) words[i] = slot[i].load(std::memory_order_relaxed);
  std::array<std::byte, kMaxPacketBytes> packet;
  std::memcpy(packet.data(), words.data(), packet.size());
  if (packet == memory.last) return std::nullopt;
  memory.last = packet;
  const std::size_t size = stylet ? kSamplePacketBytes : kForcePacketBytes;
  if (room.size() < size) return 0;
  std::memcpy(room.data(), packet.data(), size);
  return size;
}

void memory_close(void* self) {
  const std::unique_ptr<PacketMemory> memory(static_cast<PacketMemory*>(self));
  unmap_lasting(memory->shared, sizeof(Shared));
  if (memory->side == Side::kStylet) unlink(memory->path.c_str());  // while the lock is ours
  ::close(memory->file);
}

std::string memory_trouble(void* self) {
  const PacketMemory& memory = *static_cast<const PacketMemory*>(self);
  struct stat there = {};
  const bool whole = fstat(memory.file, &there) == 0 && there.st_size >= off_t{sizeof(Shared)};
  if (whole) return "";
  return fmt::format("another program has shortened {}: end the run and start it again",
                     memory.path);
}

// Negative: errno says why. The file of a killed run is taken over, as its lock went with the run.
// The file's owner may also remove it between our opening and locking it.
int open_and_lock(const std::string& path, Side side) {
  const int flags = side == Side::kStylet ? O_RDWR | O_CREAT : O_RDWR;
  for (int i = 0; i < 8; ++i) {
    const int file = open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW, 0660);
    if (file < 0 || side == Side::kDevice) return file;
    struct stat there = {};
    const bool locked = flock(file, LOCK_EX | LOCK_NB) == 0;
    if (locked && fstat(file, &there) == 0 && there.st_nlink > 0) return file;
    ::close(file);
    if (locked) continue;
    errno = EBUSY;
    return -1;
  }
  return -1;
}

}  // namespace

Link udp_listen(const std::string& where, const std::string& scheme) {
  auto udp = std::make_unique<Udp>();
  const sockaddr_in own = parse_address(where, scheme, false);
  udp->socket = udp_socket(scheme);
  if (bind(udp->socket, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) {
    const int error = errno;
    ::close(udp->socket);
    throw DeviceError(fmt::format("{}:{}: {}: expected a port that is free, of this machine",
                                  scheme, where, std::strerror(error)));
  }
  return udp_link(std::move(udp));
}

Link udp_connect(const std::string& where, const std::string& scheme) {
  auto udp = std::make_unique<Udp>();
  udp->peer = parse_address(where, scheme, true);
  udp->socket = udp_socket(scheme);
  // Receives from nobody else: the system drops what comes from other addresses.
  if (connect(udp->socket, reinterpret_cast<const sockaddr*>(&udp->peer), sizeof udp->peer) != 0) {
    const int error = errno;
    ::close(udp->socket);
    throw DeviceError(
        fmt::format("{}:{}: {}: expected the address of a machine that can be reached", scheme,
                    where, std::strerror(error)));
  }
  Link link = udp_link(std::move(udp));
  link.trouble = udp_trouble;
  return link;
}

Link shared_memory(const std::string& name, Side side) {
  auto memory = std::make_unique<PacketMemory>();
  memory->side = side;
  memory->path = "/dev/shm/stylet." + name;
  if (name.empty() || name.find('/') != std::string::npos) {
    throw DeviceError(fmt::format("shm:{}: expected a name without a slash", name));
  }
  const int file = open_and_lock(memory->path, side);
  const bool sized = file >= 0 && ftruncate(file, sizeof(Shared)) == 0;
  void* at = sized ? map_lasting(file, sizeof(Shared)) : nullptr;
  if (at == nullptr) {
    const int error = errno;
    if (file >= 0) ::close(file);
    const char* hint = side == Side::kDevice ? ": is Stylet running?"
                       : error == EBUSY      ? ": another Stylet has it: expected a name of its own"
                                             : "";
    throw DeviceError(
        fmt::format("shm:{}: {}: {}{}", name, memory->path, std::strerror(error), hint));
  }
  memory->file = file;
  memory->shared = static_cast<Shared*>(at);
  if (side == Side::kStylet) {  // what an earlier run left there is not new
    for (auto& word : memory->shared->from_device) word.store(0, std::memory_order_relaxed);
    for (auto& word : memory->shared->from_stylet) word.store(0, std::memory_order_relaxed);
  }
  return {memory.release(), memory_send, memory_receive, nullptr, memory_close, memory_trouble};
}

}  // namespace stylet::hal
