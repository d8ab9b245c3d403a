// SPDX-License-Identifier: Apache-2.0
// A device that fails and is opened again, while a loop reads and writes it without a pause.
#include "hal/device/lasting_device.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <set>
#include <thread>
#include <vector>

#include "hal/device/devices.h"
#include "hal/device/patience.h"

namespace stylet::hal {
namespace {

// All devices that were ever made, so that a call of a closed one is noticed.
struct Factory;
struct Fake {
  Factory* factory = nullptr;
  std::atomic<bool> open{true}, failed{false};
  std::atomic<int> touched_closed{0}, touched{0};
  std::uint64_t seq = 0;
  float max_force_n = 3;
  Vec3 told_n = {};
};
struct Factory {
  std::mutex mutex;
  std::vector<std::unique_ptr<Fake>> made;
  std::vector<std::chrono::steady_clock::time_point> tries;
  std::atomic<bool> refuses{false}, starves{false}, closes_slowly{false};
  float max_force_n = 3;
  const char* identity = "";

  Device open() {
    const std::lock_guard lock(mutex);
    tries.push_back(std::chrono::steady_clock::now());
    if (refuses) throw DeviceError("fake: not there");
    if (starves) throw std::bad_alloc();
    made.push_back(std::make_unique<Fake>());
    made.back()->max_force_n = max_force_n;
    made.back()->factory = this;
    Fake* fake = made.back().get();
    return {fake,
            {.name = "a fake",
             .max_force_n = max_force_n,
             .max_slew_n_per_s = 100,
             .identity = identity},
            [](void* self, std::int64_t now_ns, Sample& out) {
              Fake& f = *static_cast<Fake*>(self);
              ++(f.open ? f.touched : f.touched_closed);
              if (f.failed) return false;
              out = {++f.seq, now_ns, {{}, {1, 0, 0, 0}}, 0};
              return true;
            },
            [](void* self, const Command& command) {
              Fake& f = *static_cast<Fake*>(self);
              f.told_n = command.force_n;
              ++(f.open ? f.touched : f.touched_closed);
            },
            [](void* self) {
              Fake& f = *static_cast<Fake*>(self);
              while (f.factory->closes_slowly) std::this_thread::yield();
              f.open = false;
            },
            [](void* self) -> std::string {
              return static_cast<Fake*>(self)->failed ? "the fake has failed" : "";
            }};
  }
  std::size_t count() {
    const std::lock_guard lock(mutex);
    return made.size();
  }
  Fake& newest() {
    const std::lock_guard lock(mutex);
    return *made.back();
  }
  Device lasting(bool (*may_open)() = nullptr) {
    return lasting_device(open(), {[this] { return open(); }, may_open, 0.01, 0.08, "fake"});
  }
};

// Ticks without a pause, for at most a minute, because this machine may be very busy.
bool ticks_until(const Device& device, const std::function<bool()>& done, std::uint64_t& seq) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!done()) {
    Sample sample = {};
    if (device.read(device.self, 0, sample)) {
      EXPECT_GT(sample.seq, seq);
      seq = sample.seq;
    }
    device.write(device.self, {{}});
    std::this_thread::yield();
    if (std::chrono::steady_clock::now() > end) return false;
  }
  return true;
}

// A driver that hangs while it closes must not hide the trouble before it.
TEST(LastingDevice, TroubleIsToldBeforeTheDeviceIsClosed) {
  Factory factory;
  factory.closes_slowly = true;
  const Device device = factory.lasting();
  factory.newest().failed = true;
  std::string told;
  for (int i = 0; i < 500 && told.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    told = trouble_of(device);
  }
  EXPECT_EQ(told, "the fake has failed");
  EXPECT_TRUE(factory.newest().open);
  factory.closes_slowly = false;
  device.close(device.self);
}

TEST(LastingDevice, PassesOnSamplesAndOrders) {
  Factory factory;
  const Device device = factory.lasting();
  for (std::uint64_t seq = 1; seq <= 3; ++seq) {
    Sample sample = {};
    EXPECT_TRUE(device.read(device.self, 77, sample));
    EXPECT_EQ(sample.seq, seq);
    EXPECT_EQ(sample.t_ns, 77);
  }
  device.write(device.self, {{0, 2, 0}});
  EXPECT_EQ(factory.newest().told_n.y, 2);
  EXPECT_EQ(trouble_of(device), "");
  EXPECT_EQ(device.info.max_force_n, 3);
  device.close(device.self);
  EXPECT_FALSE(factory.newest().open);
}

TEST(LastingDevice, IsOpenedAgainGoesOnCountingAndNobodyCallsAClosedOne) {
  Factory factory;
  const Device device = factory.lasting();
  std::uint64_t seq = 0;
  for (std::size_t times = 1; times <= 10; ++times) {
    ASSERT_TRUE(ticks_until(
        device, [&] { return factory.newest().touched > 100; }, seq));
    factory.newest().failed = true;
    ASSERT_TRUE(ticks_until(
        device, [&] { return factory.count() == times + 1; }, seq));
  }
  ASSERT_TRUE(ticks_until(
      device, [&] { return trouble_of(device).empty(); }, seq));
  device.close(device.self);
  for (const auto& each : factory.made) {
    EXPECT_FALSE(each->open);
    EXPECT_EQ(each->touched_closed, 0);
  }
}

TEST(LastingDevice, WaitsLongerEachTimeAndSaysWhy) {
  Factory factory;
  const Device device = factory.lasting();
  factory.refuses = true;
  factory.newest().failed = true;
  std::uint64_t seq = 0;
  const auto tries = [&] {
    const std::lock_guard lock(factory.mutex);
    return factory.tries.size();
  };
  ASSERT_TRUE(ticks_until(
      device, [&] { return tries() >= 7; }, seq));
  EXPECT_EQ(trouble_of(device), "not there");
  Sample sample = {};
  EXPECT_FALSE(device.read(device.self, 0, sample));
  factory.refuses = false;
  ASSERT_TRUE(ticks_until(
      device, [&] { return factory.count() == 2; }, seq));
  device.close(device.self);
  // The first entry is the opening itself. On a busy machine pauses are longer, never shorter.
  const auto pause_ms = [&](std::size_t i) {
    return std::chrono::duration<double, std::milli>(factory.tries[i + 1] - factory.tries[i])
        .count();
  };
  constexpr double kLeastMs[] = {0, 20, 40, 80, 80, 80};
  for (std::size_t i = 1; i < 6; ++i) EXPECT_GE(pause_ms(i), kLeastMs[i]) << i;
}

TEST(LastingDevice, WhateverOpeningThrowsIsReportedAndOpeningIsTriedAgain) {
  Factory factory;
  const Device device = factory.lasting();
  factory.starves = true;
  factory.newest().failed = true;
  std::uint64_t seq = 0;
  ASSERT_TRUE(ticks_until(
      device, [&] { return trouble_of(device) == std::bad_alloc().what(); }, seq));
  factory.starves = false;
  ASSERT_TRUE(ticks_until(
      device, [&] { return factory.count() == 2 && trouble_of(device).empty(); }, seq));
  device.close(device.self);
}

TEST(LastingDevice, ADeviceThatRendersLessIsRefusedAndNamed) {
  Factory factory;
  const Device device = factory.lasting();
  factory.newest().failed = true;
  factory.max_force_n = 1;
  std::uint64_t seq = 0;
  ASSERT_TRUE(ticks_until(
      device, [&] { return trouble_of(device).find("a fake is there instead") == 0; }, seq));
  EXPECT_FALSE(factory.newest().open);
  EXPECT_EQ(factory.newest().touched, 0);
  EXPECT_STREQ(device.info.name, "a fake");
  device.close(device.self);
}

// As strong as the first device, but another one.
TEST(LastingDevice, AnotherDeviceIsRefusedAndNamed) {
  Factory factory;
  factory.identity = "17";
  const Device device = factory.lasting();
  EXPECT_STREQ(device.info.identity, "17");
  factory.newest().failed = true;
  factory.identity = "18";
  std::uint64_t seq = 0;
  const auto told = [&](const char* what) {
    return ticks_until(
        device, [&] { return trouble_of(device).find(what) == 0; }, seq);
  };
  EXPECT_TRUE(told("18 is there instead of 17: connect that one again"));
  EXPECT_EQ(factory.newest().touched, 0);
  factory.identity = "17";
  EXPECT_TRUE(ticks_until(
      device, [&] { return trouble_of(device).empty() && factory.newest().touched > 0; }, seq));
  device.close(device.self);
}

TEST(Patience, IsOverAfterItsSecondsAndNeverWhereTheyHaveNoEnd) {
  const auto over_soon = [](double seconds) {
    const Patience patience(seconds);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return patience.over();
  };
  for (const double short_s : {-1.0, 0.0, 1e-3}) EXPECT_TRUE(over_soon(short_s)) << short_s;
  for (const double long_s : {60.0, 1e9, 1e10, 1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(over_soon(long_s)) << long_s;
  }
}

TEST(LastingDevice, DoesNotDisturbAnother) {
  Factory factory;
  const Device device = factory.lasting([] { return false; });
  factory.newest().failed = true;
  std::uint64_t seq = 0;
  ASSERT_TRUE(ticks_until(
      device, [&] { return trouble_of(device).find("no other of its kind") != std::string::npos; },
      seq));
  EXPECT_EQ(factory.count(), 1U);
  device.close(device.self);
}

}  // namespace
}  // namespace stylet::hal
