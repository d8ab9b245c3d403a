// SPDX-License-Identifier: Apache-2.0
// The performance counter, and a timer of high resolution where Windows has one (10, version 1803).
#include <windows.h>

#include "hal/base/clock.h"

namespace stylet::hal {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;
// A timer of high resolution wakes up this late at most; it is set earlier, the rest is polled.
constexpr std::int64_t kTimerLateNs = 600'000;
constexpr std::int64_t kTimerUnitNs = 100;

std::int64_t counts_per_s() {
  static const std::int64_t kept = [] {
    LARGE_INTEGER per_s;
    QueryPerformanceFrequency(&per_s);
    return per_s.QuadPart;
  }();
  return kept;
}

// A thread's own; null: it only polls.
struct Timer {
  HANDLE handle;
  Timer() {
#ifndef CREATE_WAITABLE_TIMER_HIGH_RESOLUTION
    constexpr DWORD CREATE_WAITABLE_TIMER_HIGH_RESOLUTION = 2;
#endif
    handle = CreateWaitableTimerExW(nullptr, nullptr, CREATE_WAITABLE_TIMER_HIGH_RESOLUTION,
                                    TIMER_ALL_ACCESS);
  }
  ~Timer() {
    if (handle != nullptr) CloseHandle(handle);
  }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
};

void wait(std::int64_t ns) {
  thread_local const Timer timer;
  LARGE_INTEGER due;
  due.QuadPart = -(ns / kTimerUnitNs);  // negative: from now on
  if (timer.handle == nullptr ||
      SetWaitableTimer(timer.handle, &due, 0, nullptr, nullptr, 0) == 0) {
    return;
  }
  WaitForSingleObject(timer.handle, INFINITE);
}

std::int64_t now(void* /*self*/) {
  return monotonic_now_ns();
}

void sleep_until(void* /*self*/, std::int64_t t_ns) {
  for (;;) {
    const std::int64_t left_ns = t_ns - monotonic_now_ns();
    if (left_ns <= 0) return;
    if (left_ns > kTimerLateNs) {
      wait(left_ns - kTimerLateNs);
    } else {
      YieldProcessor();
    }
  }
}

}  // namespace

// In whole seconds and the rest: the product of counts and nanoseconds would overflow in a day.
std::int64_t monotonic_now_ns() {
  LARGE_INTEGER counts;
  QueryPerformanceCounter(&counts);
  const std::int64_t per_s = counts_per_s();
  const std::int64_t s = counts.QuadPart / per_s, rest = counts.QuadPart % per_s;
  return s * kNsPerS + rest * kNsPerS / per_s;
}

Clock monotonic_clock() {
  return {nullptr, now, sleep_until};
}

}  // namespace stylet::hal
