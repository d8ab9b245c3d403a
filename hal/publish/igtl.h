// SPDX-License-Identifier: Apache-2.0
// Publishes the run as an OpenIGTLink server, so that 3D Slicer and others can follow it live.
//
// Fifty times a second every client gets the newest values of each needle. The i-th needle's names
// end in i, the first one's have no number:
//   TRANSFORM StyletBase   the needle's base; its -z points along the needle
//   TRANSFORM StyletTip    the tip, with the base's rotation (for a bent needle: not its end's)
//   POSITION  StyletTip    the same position, for clients that take only points
//   SENSOR    StyletForce  N: on the hand x y z, along the course, across it, and along the course
//                          by cause: stiffness, cutting, friction, clamping, obstacle
//   STRING    StyletState  one line to read: depth, force, phase, and a fault
//   STATUS    Stylet       OK, or hardware failure with the name of the fault: when it changes, and
//                          every second
//   POINT     StyletTargets   once, if the scene has targets
// Positions are in mm, protocol version 1. Frame: RAS. The world is taken for LPS, as segmentations
// are here and mesh files are in 3D Slicer, so x and y change their sign.
//
// Promises: the loop knows nothing of it, because it runs in a process of its own (igtl_process.h),
// which calls post(); its thread has the lowest priority. A client that reads too slowly misses
// frames and is closed after kIgtlPatience; what a client sends is read and discarded, at a bounded
// rate.
// Listens on loopback unless told otherwise. Protocol: openigtlink.org. Units: SI here.
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

constexpr std::uint16_t kIgtlPort = 18944;  // the protocol's own number
constexpr std::size_t kMaxIgtlClients = 8;  // another one is closed at once
constexpr std::chrono::milliseconds kIgtlPause{20};
constexpr std::chrono::seconds kIgtlPatience{10};
constexpr std::size_t kIgtlMostRead = 65536;  // from one client in one pause; the rest waits

struct IgtlError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct IgtlConfig {
  std::string address = "127.0.0.1";
  std::uint16_t port = kIgtlPort;  // 0: any free port
  std::vector<Course> courses;     // for each needle
  std::vector<Target> targets;
};

struct IgtlCounters {
  std::uint32_t clients = 0;
  std::uint64_t clients_total = 0, clients_refused = 0;
  std::uint64_t frames = 0;       // sent, counted for each client
  std::uint64_t lost_frames = 0;  // missed by clients that were too slow
};

class IgtlServer {
 public:
  // Throws IgtlError if built without the library, for an unknown address, or if the port is taken.
  explicit IgtlServer(const IgtlConfig& config);
  ~IgtlServer();
  IgtlServer(const IgtlServer&) = delete;
  IgtlServer& operator=(const IgtlServer&) = delete;

  std::uint16_t port() const;
  // By one thread at a time, not the loop's. Keeps the newest record of each needle.
  void post(std::span<const TickRecord> records);
  IgtlCounters counters() const;

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace stylet::hal
