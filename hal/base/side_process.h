// SPDX-License-Identifier: Apache-2.0
// A process beside the loop's, for work that may crash, leak or hang without a hand feeling it.
//
// It is this program started once more by posix_spawn, with an address space of its own, so that
// it inherits no locked memory, real-time rights or descriptors. Between the two processes are:
//   shared memory   carries data out of the loop (channel.h): it cannot shrink, and the loop trusts
//                   nothing in it
//   a socket        carries orders and answers as whole messages between threads that may wait;
//                   when one side ends, the other sees the end of the socket
// Signals that end a program from outside are for the loop's process. Here they are blocked: this
// process ends when its socket does. If the system runs short of memory it kills this one first.
// Promises: nothing it does throws in the loop's process, blocks that process longer than the
// patience asked for, or makes it allocate more than kMaxSideMessage; the destructor waits at most
// kSideEndS, then kills.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/base/packing.h"
#include "hal/base/shared_memory.h"

namespace stylet::hal {

// A longer message ends the link. Phases and events of the longest run take a tenth of it.
constexpr std::size_t kMaxSideMessage = std::size_t{64} << 20U;
// Longest wait for its start or an answer, on a busy machine. After that it is killed.
constexpr double kSidePatienceS = 20;
// Longest wait for its end, once it has nothing more to complete. After that it is killed, too.
constexpr double kSideEndS = 2;
// Its own memory, beside what is shared. With more, its allocations fail and it ends.
constexpr std::size_t kMostSideMemory = std::size_t{4} << 30U;

// One end of the socket.
class SideLink {
 public:
  explicit SideLink(int socket) : socket_(socket) {}
  ~SideLink();
  SideLink(const SideLink&) = delete;
  SideLink& operator=(const SideLink&) = delete;

  // False: the other side has gone or takes nothing. If only half a message was sent, it counts as
  // gone, too. `descriptors`: the other side gets copies of its own.
  bool send(std::span<const std::byte> message, double patience_s = kSidePatienceS,
            std::span<const int> descriptors = {});
  // The next whole message; nullopt: it did not come in time, or the other side has gone.
  // Descriptors that came with it are added to `descriptors`; if null, the system closes them.
  std::optional<Bytes> receive(double patience_s, std::vector<int>* descriptors = nullptr);
  // Whether the other side has gone, as the last call saw it. Two threads may send and receive.
  bool gone() const { return gone_; }
  void close();

 private:
  bool wait(short events, double patience_s) const;
  std::optional<Bytes> take_whole();

  int socket_;
  std::atomic<bool> gone_{false};
  Bytes arrived_;
};

class SideProcess {
 public:
  // Waits until it is ready. If it cannot be started, throws SideError, with the process's words
  // if it refused. `role`: as in side_seat().
  SideProcess(const std::string& role, std::size_t shared_bytes,
              std::span<const std::byte> greeting);
  ~SideProcess();
  SideProcess(const SideProcess&) = delete;
  SideProcess& operator=(const SideProcess&) = delete;

  // Aligned to a cache line.
  std::span<std::byte> shared() const;
  SideLink& link() { return link_; }
  // What the process said when it was ready.
  const Bytes& answer() const { return answer_; }
  pid_t pid() const { return pid_; }
  // How it ended, in words; empty: it is still running.
  const std::string& ended();
  // Ends it at once, unless it ends by itself because its link has gone.
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

// ---- in the side process

// argv[1] of a side process; its role is argv[2].
constexpr const char* kBesideCommand = "beside";

struct SideSeat {
  SideLink& link;
  std::span<std::byte> shared;
  Bytes greeting;
  // Tells the loop's process that the work can begin.
  void ready(std::span<const std::byte> answer = {}) const { (void)link.send(answer); }
};
using SideWork = void (*)(SideSeat&);
// The whole life of a side process; returns its exit code. `work` returns when the link is gone, or
// throws. `outlives`: it has work to complete if the loop's process is killed; else it ends too.
int side_seat(const char* role, SideWork work, bool outlives);

}  // namespace stylet::hal
