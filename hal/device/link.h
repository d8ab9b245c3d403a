// SPDX-License-Identifier: Apache-2.0
// A way for packets between two programs: UDP between machines, shared memory on one.
//
// Promises: send and receive return at once and allocate nothing, take no lock of ours; a packet
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
  // Bytes written to `room`; 0: what came is of no use, or from somebody else, and there may be
  // more. None: nothing there.
  std::optional<std::size_t> (*receive)(void* self, std::span<std::byte> room) = nullptr;
  // From now on to whoever sent the packet received last; null: there is only one.
  void (*answer)(void* self) = nullptr;
  void (*close)(void* self) = nullptr;
  // Any thread: why nothing comes through any more; empty, or none: no trouble.
  std::string (*trouble)(void* self) = nullptr;
};

// Where Stylet waits: "7755" (this machine only) or "ADDRESS:7755"; answers whoever it is told to.
Link udp_listen(const std::string& where);
// Where the device's side sends: "ADDRESS:PORT".
Link udp_connect(const std::string& where);

// Two slots in /dev/shm/stylet.NAME, one a direction. Stylet's side makes the file, or empties the
// one that is there; the device's side opens it and may keep it from run to run.
enum class Side { kStylet, kDevice };
Link shared_memory(const std::string& name, Side side);

}  // namespace stylet::hal
