// SPDX-License-Identifier: Apache-2.0
// How long opening waits for a device: until the time is up, or somebody has asked to stop. More
// seconds than a clock can count, and infinitely many, are no limit.
#pragma once

#include <atomic>
#include <chrono>

namespace stylet::hal {

inline std::atomic<bool (*)()> g_opening_stops{nullptr};  // stop_opening_when (devices.h)

class Patience {
 public:
  explicit Patience(double seconds)
      : end_(seconds < kLongestS ? Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                      std::chrono::duration<double>(seconds))
                                 : Clock::time_point::max()) {}
  bool over() const {
    bool (*const stops)() = g_opening_stops.load();
    return (stops != nullptr && stops()) || Clock::now() > end_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kLongestS = 1e9;  // 30 years; the clock ends after 290
  Clock::time_point end_;
};

}  // namespace stylet::hal
