// SPDX-License-Identifier: Apache-2.0
// The driver that hal/device/own_driver.md tells people to copy, in a process in virtual time: it
// keeps the rules of a device of force in a network. Its stand-in is a device that keeps its own
// rule: it ends each force 20 ms after it took the sample that the force answers.
#include "hal/device/example_driver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#include "device_bench.h"
#include "hal/device/link.h"
#include "virtual_process.h"

namespace stylet::hal {
namespace {

constexpr std::int64_t kMs = 1'000'000;

// The device, with the only port to which it answers. Its clock is an hour ahead of ours.
class PlumbStandIn {
 public:
  PlumbStandIn() : link_(udp_listen(test_port(), "plumb")), thread_([this] { run(); }) {}
  ~PlumbStandIn() {
    stop_ = true;
    thread_.join();
    link_.close(link_.self);
  }
  PlumbStandIn(const PlumbStandIn&) = delete;
  PlumbStandIn& operator=(const PlumbStandIn&) = delete;

  std::string uri() const { return "127.0.0.1:" + test_port(); }

  Vec3 position_m = {}, felt_n = {};
  std::uint32_t buttons = 0;
  std::int64_t delay_ns = 0;  // of what it sends
  bool silent = false, spoils = false, repeats = false;
  double steepest_n = 0;  // change of the force in a millisecond

 private:
  void run() {
    for (std::int64_t next_ns = test::virtual_now_ns(); !stop_; next_ns += kMs) {
      test::sleep_until_virtual(next_ns);
      const Vec3 before_n = felt_n;
      hear(next_ns);
      if (next_ns > ends_ns_) felt_n = {};
      steepest_n = std::max(steepest_n, size(minus(felt_n, before_n)));
      if (!silent) speak(next_ns);
    }
  }
  void hear(std::int64_t now_ns) {
    std::array<std::byte, 2 * sizeof(PlumbPacket)> room;
    PlumbPacket packet;
    while (const auto got = link_.receive(link_.self, room)) {
      if (!plumb_decode(std::span(room).first(*got), kPlumbForce, packet)) continue;
      link_.answer(link_.self);
      if (packet.number <= newest_force_) continue;
      newest_force_ = packet.number;
      const auto answered = static_cast<std::uint64_t>(packet.time_or_answered);
      const std::int64_t taken_ns = answered == 0 ? 0 : taken_ns_[answered % taken_ns_.size()];
      if (now_ns - taken_ns > kPlumbLifeNs) continue;
      ends_ns_ = taken_ns + kPlumbLifeNs;
      felt_n = {packet.vector_xyz[0], packet.vector_xyz[1], packet.vector_xyz[2]};
    }
  }
  void speak(std::int64_t now_ns) {
    if (!repeats) ++number_;
    taken_ns_[number_ % taken_ns_.size()] = now_ns - delay_ns;
    PlumbBytes bytes = plumb_encode({.kind = kPlumbSample,
                                     .buttons = buttons,
                                     .number = number_,
                                     .time_or_answered = now_ns - delay_ns + 3'600'000 * kMs,
                                     .vector_xyz = {position_m.x, position_m.y, position_m.z}});
    if (spoils) bytes[20] ^= std::byte{4};
    link_.send(link_.self, bytes);
  }

  Link link_;
  std::uint64_t number_ = 0, newest_force_ = 0;
  std::array<std::int64_t, 64> taken_ns_ = {};
  std::int64_t ends_ns_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

class ExampleDriver : public testing::Test {
 protected:
  Ticker& open() {
    ticker_.reset();
    wait(110);  // the stand-in's link serves its first peer until that has been silent for 100 ms
    ticker_ = std::make_unique<Ticker>(plumb_driver.open(device.uri(), 1), 3e-3F);
    return *ticker_;
  }
  // Ticks with 2 N for so long; returns the device's fault.
  Fault push(double for_ms) {
    for (double passed = 0; passed < for_ms; ++passed) ticker_->tick({0, 2, 0});
    return ticker_->state.fault;
  }
  void wait(double for_ms) {
    test::sleep_until_virtual(test::virtual_now_ns() + static_cast<std::int64_t>(for_ms * 1e6));
  }

  test::VirtualProcess& process = test::enter_virtual_time();  // before the device has a thread
  PlumbStandIn device;
  std::unique_ptr<Ticker> ticker_;
};

TEST_F(ExampleDriver, MeasuresAndPushes) {
  device.position_m = {0.01F, -0.02F, 0.03F};
  device.buttons = 5;
  Ticker& ticker = open();
  EXPECT_EQ(push(100), Fault::kNone);
  EXPECT_EQ(ticker.sample.pose.position_m.z, 0.03F);
  EXPECT_EQ(ticker.sample.buttons, 5U);
  EXPECT_NEAR(device.felt_n.y, 2, 1e-4);
  EXPECT_EQ(ticker.guard.watchdog_s, 15e-3F) << "as for every lossy way";
}

TEST_F(ExampleDriver, ItsForceEndsWhenTheLoopStops) {
  open();
  (void)push(100);
  wait(26);
  EXPECT_EQ(size(device.felt_n), 0);
  EXPECT_NE(push(100), Fault::kNone) << "somebody must acknowledge";
  EXPECT_EQ(size(device.felt_n), 0);
}

TEST_F(ExampleDriver, ASilentDeviceHasNoForceAndFails) {
  for (bool* trouble : {&device.silent, &device.spoils, &device.repeats}) {
    Ticker& ticker = open();
    (void)push(100);
    ASSERT_GT(size(device.felt_n), 1);
    *trouble = true;
    const Fault fault = push(26);
    EXPECT_EQ(size(device.felt_n), 0);
    EXPECT_EQ(fault, Fault::kDeviceSilent);
    EXPECT_THAT(trouble_of(ticker.device), testing::HasSubstr("check its power"));
    *trouble = false;
    (void)push(100);
    EXPECT_EQ(size(device.felt_n), 0) << "failed for good: it must be opened again";
  }
}

// Before any force there is nothing to end, and a gap of 90 ms is no failure; one of 15 ms is a
// fault of the guard, which clears by itself.
TEST_F(ExampleDriver, BeforeAnyForceItWaitsLonger) {
  Ticker& ticker = open();
  for (int i = 0; i < 5; ++i) ticker.tick({});
  device.silent = true;
  for (int i = 0; i < 90; ++i) ticker.tick({});
  EXPECT_EQ(trouble_of(ticker.device), "");
  device.silent = false;
  EXPECT_EQ(push(100), Fault::kNone);
  EXPECT_NEAR(device.felt_n.y, 2, 1e-4);
}

TEST_F(ExampleDriver, ASampleThatWasHeldUpCountsAsOld) {
  Ticker& ticker = open();
  (void)push(100);
  device.delay_ns = 9 * kMs;
  (void)push(10);
  const double age_ms = static_cast<double>(test::virtual_now_ns() - ticker.sample.t_ns) * 1e-6;
  EXPECT_NEAR(age_ms, 9, 2);
  EXPECT_TRUE(ticker.device.info.sends_times);
  device.delay_ns = 16 * kMs;
  EXPECT_NE(push(30), Fault::kNone) << "older than the watchdog";
}

TEST_F(ExampleDriver, PublishesAPlaceThatIsNoNumberForTheGuardToRefuse) {
  Ticker& ticker = open();
  (void)push(100);
  device.position_m.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(push(20), Fault::kStaleSamples);
  EXPECT_GT(ticker.state.counters.samples_not_finite, 5U);
}

// R10: the force fades in 20 ms, from the largest, which is 3 N.
TEST_F(ExampleDriver, ClosedItsForceFadesAndIsGone) {
  open();
  (void)push(100);
  device.steepest_n = 0;
  ticker_->close();
  wait(1);
  EXPECT_EQ(size(device.felt_n), 0);
  EXPECT_LE(device.steepest_n, 3.0 / 20 * 1.1);
}

TEST_F(ExampleDriver, SaysWhatIsWrongWhenItCannotBeOpened) {
  device.silent = true;
  const auto refusal = [](const std::string& rest) {
    try {
      const Device opened = plumb_driver.open(rest, 0.2);
      opened.close(opened.self);
    } catch (const DeviceError& error) {
      return std::string(error.what());
    }
    return std::string("opened");
  };
  EXPECT_EQ(refusal(device.uri()),
            "plumb:" + device.uri() + ": no sample came in 0.2 s: check its power and address");
  EXPECT_THAT(refusal("here"), testing::HasSubstr("plumb:here: expected ADDRESS:PORT"));
  EXPECT_THAT(refusal("127.0.0.1:1"), testing::HasSubstr("no program listens there"));
}

}  // namespace
}  // namespace stylet::hal
