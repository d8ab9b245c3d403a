// SPDX-License-Identifier: Apache-2.0
// Watches a thread that writes forces, in case it hangs in a vendor's call: then the motors
// keep the force they have, and only another thread can remove it.
//
// Promise: if the thread's count of turns does not grow for kStallNs, `cut` is called once, at most
// kLookEveryMs later: 25 ms together. A thread that has not begun does not count as hanging.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "hal/base/clock.h"
#include "hal/base/contained.h"
#include "hal/device/thread.h"

namespace stylet::hal {

constexpr std::int64_t kStallNs = 20'000'000;
constexpr int kLookEveryMs = 2;

class Supervisor {
 public:
  // `turns`: counted by the other thread, must outlive this; `rests`: true if it stands on purpose.
  template <typename Rests, typename Cut>
  void start(const std::atomic<std::uint64_t>& turns, Rests rests, Cut cut) {
    thread_ = std::thread([this, &turns, rests, cut] {
      name_thread("stylet-cuts");
      rise_above_the_loop();
      (void)contained("supervisor", [&] { watch(turns, rests, cut); });
    });
  }
  void stop() {
    stop_.store(true);
    if (thread_.joinable()) thread_.join();
  }

 private:
  template <typename Rests, typename Cut>
  void watch(const std::atomic<std::uint64_t>& turns, Rests rests, Cut cut) {
    std::uint64_t seen = 0;
    std::int64_t moved_ns = monotonic_now_ns();
    while (!stop_.load()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kLookEveryMs));
      const std::uint64_t now = turns.load(std::memory_order_relaxed);
      const std::int64_t now_ns = monotonic_now_ns();
      if (now != seen || rests()) moved_ns = now_ns;
      seen = now;
      if (now != 0 && now_ns - moved_ns >= kStallNs) return cut();
    }
  }

  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace stylet::hal
