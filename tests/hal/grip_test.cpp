// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/grip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hal/base/rotation.h"
#include "hal/base/vector.h"

namespace stylet::hal {
namespace {

constexpr float kRoot = 0.70710678F;

Sample sample_at(Vec3 position_m, Quat rotation = {1, 0, 0, 0}, std::uint32_t buttons = 0) {
  return {1, 0, {position_m, rotation}, buttons};
}

GripConfig plain() {
  GripConfig config;
  config.enabled = true;
  return config;
}

GripConfig pivoting() {
  GripConfig config = plain();
  config.pivots = true;
  config.pivot_depth_m = 0.16F;
  return config;
}

void expect_near(Vec3 a, Vec3 b, float bound) {
  EXPECT_NEAR(a.x, b.x, bound);
  EXPECT_NEAR(a.y, b.y, bound);
  EXPECT_NEAR(a.z, b.z, bound);
}

TEST(Grip, NotEnabledLeavesPoseAndForceAsTheyAre) {
  GripState state;
  const Pose pose = grip_pose({}, state, sample_at({1, -2, -0.0F}, {0, 0, 1, 0}, ~0U));
  EXPECT_EQ(pose.position_m.y, -2);
  EXPECT_TRUE(std::signbit(pose.position_m.z));
  EXPECT_EQ(pose.rotation.y, 1);
  EXPECT_EQ(grip_wrench({}, state, {{1, 2, 3}, {4, 5, 6}}).torque_nm.z, 6);
  GripConfig doubled;
  doubled.force_scale = 2;
  EXPECT_EQ(grip_wrench(doubled, state, {{1, 2, 3}, {}}).force_n.z, 3);
  EXPECT_EQ(grip_stiffness({}, state), 1);
}

TEST(Grip, StartsWhereTheNeedleIsWhereverTheDeviceIs) {
  GripState state;
  const Pose pose = grip_pose(plain(), state, sample_at({0.1F, 0.2F, 0.3F}, {kRoot, kRoot, 0, 0}));
  expect_near(pose.position_m, {}, 0);
  EXPECT_NEAR(pose.rotation.w, 1, 1e-6F);
}

TEST(Grip, ScalesAndTurnsMotionAndTurnsForceBack) {
  GripConfig config = plain();
  config.motion_scale = 2;
  config.force_scale = 0.5F;
  config.turn = {kRoot, 0, kRoot, 0};  // about y: the device's z is the needle's x
  GripState state;
  (void)grip_pose(config, state, sample_at({1, 1, 1}));
  const Pose pose = grip_pose(config, state, sample_at({1, 1, 1.25F}));
  expect_near(pose.position_m, {0.5F, 0, 0}, 1e-6F);
  const Wrench felt = grip_wrench(config, state, {{8, 0, 0}, {4, 0, 0}});
  expect_near(felt.force_n, {0, 0, 4}, 1e-5F);
  expect_near(felt.torque_nm, {0, 0, 1}, 1e-5F);
  EXPECT_FLOAT_EQ(grip_stiffness(config, state), 1);
}

TEST(Grip, ADeviceThatComesBackElsewhereTakesUpTheNeedleWhereItIs) {
  GripState state;
  (void)grip_pose(plain(), state, sample_at({}));
  (void)grip_pose(plain(), state, sample_at({0, 0, -0.02F}));
  grip_take_up(state);
  const Pose back = grip_pose(plain(), state, sample_at({0.1F, 0, 0.3F}, {kRoot, kRoot, 0, 0}));
  expect_near(back.position_m, {0, 0, -0.02F}, 1e-7F);
  EXPECT_NEAR(back.rotation.w, 1, 1e-6F);
}

// If a needle is turned by half a turn about an axis across it, its roll is undefined.
TEST(Grip, HandThatIsUpsideDownDoesNotRollThePivotingShaft) {
  GripState state;
  (void)grip_pose(pivoting(), state, sample_at({}));
  const Pose pose = grip_pose(pivoting(), state, sample_at({}, {0, 1, 0, 0}));
  EXPECT_NEAR(std::fabs(pose.rotation.w), 1, 1e-6F);
  expect_near({pose.rotation.x, pose.rotation.y, pose.rotation.z}, {}, 1e-6F);
}

// A thumb on the plunger: what the device tells, and the button's force while it is pressed.
TEST(Grip, APlungersButtonAddsItsForce) {
  GripConfig config;
  Sample sample = sample_at({0, 0, 0});
  sample.plunger_n = 2;
  sample.buttons = 1U << 4U;
  EXPECT_EQ(plunger_force(config, sample), 2);
  config.plunger_button = 4;
  config.plunger_n = -5;
  EXPECT_EQ(plunger_force(config, sample), -3);
  sample.buttons = 1U << 3U;
  EXPECT_EQ(plunger_force(config, sample), 2);
}

TEST(Grip, ClutchHoldsTheNeedleAndFadesTheForce) {
  GripConfig config = plain();
  config.clutch_button = 2;
  GripState state;
  const Wrench load = {{1, 0, 0}, {}};
  (void)grip_pose(config, state, sample_at({0, 0, 0}));
  const Pose before = grip_pose(config, state, sample_at({0, 0, -0.03F}));
  float last = grip_wrench(config, state, load).force_n.x;
  EXPECT_EQ(last, 1);
  for (int tick = 0; tick < 20; ++tick) {
    const Pose held = grip_pose(config, state, sample_at({0.2F, 0, 0}, {kRoot, 0, kRoot, 0}, 4));
    expect_near(held.position_m, before.position_m, 0);
    last = grip_wrench(config, state, load).force_n.x;
  }
  EXPECT_NEAR(last, 0, 1e-6F);
  Pose after = grip_pose(config, state, sample_at({0.2F, 0, 0}, {kRoot, 0, kRoot, 0}));
  expect_near(after.position_m, before.position_m, 1e-7F);
  EXPECT_NEAR(after.rotation.w, 1, 1e-6F);
  after = grip_pose(config, state, sample_at({0.2F, 0, -0.01F}, {kRoot, 0, kRoot, 0}));
  expect_near(after.position_m, {0, 0, -0.04F}, 1e-7F);
  for (int tick = 1; tick <= 300; ++tick) {
    const float felt = grip_wrench(config, state, load).force_n.x;
    EXPECT_NEAR(felt, static_cast<float>(tick) / 300, 1e-4F);
  }
}

TEST(Grip, BoxKeepsTheBaseInside) {
  GripConfig config = plain();
  config.box_low_m = {-0.01F, -0.01F, -0.05F};
  config.box_high_m = {0.01F, 0.01F, 0};
  GripState state;
  (void)grip_pose(config, state, sample_at({0, 0, 0}));
  expect_near(grip_pose(config, state, sample_at({1, -1, -1})).position_m, {0.01F, -0.01F, -0.05F},
              0);
  expect_near(grip_pose(config, state, sample_at({0, 0, -0.02F})).position_m, {0, 0, -0.02F},
              1e-7F);
}

TEST(Grip, PivotingShaftPassesThroughTheEntryAndRollsWithTheHand) {
  const GripConfig config = pivoting();
  GripState state;
  (void)grip_pose(config, state, sample_at({}));
  const float half = 0.25F;  // of the roll
  const Quat roll = {std::cos(half), 0, 0, std::sin(half)};
  for (const Vec3 at :
       {Vec3{0.03F, -0.05F, -0.02F}, Vec3{-0.08F, 0.01F, -0.1F}, Vec3{0, 0, 0.05F}}) {
    const Pose pose = grip_pose(config, state, sample_at(at, roll));
    const Vec3 way = {-at.x, -at.y, -0.16F - at.z};
    const Vec3 shaft = rotate(pose.rotation, {0, 0, -1});
    expect_near(cross(way, shaft), {}, 1e-7F);
    EXPECT_GT(way.z * shaft.z, 0);
  }
  const Pose straight = grip_pose(config, state, sample_at({0, 0, -0.05F}, roll));
  EXPECT_NEAR(straight.rotation.z, roll.z, 1e-6F);
}

TEST(Grip, HubStaysAboveTheSkin) {
  const GripConfig config = pivoting();
  GripState state;
  (void)grip_pose(config, state, sample_at({}));
  const Pose pose = grip_pose(config, state, sample_at({0.001F, 0, -0.3F}));
  EXPECT_FLOAT_EQ(pose.position_m.z, -0.15F);
  EXPECT_TRUE(std::isfinite(grip_wrench(config, state, {{}, {1, 1, 1}}).force_n.x));
}

// Rotation vector from one pose to the next, in double: the small angles are differences.
std::array<double, 3> turn_between(const Quat& from, const Quat& to) {
  const Quat q = product(to, {from.w, -from.x, -from.y, -from.z});
  const double sign = q.w < 0 ? -2 : 2;
  return {sign * static_cast<double>(q.x), sign * static_cast<double>(q.y),
          sign * static_cast<double>(q.z)};
}

double dot(Vec3 a, const std::array<double, 3>& b) {
  return static_cast<double>(a.x) * b[0] + static_cast<double>(a.y) * b[1] +
         static_cast<double>(a.z) * b[2];
}

// One small motion of the device, whose rotation is fixed if the needle pivots. Its work against
// the force that it renders is the work at the needle times force_scale / motion_scale.
void expect_same_work(GripConfig config, std::mt19937& random, bool turns) {
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto vector = [&](float size) {
    return Vec3{size * uniform(random), size * uniform(random), size * uniform(random)};
  };
  GripState state;
  (void)grip_pose(config, state, sample_at({}));
  const Vec3 at = vector(0.06F), step = vector(2e-4F);
  const float angle = turns ? 1e-3F * uniform(random) : 0;
  const Quat turn = {1, 0, angle / 2, 0};
  const Pose from =
      grip_pose(config, state, sample_at({at.x - step.x, at.y - step.y, at.z - step.z}));
  const Pose to =
      grip_pose(config, state, sample_at({at.x + step.x, at.y + step.y, at.z + step.z}, turn));
  (void)grip_pose(config, state, sample_at(at));
  const Wrench needle = {vector(5), vector(0.5F)};
  const Wrench felt = grip_wrench(config, state, needle);
  const std::array<double, 3> moved = {2 * static_cast<double>(step.x),
                                       2 * static_cast<double>(step.y),
                                       2 * static_cast<double>(step.z)};
  const double at_device =
      dot(felt.force_n, moved) + dot(felt.torque_nm, {0, static_cast<double>(angle), 0});
  const std::array<double, 3> base = {
      static_cast<double>(to.position_m.x) - static_cast<double>(from.position_m.x),
      static_cast<double>(to.position_m.y) - static_cast<double>(from.position_m.y),
      static_cast<double>(to.position_m.z) - static_cast<double>(from.position_m.z)};
  const double at_needle =
      dot(needle.force_n, base) + dot(needle.torque_nm, turn_between(from.rotation, to.rotation));
  const double scale = static_cast<double>(config.force_scale / config.motion_scale);
  EXPECT_NEAR(at_device, scale * at_needle, 5e-6 * scale);
}

TEST(Grip, PowerAtTheDeviceIsPowerAtTheNeedleTimesTheScales) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    GripConfig config = i % 2 == 0 ? pivoting() : plain();
    config.motion_scale = i % 4 < 2 ? 1.0F : 0.5F;
    config.force_scale = i % 3 == 0 ? 1.0F : 2.0F;
    config.turn = i % 5 == 0 ? Quat{0.5F, 0.5F, 0.5F, 0.5F} : Quat{1, 0, 0, 0};
    expect_same_work(config, random, !config.pivots && i % 5 != 0);
  }
}

// A lateral load at the tip, at a depth `inside` beyond the entry, follows the law of the lever.
TEST(Grip, LateralForceFollowsTheLever) {
  const GripConfig config = pivoting();
  GripState state;
  (void)grip_pose(config, state, sample_at({}));
  (void)grip_pose(config, state, sample_at({0, 0, -0.04F}));  // 120 mm above, 40 mm inside
  const float load = 0.6F, inside = 0.04F, outside = 0.12F;
  const Vec3 torque = cross({0, 0, -(inside + outside)}, {load, 0, 0});
  const Wrench felt = grip_wrench(config, state, {{load, 0, 0}, torque});
  expect_near(felt.force_n, {-load * inside / outside, 0, 0}, 1e-6F);
  expect_near(felt.torque_nm, {}, 0);
}

}  // namespace
}  // namespace stylet::hal
