// SPDX-License-Identifier: Apache-2.0
// The pointer in virtual time: a millisecond a tick, posts when the test says so.
#include "hal/device/drivers/pointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "hal/device/devices.h"
#include "hal/guard/guard.h"
#include "vectors.h"

namespace stylet::hal {
namespace {

constexpr std::int64_t kTickNs = 1'000'000;
constexpr Quat kUpright = {1, 0, 0, 0};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

using test::minus;
using test::size;
Pose inward(double mm) {
  return {{0, 0, static_cast<float>(-mm * 1e-3)}, kUpright};
}

class PointerTest : public testing::Test {
 protected:
  PointerTest() {
    pointer_serve(true);
    device = open_device("pointer:");
  }
  ~PointerTest() override {
    device.close(device.self);
    pointer_serve(false);
  }

  bool tick() {
    now_ns += kTickNs;
    last = sample;
    return device.read(device.self, now_ns, sample);
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) {
      ASSERT_TRUE(tick());
      ASSERT_LE(size(minus(sample.pose.position_m, last.pose.position_m)),
                kPointerSpeedMPerS * 1e-3 * 1.001);
    }
  }
  double depth_mm() const { return -1e3 * static_cast<double>(sample.pose.position_m.z); }

  Device device;
  Sample sample = {0, 0, {{}, kUpright}, 0}, last = sample;
  std::int64_t now_ns = 5'000'000'000;
};

TEST_F(PointerTest, RestsUntilTheFirstPostAndTakesUpThere) {
  ticks(1000);
  EXPECT_EQ(sample.seq, 1000U);
  EXPECT_EQ(size(sample.pose.position_m), 0);
  ASSERT_TRUE(pointer_post(0, {{0.3F, -0.2F, 0.1F}, kUpright}, 5));  // wherever the pointer is
  ticks(400);
  EXPECT_EQ(size(sample.pose.position_m), 0);
  EXPECT_EQ(sample.buttons, 5U);
}

TEST_F(PointerTest, FollowsAnUnevenPageEvenly) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> pause(8, 33);  // 30 to 120 Hz
  ASSERT_TRUE(pointer_post(0, inward(0), 0));
  double slowest = 1, fastest = 0;
  int next_post = 0;
  for (int i = 0; i < 1000; ++i) {
    if (i == next_post) {
      ASSERT_TRUE(pointer_post(0, inward(0.1 * i), 0));  // 100 mm/s
      next_post += pause(random);
    }
    ticks(1);
    const double step_m = size(minus(sample.pose.position_m, last.pose.position_m));
    if (i > 200) slowest = std::min(slowest, step_m * 1e3);
    if (i > 200) fastest = std::max(fastest, step_m * 1e3);
  }
  // The mean pause is 20 ms. A hand that moves in steps of 2 mm becomes a needle of constant speed.
  EXPECT_GT(slowest, 0.06);
  EXPECT_LT(fastest, 0.14);
  EXPECT_NEAR(depth_mm(), 100 - 0.1e3 * (2 * kPointerFollowS + 0.01), 2.5);
  ticks(400);
  EXPECT_NEAR(depth_mm(), 0.1 * 999, 3.3);  // the newest post
}

TEST_F(PointerTest, ComesToRestAtThePostedPosition) {
  ASSERT_TRUE(pointer_post(0, inward(0), 0));
  ticks(1);
  ASSERT_TRUE(pointer_post(0, inward(20), 0));
  double furthest = 0;
  for (int i = 0; i < 490; ++i) {
    ticks(1);
    furthest = std::max(furthest, depth_mm());
  }
  EXPECT_NEAR(depth_mm(), 20, 1e-3);
  EXPECT_LE(furthest, 20.001);  // no overshoot
}

TEST_F(PointerTest, ALeapOfThePointerIsNoLeapOfTheNeedle) {
  ASSERT_TRUE(pointer_post(0, inward(-1000), 0));
  ticks(1);
  ASSERT_TRUE(pointer_post(0, inward(1000), 0));
  ticks(500);  // each tick within the largest speed
  EXPECT_NEAR(depth_mm(), 1e3 * kPointerSpeedMPerS * 0.5, 15);
}

TEST_F(PointerTest, TurnsTheShortWayAndNoFaster) {
  const Quat back = {-0.1F, 0, 0, 0.994987F};  // 191 degrees about z, or 169 the other way
  ASSERT_TRUE(pointer_post(0, inward(0), 0));
  ticks(1);
  ASSERT_TRUE(pointer_post(0, {{}, back}, 0));
  float most = 0;
  for (int i = 0; i < 490; ++i) {
    ticks(1);
    const Quat &a = last.pose.rotation, &b = sample.pose.rotation;
    most = std::max(most, std::fabs(2 * (a.w * b.z - a.z * b.w)));
    EXPECT_LE(b.z, 1e-6F);  // by way of -z
  }
  EXPECT_LE(most, static_cast<float>(kPointerTurnRadPerS) * 1.01e-3F);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(pointer_post(0, {{}, back}, 0));
    ticks(490);
  }
  const Quat& q = sample.pose.rotation;
  EXPECT_NEAR(std::fabs(q.w * back.w + q.z * back.z), 1, 1e-5);
}

TEST_F(PointerTest, SilenceEndsTheAnswerAndTheGuardSeesIt) {
  GuardConfig guard;
  GuardState state = guard_start();
  const auto guarded = [&] {
    const bool answered = tick();
    (void)guard_sample(guard, state, answered, sample, now_ns);
    (void)guard_force(guard, state, {0, 0, 1});
    return answered;
  };
  ASSERT_TRUE(pointer_post(0, inward(0), 0));
  ASSERT_TRUE(guarded());
  ASSERT_TRUE(pointer_post(0, inward(10), 0));
  int answers = 0;
  while (guarded()) ++answers;
  EXPECT_EQ(answers, 1 + kPointerGoneNs / kTickNs);
  EXPECT_NE(device.trouble(device.self), "");
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(guarded());
  EXPECT_EQ(state.fault, Fault::kDeviceSilent);
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(guarded());

  // The hand comes back somewhere else: it takes up the needle where that is, once somebody has
  // acknowledged.
  ASSERT_TRUE(pointer_post(0, inward(-300), 0));
  ASSERT_TRUE(guarded());
  EXPECT_TRUE(guard_rearm(state, Fault::kDeviceSilent));
  EXPECT_NEAR(depth_mm(), 10, 1e-3);
  ASSERT_TRUE(pointer_post(0, inward(-295), 0));
  for (int i = 0; i < 400; ++i) ASSERT_TRUE(guarded());
  EXPECT_NEAR(depth_mm(), 15, 0.01);
  EXPECT_EQ(state.fault, Fault::kNone);
}

TEST_F(PointerTest, APointerAtRestAnswersAsLongAsItsPageDoes) {
  pointer_stay();  // nothing was posted yet
  ASSERT_TRUE(pointer_post(0, inward(0), 0));
  ticks(1);
  ASSERT_TRUE(pointer_post(0, inward(10), 3));
  for (int i = 0; i < 10; ++i) {
    ticks(400);
    pointer_stay();
  }
  EXPECT_NEAR(depth_mm(), 10, 1e-3);
  EXPECT_EQ(sample.buttons, 3U);
  pointer_leave(0);
  pointer_stay();  // does not bring back a page that has gone
  EXPECT_FALSE(tick());
}

TEST_F(PointerTest, BetweenAttemptsThePointerMayGoAnywhere) {
  ASSERT_TRUE(pointer_post(0, inward(0), 0));
  ticks(1);
  ASSERT_TRUE(pointer_post(0, {{0, 0, -0.03F}, {0.8F, 0, 0, 0.6F}}, 0));
  ticks(450);
  const Sample end = sample;
  now_ns += 3'000'000'000;
  ASSERT_TRUE(pointer_post(0, inward(0), 0));  // as a page that starts again
  ticks(300);
  EXPECT_EQ(size(minus(sample.pose.position_m, end.pose.position_m)), 0);
  EXPECT_NEAR(sample.pose.rotation.z, end.pose.rotation.z, 1e-6);
  ASSERT_TRUE(pointer_post(0, inward(5), 0));
  ticks(450);
  EXPECT_NEAR(depth_mm(), 35, 0.01);
}

TEST_F(PointerTest, LeavingIsSilenceAtOnceAndAnotherPageTakesOver) {
  ASSERT_TRUE(pointer_post(0, inward(0), 0));
  ticks(1);
  ASSERT_TRUE(pointer_post(0, inward(30), 0));
  ticks(450);
  pointer_leave(0);
  EXPECT_FALSE(tick());
  EXPECT_FALSE(tick());
  ASSERT_TRUE(pointer_post(0, inward(0), 0));
  ticks(300);
  EXPECT_NEAR(depth_mm(), 30, 1e-2);
  // Another page takes over within one tick: its origin is not that of the first page.
  pointer_leave(0);
  ASSERT_TRUE(pointer_post(0, inward(-50), 0));
  ticks(300);
  EXPECT_NEAR(depth_mm(), 30, 1e-2);
}

TEST_F(PointerTest, AnInvalidPoseIsRefusedAndChangesNothing) {
  ASSERT_TRUE(pointer_post(0, inward(0), 0));
  ticks(1);
  for (const float bad : {kNan, kInfinity, -kInfinity, 2.01F, 3e38F}) {
    EXPECT_FALSE(pointer_post(0, {{bad, 0, 0}, kUpright}, 0)) << bad;
    EXPECT_FALSE(pointer_post(0, {{0, bad, 0}, kUpright}, 0)) << bad;
    EXPECT_FALSE(pointer_post(0, {{0, 0, bad}, kUpright}, 0)) << bad;
    EXPECT_FALSE(pointer_post(0, {{}, {bad, 0, 0, 0}}, 0)) << bad;
    EXPECT_FALSE(pointer_post(0, {{}, {1, bad, 0, 0}}, 0)) << bad;
    EXPECT_FALSE(pointer_post(0, {{}, {1, 0, 0, bad}}, 0)) << bad;
  }
  EXPECT_FALSE(pointer_post(0, {{}, {0, 0, 0, 0}}, 0));
  EXPECT_FALSE(pointer_post(0, {{}, {0.9F, 0, 0, 0}}, 0));
  EXPECT_FALSE(pointer_post(4, inward(0), 0));
  EXPECT_FALSE(pointer_post(0xffffffffU, inward(0), 0));
  pointer_leave(0xffffffffU);
  ticks(400);
  EXPECT_EQ(size(sample.pose.position_m), 0);
}

TEST_F(PointerTest, SamePostsInTheSameTicksGiveTheSameBits) {
  const auto play = [](Device& on) {
    std::vector<float> all;
    Sample told = {};
    for (int i = 0; i < 600; ++i) {
      if (i % 17 == 0) {
        const float a = static_cast<float>(i) * 1e-4F;
        EXPECT_TRUE(pointer_post(2, {{a, -a, 2 * a}, {0.8F, 0.6F, 0, 0}}, 0));
      }
      EXPECT_TRUE(on.read(on.self, 1'000'000'000 + i * kTickNs, told));
      const Pose& p = told.pose;
      all.insert(all.end(), {p.position_m.x, p.position_m.y, p.position_m.z, p.rotation.w,
                             p.rotation.x, p.rotation.y, p.rotation.z});
    }
    on.close(on.self);
    return all;
  };
  Device first = open_device("pointer:2");
  const auto expected = play(first);
  Device second = open_device("pointer:2");
  EXPECT_EQ(play(second), expected);
}

TEST_F(PointerTest, ManyThreadsMayPost) {
  std::vector<std::thread> pages;
  std::atomic<bool> begun{false};
  for (int page = 0; page < 4; ++page) {
    pages.emplace_back([page, &begun] {
      for (int i = 0; i < 20000; ++i) {
        // Only whole posts are taken: each rotation belongs to one position.
        const bool up = (page + i) % 2 == 0;
        EXPECT_TRUE(pointer_post(0, up ? Pose{{1, 1, 1}, kUpright} : Pose{{}, {0, 1, 0, 0}},
                                 up ? 0xffffffffU : 0U));
        begun = true;
      }
    });
  }
  while (!begun) std::this_thread::yield();
  ticks(490);  // less than the half second after which a page is gone
  for (std::thread& page : pages) page.join();
}

TEST_F(PointerTest, IsOpenedOnceAndOnlyWhereThereIsAPage) {
  const auto refusal = [](const std::string& uri) -> std::string {
    try {
      const Device opened = open_device(uri);
      opened.close(opened.self);
    } catch (const DeviceError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("pointer:0"), "pointer:0: this pointer holds another needle already");
  EXPECT_EQ(refusal("pointer:3"), "");
  EXPECT_EQ(refusal("pointer:3"), "");
  EXPECT_EQ(refusal("pointer:4"), "pointer:4: expected a number from 0 to 3, or nothing");
  EXPECT_EQ(refusal("pointer:00"), "pointer:00: expected a number from 0 to 3, or nothing");
  EXPECT_EQ(refusal("pointer:/"), "pointer:/: expected a number from 0 to 3, or nothing");
  pointer_serve(false);
  EXPECT_EQ(refusal("pointer:3"),
            "pointer:3: expected --console: it is the mouse or finger on its page");
  EXPECT_EQ(pointer_number("pointer:"), 0U);
  EXPECT_EQ(pointer_number("pointer:2"), 2U);
  EXPECT_EQ(pointer_number("hd:"), std::nullopt);
}

}  // namespace
}  // namespace stylet::hal
