// SPDX-License-Identifier: Apache-2.0
// Looks after a thread that writes forces, and stands in a vendor's call for good: the motors keep
// what they had, and nobody but another thread can take it out.
//
// Promise: once the count of its turns has stood still for kStallNs, `cut` is called, once, at most
// kLookEveryMs later; 25 ms with both. A thread that has not begun does not stand.
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
  // `turns`: of the other thread, outlives this; `rests`: it stands in order.
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
