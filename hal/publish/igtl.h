// SPDX-License-Identifier: Apache-2.0
// The run as an OpenIGTLink server, so that 3D Slicer and others follow it live.
//
// Fifty times a second every client gets the newest of each needle; the i-th needle's names end in
// i, the first's in nothing:
//   TRANSFORM StyletBase   the needle's base; its -z points along the needle
//   TRANSFORM StyletTip    the tip, turned as the base (of a bent needle: not along its end)
//   POSITION  StyletTip    the same place, for those who take only points
//   SENSOR    StyletForce  N: on the hand x y z, along the course, across it, and by cause along
//                          the course: stiffness, cutting, friction, clamping, obstacle
//   STRING    StyletState  one line to read: depth, force, phase, and a fault
//   STATUS    Stylet       OK, or hardware failure with the fault's name: when it changes, and
//                          every second
//   POINT     StyletTargets   once, where the scene has targets
// Places are mm, protocol version 1. Frame: RAS. The world is taken for LPS, as segmentations are
// here and mesh files are in 3D Slicer, so that x and y change their sign.
//
// Promises: the loop knows nothing of it: its thread has the lowest priority, in a process of its
// own (igtl_process.h), where post() is called. A client that reads too slowly misses whole frames
// and is closed after kIgtlPatience; what a client says is read and thrown away, at a bounded rate.
// Loopback unless told otherwise. Protocol: openigtlink.org. Units: SI here.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/loop/record.h"
#include "hal/score/score.h"

namespace stylet::hal {

constexpr std::uint16_t kIgtlPort = 18944;  // the protocol's own
constexpr std::size_t kMaxIgtlClients = 8;  // one more is closed at once
constexpr std::chrono::milliseconds kIgtlPause{20};
constexpr std::chrono::seconds kIgtlPatience{10};
constexpr std::size_t kIgtlMostRead = 65536;  // of one client in a pause; the rest waits with it

struct IgtlError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct IgtlConfig {
  std::string address = "127.0.0.1";
  std::uint16_t port = kIgtlPort;  // 0: any that is free
  std::vector<Course> courses;     // of each needle
  std::vector<Target> targets;
};

struct IgtlCounters {
  std::uint32_t clients = 0;
  std::uint64_t clients_total = 0, clients_refused = 0;
  std::uint64_t frames = 0;       // sent, each client's
  std::uint64_t lost_frames = 0;  // that a client was too slow for
};

class IgtlServer {
 public:
  // Throws IgtlError: built without the library, no such address, or the port is taken.
  explicit IgtlServer(const IgtlConfig& config);
  ~IgtlServer();
  IgtlServer(const IgtlServer&) = delete;
  IgtlServer& operator=(const IgtlServer&) = delete;

  std::uint16_t port() const;
  // One thread at a time, not the loop's. The newest record of each needle stays.
  void post(std::span<const TickRecord> records);
  IgtlCounters counters() const;

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace stylet::hal
