// SPDX-License-Identifier: Apache-2.0
// Between the loop and the thread that talks to a device, the vendor's or ours: the newest sample
// goes one way, the newest force the other.
//
// The device's thread gets what the motors may have: slewed, and zero some time after the loop has
// stopped (motor.h). fail() is for good: no sample and no force comes through any more, so that a
// device that recovers by itself does not push. end(): the present force fades. rest(): it fades,
// and comes back when somebody has acknowledged after the rest. A device that has shown nothing new
// for kQuietNs (device.h) counts as one that does not answer. Promises: wait-free, no allocation,
// no system call; one thread on each side. Units: SI.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "hal/base/channel.h"
#include "hal/device/device.h"
#include "hal/device/motor.h"

namespace stylet::hal {

// How long closing a device waits for its force to fade.
constexpr std::chrono::milliseconds kFadeTime(25);

class Relay {
 public:
  MotorLimits limits;  // set before the first order

  // ---- the device's thread
  // Times on CLOCK_MONOTONIC.
  void publish(const Pose& pose, std::uint32_t buttons, std::int64_t t_ns);
  // What to write to the motors now. Call it once a period: the force changes with passing time.
  MotorReport order(std::int64_t now_ns);
  void written(std::int64_t now_ns);  // call it after writing, see motor_written

  // ---- any thread
  void end();
  void rest(bool on);
  // Keeps the reason, a number of the device's own; the first reason stays.
  void fail(std::uint32_t why);
  bool failed() const { return failed_.load(std::memory_order_acquire); }
  std::uint32_t why() const { return why_.load(std::memory_order_relaxed); }
  // A force was ordered, or somebody has acknowledged, since the device was opened.
  bool used() const { return used_.load(std::memory_order_relaxed); }
  bool measured() const { return measured_.load(std::memory_order_acquire); }

  // ---- the loop
  bool read(std::int64_t now_ns, Sample& sample_out);
  void write(const Command& command);
  bool motor(MotorReport& report_out);

 private:
  Latest<Sample> samples_;
  Latest<MotorOrder> orders_;
  Latest<MotorReport> reports_;
  std::atomic<bool> failed_{false};
  std::atomic<bool> measured_{false};
  std::atomic<bool> ending_{false}, resting_{false}, used_{false};
  std::atomic<std::uint32_t> why_{0};
  std::uint64_t seq_ = 0;     // used by the device's thread
  MotorOrder order_ = {};     // used by the device's thread
  std::uint32_t first_ = 0;   // used by the device's thread: arming of the first order
  MotorState motor_ = {};     // used by the device's thread
  Sample newest_ = {};        // used by the loop
  MotorReport report_ = {};   // used by the loop
  std::int64_t tick_ns_ = 0;  // used by the loop
  std::int64_t new_ns_ = 0;   // used by the loop: tick that took the newest sample
};

// The device as the loop sees it, made from anything that has a member `relay`.
template <typename Backend>
Device relayed(Backend* self, const DeviceInfo& info, void (*close)(void*),
               std::string (*trouble)(void*)) {
  const auto read = [](void* at, std::int64_t now_ns, Sample& sample_out) {
    return static_cast<Backend*>(at)->relay.read(now_ns, sample_out);
  };
  const auto write = [](void* at, const Command& command) {
    static_cast<Backend*>(at)->relay.write(command);
  };
  const auto motor = [](void* at, MotorReport& report_out) {
    return static_cast<Backend*>(at)->relay.motor(report_out);
  };
  Device device = {self, info, read, write, close, trouble};
  device.motor = motor;
  return device;
}

// Limits from what a device says of itself.
inline MotorLimits motor_limits(const DeviceInfo& info) {
  return {info.max_force_n, info.max_slew_n_per_s, info.max_torque_nm};
}

}  // namespace stylet::hal
