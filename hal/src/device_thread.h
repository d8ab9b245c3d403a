// SPDX-License-Identifier: Apache-2.0
// A thread that talks to a device: above the loop where the machine allows it, until it is told to
// stop. Its pace is a grid of CLOCK_MONOTONIC; what it missed it leaves out.
#pragma once

#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "stylet/hal/clock.h"

namespace stylet::hal {

// The calling thread, the vendor's or ours: a sample must not wait for the loop that waits for it.
inline void rise_above_the_loop() {
  constexpr sched_param kAboveTheLoop = {90};
  (void)pthread_setschedparam(pthread_self(), SCHED_FIFO, &kAboveTheLoop);
}

class DeviceThread {
 public:
  // `work` is called once a period, 0: again and again, with the thread's own waiting in it.
  template <typename Work>
  void start(std::int64_t period_ns, Work work) {
    thread_ = std::thread([this, period_ns, work] {
      rise_above_the_loop();
      run(period_ns, work);
    });
  }
  void stop() {
    stop_.store(true);
    if (thread_.joinable()) thread_.join();
  }
  bool stopping() const { return stop_.load(std::memory_order_relaxed); }

 private:
  template <typename Work>
  void run(std::int64_t period_ns, Work work) {
    const Clock clock = monotonic_clock();
    std::int64_t next_ns = clock.now_ns(clock.self);
    while (!stopping()) {
      work();
      if (period_ns == 0) continue;
      const std::int64_t now_ns = clock.now_ns(clock.self);
      next_ns += period_ns;
      if (next_ns < now_ns) next_ns = now_ns;
      clock.sleep_until_ns(clock.self, next_ns);
    }
  }

  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace stylet::hal
