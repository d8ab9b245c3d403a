// SPDX-License-Identifier: Apache-2.0
// The time the loop lives in: the machine's, or one that jumps to wherever the loop wants to be.
// Promise: no allocation, no lock; the only system calls are clock_gettime and clock_nanosleep.
#pragma once

#include <cstdint>

namespace stylet::hal {

struct Clock {
  void* self = nullptr;
  std::int64_t (*now_ns)(void* self) = nullptr;
  void (*sleep_until_ns)(void* self,
                         std::int64_t t_ns) = nullptr;  // returns at once if t_ns is past
};

Clock monotonic_clock();

struct VirtualTime {
  std::int64_t now_ns = 0;
};
// `time` must outlive the clock; whoever wants to be late moves it forward.
Clock virtual_clock(VirtualTime& time);

// CLOCK_MONOTONIC, for measuring how long something took whatever the loop's clock is.
std::int64_t monotonic_now_ns();

}  // namespace stylet::hal
