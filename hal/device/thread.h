// SPDX-License-Identifier: Apache-2.0
// A thread that talks to a device, with priority above the loop's where the machine allows it. It
// runs on a grid of CLOCK_MONOTONIC until it is told to stop, and skips grid points it has missed.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "hal/base/clock.h"
#include "hal/base/contained.h"
#include "hal/base/thread_rights.h"
#include "hal/device/devices.h"

namespace stylet::hal {

// Raises the calling thread, the vendor's or ours: a sample must not wait for the loop it is for.
inline std::atomic<int> g_priority_refused{0};  // the newest refusal's error
inline void rise_above_the_loop() {
  const int error = rise_to(kDevicePriority);
  if (error != 0) g_priority_refused.store(error);
}

// A turn that failed may have skipped its own waiting; above the loop's priority it must not spin.
constexpr std::int64_t kPauseAfterEscapeNs = 1'000'000;

class DeviceThread {
 public:
  // `work` is called once a period; with period 0 over and over, and must then wait by itself.
  template <typename Work>
  void start(std::int64_t period_ns, Work work) {
    thread_ = std::thread([this, period_ns, work] {
      name_thread("stylet-device");
      rise_above_the_loop();
      risen_.store(true);
      run(period_ns, work);
      ended_.store(true);
    });
    // So that whoever opens a device can tell what was refused to its thread.
    while (!risen_.load()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void stop() {
    stop_.store(true);
    if (thread_.joinable()) thread_.join();
  }
  // False: it hangs in its work, and stop() would wait for ever.
  bool stops_within(std::chrono::milliseconds longest) {
    stop_.store(true);
    const auto end = std::chrono::steady_clock::now() + longest;
    while (thread_.joinable() && !ended_.load()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  bool stopping() const { return stop_.load(std::memory_order_relaxed); }

 private:
  template <typename Work>
  void run(std::int64_t period_ns, Work work) {
    const Clock clock = monotonic_clock();
    std::int64_t next_ns = clock.now_ns(clock.self);
    while (!stopping()) {
      // What fails once may succeed the next time, and then there may be a force to take back.
      const bool done = contained("device", work);
      if (period_ns == 0) {
        if (!done) clock.sleep_until_ns(clock.self, clock.now_ns(clock.self) + kPauseAfterEscapeNs);
        continue;
      }
      const std::int64_t now_ns = clock.now_ns(clock.self);
      next_ns += period_ns;
      if (next_ns < now_ns) next_ns = now_ns;
      clock.sleep_until_ns(clock.self, next_ns);
    }
  }

  std::atomic<bool> stop_{false}, risen_{false}, ended_{false};
  std::thread thread_;
};

}  // namespace stylet::hal
