// SPDX-License-Identifier: Apache-2.0
// A process beside the loop's: what may crash, leak or hang without a hand feeling it.
//
// It is this program once more, with an address space of its own, started by posix_spawn, so that
// it inherits neither locked memory, real-time rights nor descriptors. Between the two:
//   shared memory   the way out of the loop (channel.h): it cannot shrink, and the loop trusts
//                   nothing in it
//   a socket        orders and answers, as whole messages, between threads that may wait; when the
//                   one side has gone the other sees its end
// Signals that end a program from outside are for the loop's process: here they are blocked, and
// its end is the end of the socket. The system's shortage of memory takes this process first.
// Promises: what it does never throws in the loop's process, blocks it longer than the patience
// that was asked for, or makes it allocate more than kMaxSideMessage; the destructor waits at most
// kSideEndS, then kills.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/base/packing.h"

namespace stylet::hal {

// Longer: the link ends. Phases and events of the longest run take a tenth.
constexpr std::size_t kMaxSideMessage = std::size_t{64} << 20U;
// For its start and an answer, on a busy machine. Longer: it is killed.
constexpr double kSidePatienceS = 20;
// For its end, when it has nothing more to complete. Longer: likewise.
constexpr double kSideEndS = 2;
// Of its own, over what is shared. More: its allocations fail, and it ends.
constexpr std::size_t kMostSideMemory = std::size_t{4} << 30U;

struct SideError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// One end of the socket.
class SideLink {
 public:
  explicit SideLink(int socket) : socket_(socket) {}
  ~SideLink();
  SideLink(const SideLink&) = delete;
  SideLink& operator=(const SideLink&) = delete;

  // False: the other side has gone, or takes nothing. It is gone, too, where half a message went.
  // `descriptors`: it gets its own of them.
  bool send(std::span<const std::byte> message, double patience_s = kSidePatienceS,
            std::span<const int> descriptors = {});
  // The next whole message. None: not all of it came in time, or the other side has gone.
  // Descriptors that came with it are added to `descriptors`; null: the system closes them.
  std::optional<Bytes> receive(double patience_s, std::vector<int>* descriptors = nullptr);
  // As the last call saw it. One thread may send while another receives.
  bool gone() const { return gone_; }
  void close();

 private:
  bool wait(short events, double patience_s) const;
  std::optional<Bytes> take_whole();

  int socket_;
  std::atomic<bool> gone_{false};
  Bytes arrived_;
};

// Memory that two processes see.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t bytes);  // zero; throws SideError
  // That of a descriptor, as large as it is.
  static SharedMemory of(int descriptor) { return {descriptor, 0}; }
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  std::span<std::byte> bytes() const { return bytes_; }
  int descriptor() const { return descriptor_; }

 private:
  SharedMemory(int descriptor, std::size_t bytes);
  int descriptor_;
  std::span<std::byte> bytes_;
};

class SideProcess {
 public:
  // Waits until it is ready. Throws SideError if it cannot be started, with its own words where it
  // refuses. `role`: as in side_seat().
  SideProcess(const std::string& role, std::size_t shared_bytes,
              std::span<const std::byte> greeting);
  ~SideProcess();
  SideProcess(const SideProcess&) = delete;
  SideProcess& operator=(const SideProcess&) = delete;

  // On a cache line.
  std::span<std::byte> shared() const;
  SideLink& link() { return link_; }
  // What it said when it was ready.
  const Bytes& answer() const { return answer_; }
  pid_t pid() const { return pid_; }
  // How it ended, in words; empty: it goes on.
  const std::string& ended();
  // At once, where it does not end by itself because its link has gone.
  void kill();

 private:
  bool wait_for_end(double patience_s);
  std::string last_words() const;

  SharedMemory memory_;
  int far_end_;
  SideLink link_;
  pid_t pid_ = -1;
  std::string ended_;
  Bytes answer_;
};

// ---- in the process beside

// argv[1] of such a process; its role is argv[2].
constexpr const char* kBesideCommand = "beside";

struct SideSeat {
  SideLink& link;
  std::span<std::byte> shared;
  Bytes greeting;
  // It can begin.
  void ready(std::span<const std::byte> answer = {}) const { (void)link.send(answer); }
};
using SideWork = void (*)(SideSeat&);
// The whole life of it, to its exit code: `work` returns when the link is gone, or throws.
// `outlives`: it has something to complete when the loop's process is killed; else it ends, too.
int side_seat(const char* role, SideWork work, bool outlives);

}  // namespace stylet::hal
