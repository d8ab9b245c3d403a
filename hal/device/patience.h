// SPDX-License-Identifier: Apache-2.0
// How long opening waits for a device: until the time is up, or somebody has asked to stop.
#pragma once

#include <atomic>
#include <chrono>

namespace stylet::hal {

inline std::atomic<bool (*)()> g_opening_stops{nullptr};  // stop_opening_when (devices.h)

class Patience {
 public:
  explicit Patience(double seconds)
      : end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                 std::chrono::duration<double>(seconds))) {}
  bool over() const {
    bool (*const stops)() = g_opening_stops.load();
    return (stops != nullptr && stops()) || std::chrono::steady_clock::now() > end_;
  }

 private:
  std::chrono::steady_clock::time_point end_;
};

}  // namespace stylet::hal
