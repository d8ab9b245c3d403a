// SPDX-License-Identifier: Apache-2.0
// A link carries packets between two programs: by UDP between machines, by shared memory on one.
//
// Promises: send and receive return at once, allocate nothing and take no lock of ours; a packet
// may be lost, doubled, late or out of order. Opening throws DeviceError with one line.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace stylet::hal {

struct Link {
  void* self = nullptr;
  void (*send)(void* self, std::span<const std::byte> packet) = nullptr;
  // Number of bytes written to `room`; 0: a packet was useless or from a stranger, and more may be
  // waiting; nullopt: no packet is there.
  std::optional<std::size_t> (*receive)(void* self, std::span<std::byte> room) = nullptr;
  // From now on send to whoever sent the newest packet; null: there is only one peer.
  void (*answer)(void* self) = nullptr;
  void (*close)(void* self) = nullptr;
  // Any thread: why nothing comes through any more; empty, or null: no trouble.
  std::string (*trouble)(void* self) = nullptr;
};

// Stylet's side, waiting at "7755" (this machine only) or "ADDRESS:7755"; sends as `answer` says.
// `scheme`: whose URI it is, for messages.
Link udp_listen(const std::string& where, const std::string& scheme = "udp");
// The side that sends to "ADDRESS:PORT". Its `trouble` says when the machine there has answered
// that no program listens, as long as no packet comes after that.
Link udp_connect(const std::string& where, const std::string& scheme = "udp");

// Two slots in /dev/shm/stylet.NAME, one in each direction. Stylet's side makes the file or empties
// an existing one; the device's side opens it and may keep it open over several runs.
enum class Side { kStylet, kDevice };
Link shared_memory(const std::string& name, Side side);

}  // namespace stylet::hal
