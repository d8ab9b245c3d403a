// SPDX-License-Identifier: Apache-2.0
// A device under test and the hand on it: what the contract's tests need from every backend. All of
// it is in the device frame of the hal: x right, y up, z toward the operator, SI.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "hal/base/clock.h"
#include "hal/device/device.h"
#include "hal/device/devices.h"
#include "hal/guard/guard.h"
#include "standin/standin.h"
#include "vectors.h"

namespace stylet::hal {

// Some of the axes x, y and z.
struct AxisSet {
  bool x = true, y = true, z = true;

  bool any() const { return x || y || z; }
  Vec3 of(Vec3 v) const { return {x ? v.x : 0, y ? v.y : 0, z ? v.z : 0}; }
};
constexpr AxisSet kNoAxis = {false, false, false};

class Bench {
 public:
  virtual ~Bench() = default;
  virtual std::string uri() const = 0;
  virtual void move(const Pose& pose) = 0;
  virtual void press(std::uint32_t mask) = 0;
  virtual Vec3 felt() = 0;
  virtual Vec3 felt_torque() { return {}; }
  // How often its driver has written to it, if the backend counts that.
  virtual int writes() { return 0; }
  virtual void trouble(test::Trouble trouble) = 0;
  virtual void refuse_watchdog(bool /*refused*/) {}
  virtual void hang(test::Hang /*call*/) {}
  AxisSet places;       // along which it measures its position; along the others it gives a speed
  AxisSet feels;        // along which it renders force
  float step_n = 0;     // its forces are multiples of this along each axis; 0: any force
  float push_n = 2;     // how hard the checks push; the device's largest force is not below it
  bool presses = true;  // has buttons
  bool fails = true;    // may stop answering; otherwise silence means rest
  bool turns = true;    // measures its whole rotation
  bool latches = true;  // after it came back it has no force until it is opened again
  bool loses = true;    // a sample may be lost or late on its way, as a packet
};
using MakeBench = std::unique_ptr<Bench> (*)();

// A port that no other process has, since tests run side by side.
inline std::string test_port() {
  return std::to_string(20000 + getpid() % 12000);
}

std::unique_ptr<Bench> hd_bench();
std::unique_ptr<Bench> dhd_bench();
// A device with one motor, which pushes along z, and one encoder, which measures the way along z.
std::unique_ptr<Bench> one_axis_bench();
// One of the vendor's two devices, 0 or 1, by its name.
std::unique_ptr<Bench> hd_bench_of(int unit);
std::unique_ptr<Bench> dhd_bench_of(int unit);
std::unique_ptr<Bench> haply_bench();
std::unique_ptr<Bench> spacemouse_bench();
std::unique_ptr<Bench> pointer_bench();
std::unique_ptr<Bench> udp_bench();
std::unique_ptr<Bench> shm_bench();

using test::minus;
using test::size;

// An open device with the guard around it, ticked by the test on the real clock.
class Ticker {
 public:
  explicit Ticker(const std::string& uri, float watchdog_s = 15e-3F)
      : Ticker(open_device(uri), watchdog_s) {}
  Ticker(const Device& open, float watchdog_s) : device(open) {
    guard.max_force_n = 3;
    guard.max_speed_m_per_s = 1e4F;  // the test's hand jumps, and may take any energy
    guard.stored_energy_j = 1e6F;
    guard.ramp_s = 0;
    guard.watchdog_s = watchdog_of(device.info, watchdog_s);
  }
  ~Ticker() { close(); }
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;

  void close() {
    if (device.close != nullptr) device.close(device.self);
    device.close = nullptr;
  }

  void tick(Vec3 force_n, Vec3 torque_nm = {}) {
    next_ns_ = std::max(next_ns_ + 1'000'000, monotonic_now_ns() - 1'000'000);
    monotonic_clock().sleep_until_ns(nullptr, next_ns_);
    MotorReport motor;
    if (device.motor != nullptr && device.motor(device.self, motor)) guard_motor(state, motor);
    answered = device.read(device.self, next_ns_, sample);
    usable = guard_sample(guard, state, answered, sample, next_ns_);
    (void)guard_force(guard, state, force_n);
    (void)guard_torque(guard, device.info.max_torque_nm, state, torque_state, torque_nm);
    device.write(device.self, guard_command(guard, state, torque_state));
  }

  // Ticks until `done`, at most a second; a fault due to this busy machine is acknowledged.
  bool tick_until(Vec3 force_n, const std::function<bool()>& done) {
    for (int i = 0; i < 1000; ++i) {
      tick(force_n);
      if (done()) return true;
      if (state.fault != Fault::kNone) (void)guard_rearm(state, state.fault);
    }
    return false;
  }

  // The device's words after it has failed for good; waits at most a second.
  std::string trouble_under(Vec3 force_n) {
    (void)tick_until(force_n, [this] { return !trouble_of(device).empty(); });
    return trouble_of(device);
  }

  Device device;
  GuardConfig guard;
  GuardState state = guard_start(), torque_state = guard_start();
  Sample sample = {};
  bool answered = false, usable = false;

 private:
  std::int64_t next_ns_ = monotonic_now_ns();
};

}  // namespace stylet::hal
