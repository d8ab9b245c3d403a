// SPDX-License-Identifier: Apache-2.0
// A process in virtual time: drivers, their threads, vendors' stand-ins and sockets run as they
// are, but the clock jumps to the next wake-up, and one thread runs at a time.
//
// These functions replace those of the C library in the whole program: clock_gettime, sleeps, waits
// for files with or without a time limit, for mutexes, for condition variables with a limit, for
// the ends of threads, and sched_yield. A thread that waits in any other way holds up all others.
// The order of threads is that of their wake-ups: the same calls give the same run, unless sockets
// behave differently. Units: ns.
#pragma once

#include <cstdint>
#include <functional>

namespace stylet::test {

constexpr std::int64_t kLookNs = 100'000;  // how often a waiting thread looks again

struct VirtualProcess {
  // Called in a thread that begins to wait, before it does.
  std::function<void()> look;
  // When a thread that asked to wake up at `wake_ns` really wakes up: not before that.
  std::function<std::int64_t(int thread, std::int64_t wake_ns)> wakes;
};

// Begins virtual time, for good: for the calling thread, which has the number 0, and all threads
// that it starts.
VirtualProcess& enter_virtual_time();
std::int64_t virtual_now_ns();
void sleep_until_virtual(std::int64_t t_ns);
// Number of the thread that was made last.
int newest_virtual_thread();

}  // namespace stylet::test
