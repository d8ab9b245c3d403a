// SPDX-License-Identifier: Apache-2.0
// Between the loop and the thread that talks to a device, the vendor's or ours: the newest sample
// one way, the newest force the other.
//
// A force that is not renewed within kOrderLifeNs ends: a loop that has stopped leaves no force in
// the device, whatever its thread does. fail() is for good: no sample and no force comes through
// any more, so that a device that comes back by itself does not push. A device that has shown
// nothing new for kQuietNs does not answer.
// Promises: wait-free, no allocation, no system call; one thread on each side. Units: SI.
#pragma once

#include <atomic>
#include <cstdint>

#include "stylet/hal/channel.h"
#include "stylet/hal/device.h"

namespace stylet::hal {

constexpr std::int64_t kOrderLifeNs = 10'000'000;
constexpr std::int64_t kQuietNs = 20'000'000;

class Relay {
 public:
  // ---- the device's thread
  // Times on CLOCK_MONOTONIC.
  void publish(const Pose& pose, std::uint32_t buttons, std::int64_t t_ns);
  struct Order {
    Vec3 force_n;
    Vec3 torque_nm;
  };
  Order order(std::int64_t now_ns);

  // ---- any thread
  // Why, a number of the device's own; the first one stays.
  void fail(std::uint32_t why);
  bool failed() const { return failed_.load(std::memory_order_acquire); }
  std::uint32_t why() const { return why_.load(std::memory_order_relaxed); }
  bool measured() const { return measured_.load(std::memory_order_acquire); }

  // ---- the loop
  bool read(std::int64_t now_ns, Sample& sample_out);
  void write(const Command& command);

 private:
  struct Given {
    Order order;
    std::int64_t t_ns;
  };
  Latest<Sample> samples_;
  Latest<Given> orders_;
  std::atomic<bool> failed_{false};
  std::atomic<bool> measured_{false};
  std::atomic<std::uint32_t> why_{0};
  std::uint64_t seq_ = 0;     // the device's thread
  Given given_ = {};          // the device's thread
  Sample newest_ = {};        // the loop
  std::int64_t tick_ns_ = 0;  // the loop
};

// The device as the loop sees it, of whatever has a member `relay`.
template <typename Backend>
Device relayed(Backend* self, const DeviceInfo& info, void (*close)(void*),
               std::string (*trouble)(void*)) {
  const auto read = [](void* at, std::int64_t now_ns, Sample& sample_out) {
    return static_cast<Backend*>(at)->relay.read(now_ns, sample_out);
  };
  const auto write = [](void* at, const Command& command) {
    static_cast<Backend*>(at)->relay.write(command);
  };
  return {self, info, read, write, close, trouble};
}

}  // namespace stylet::hal
