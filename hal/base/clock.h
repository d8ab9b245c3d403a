// SPDX-License-Identifier: Apache-2.0
// The clock of the loop: the machine's, or one that jumps to whatever time the loop waits for.
// Promise: no allocation, no lock; the only system calls are clock_gettime and clock_nanosleep (on
// Windows the performance counter and a timer, which a thread makes at its first wait).
#pragma once

#include <cstdint>

namespace stylet::hal {

struct Clock {
  void* self = nullptr;
  std::int64_t (*now_ns)(void* self) = nullptr;
  void (*sleep_until_ns)(void* self,
                         std::int64_t t_ns) = nullptr;  // returns at once if t_ns has passed
};

Clock monotonic_clock();

struct VirtualTime {
  std::int64_t now_ns = 0;
};
// `time` must outlive the clock; to simulate lateness, move it forward.
Clock virtual_clock(VirtualTime& time);

// CLOCK_MONOTONIC, on Windows its performance counter: to measure how long something took,
// whichever clock the loop has.
std::int64_t monotonic_now_ns();

}  // namespace stylet::hal
