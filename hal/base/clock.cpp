// SPDX-License-Identifier: Apache-2.0
#include "hal/base/clock.h"

#include <cerrno>
#include <ctime>

namespace stylet::hal {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

std::int64_t monotonic_now(void* /*self*/) {
  return monotonic_now_ns();
}

void monotonic_sleep(void* /*self*/, std::int64_t t_ns) {
  const timespec until{static_cast<std::time_t>(t_ns / kNsPerS), static_cast<long>(t_ns % kNsPerS)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace

std::int64_t monotonic_now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNsPerS + now.tv_nsec;
}

Clock monotonic_clock() {
  return {nullptr, monotonic_now, monotonic_sleep};
}

}  // namespace stylet::hal
