// SPDX-License-Identifier: Apache-2.0
// The guard exactly at its limits, and its guard of torques: these tests notice wrong lines of
// guard.cpp that no other test does.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "guard_desk.h"

namespace stylet::hal {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Armed from the start, without a ramp, and nothing damped.
Desk plain_desk() {
  Desk desk;
  desk.config.dead_man_button = -1;
  desk.config.ramp_s = 0;
  desk.config.passivity_damping_n_s_per_m = 0;
  return desk;
}

// ==== Buttons

TEST(GuardButtons, NumberZeroIsAButton) {
  Desk desk;
  desk.config.dead_man_button = 0;
  const auto tick = [&desk](std::uint32_t buttons) {
    desk.now_ns += 1'000'000;
    const Sample sample = {++desk.seq, desk.now_ns, {{}, {1, 0, 0, 0}}, buttons};
    (void)guard_sample(desk.config, desk.state, true, sample, desk.now_ns);
    return size(guard_force(desk.config, desk.state, desk.asked_n));
  };
  EXPECT_EQ(tick(0), 0);
  EXPECT_EQ(desk.state.mode, GuardMode::kUnarmed);
  EXPECT_GT(tick(1), 0);
  desk.config.dead_man_button = -1;
  desk.config.acknowledge_button = 0;
  guard_trip(desk.state, Fault::kTooLate);
  for (int i = 0; i < 25; ++i) (void)tick(0);
  EXPECT_EQ(desk.state.fault, Fault::kTooLate);
  (void)tick(1);
  EXPECT_EQ(desk.state.fault, Fault::kNone);
}

// Only a release that is seen after the acknowledgement of the fault counts.
TEST(GuardButtons, AReleaseBeforeTheRearmDoesNotCount) {
  Desk desk;
  desk.tick(5, true);
  guard_trip(desk.state, Fault::kKernelFault);
  desk.tick(5, false);
  ASSERT_TRUE(guard_rearm(desk.state, Fault::kKernelFault));
  (void)guard_force(desk.config, desk.state, desk.asked_n);
  EXPECT_EQ(desk.state.mode, GuardMode::kLetGo);
  (void)desk.tick(false);
  EXPECT_EQ(desk.state.mode, GuardMode::kUnarmed);
}

// ==== Samples and motion

TEST(GuardMotion, AllowedWayGrowsWithTheTicksMissed) {
  for (const float moved_m : {0.0109F, 0.0111F}) {  // 5 mm, and 2 m/s for three ticks
    Desk desk = plain_desk();
    desk.tick(5, false);
    desk.miss(2);
    desk.position_m.x = moved_m;
    EXPECT_EQ(desk.hear(false), moved_m < 0.011F) << moved_m;
  }
}

TEST(GuardMotion, MotionAtItsLimitIsAllowed) {
  Desk jump = plain_desk();
  jump.tick(1, false);
  jump.config.max_speed_m_per_s = 0;
  jump.position_m.x = kJumpM;
  EXPECT_TRUE(jump.hear(false));
  Desk speed = plain_desk();
  speed.config.period_s = 0x1p-10F;
  speed.config.max_speed_m_per_s = 2;
  speed.tick(1, false);
  speed.state.energy.velocity_m_per_s = {2, 0, 0};
  speed.position_m.x = 0x1p-9F;         // 2 m/s for a tick
  speed.now_ns += 976'563 - 1'000'000;  // the next tick comes after a period of 2^-10 s, rounded
  EXPECT_TRUE(speed.hear(false));
  EXPECT_EQ(speed.state.energy.velocity_m_per_s.x, 2);
  EXPECT_EQ(speed.state.fault, Fault::kNone);
}

// ==== Energy

// What the observer has counted after the hand was pulled by `way_m` along x in so many ticks.
double counted_j(Desk& desk, float way_m, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    desk.position_m.x += way_m / static_cast<float>(ticks);
    (void)desk.tick(false);
  }
  return desk.state.energy.energy_j;
}

TEST(GuardEnergy, UntilTheForceIsFullTheForceAskedForCountsUpToItsLimit) {
  for (const float asked_n : {1.0F, 20.0F}) {
    Desk desk = plain_desk();
    desk.config.ramp_s = 10;
    desk.asked_n = {asked_n, 0, 0};
    desk.tick(5, false);
    const double felt_n = asked_n < 8 ? 1 : 8;
    EXPECT_NEAR(counted_j(desk, 1e-3F, 50), -felt_n * 1e-3, 1e-6 * felt_n);
  }
}

TEST(GuardEnergy, PositionFollowsAtTheDistanceOfTheResolution) {
  Desk desk = plain_desk();
  desk.config.device.resolution_m = 1e-4F;
  desk.asked_n = {1, 0, 0};
  desk.tick(5, false);
  EXPECT_NEAR(counted_j(desk, 1e-3F, 10), -0.9e-3, 1e-8);
}

TEST(GuardEnergy, DampingOfTheDeviceIsSubtracted) {
  Desk desk = plain_desk();
  desk.config.device.damping_n_s_per_m = 2;
  desk.asked_n = {};
  desk.tick(5, false);
  EXPECT_NEAR(counted_j(desk, 0.01F, 200), 2 * 0.05 * 0.01, 0.05e-3);  // less at first
}

TEST(GuardEnergy, TheDelayedForceLiesBetweenThoseOfTwoTicks) {
  Desk desk = plain_desk();
  desk.config.device.delay_s = 1.5e-3F;
  desk.asked_n = {1, 0, 0};
  desk.tick(20, false);
  EXPECT_NEAR(counted_j(desk, 1e-3F, 10), -1e-3, 1e-8);
}

TEST(GuardEnergy, NothingIsDampedWhileNoEnergyWasMade) {
  Desk desk = plain_desk();
  desk.config.passivity_damping_n_s_per_m = 2;
  desk.asked_n = {};
  EXPECT_EQ(counted_j(desk, 0.01F, 200), 0);
  EXPECT_EQ(desk.state.counters.force_damped, 0U);
}

TEST(GuardEnergy, LossIsAFaultBeyondItsBarAndIsForgivenByTheRearm) {
  Desk desk = plain_desk();
  desk.config.passivity_damping_n_s_per_m = 2;
  desk.tick(5, false);
  desk.state.energy.energy_j = -kLostEnergyJ;
  desk.tick(1, false);
  EXPECT_EQ(desk.state.fault, Fault::kNone);
  desk.state.energy.energy_j = -1.1 * kLostEnergyJ;
  desk.tick(25, false);
  ASSERT_EQ(desk.state.fault, Fault::kEnergy);
  ASSERT_TRUE(guard_rearm(desk.state, Fault::kEnergy));
  EXPECT_EQ(desk.state.energy.energy_j, 0);
  desk.state.energy.energy_j = 0.01;
  guard_trip(desk.state, Fault::kTooLate);
  desk.tick(25, false);
  ASSERT_TRUE(guard_rearm(desk.state, Fault::kTooLate));
  EXPECT_EQ(desk.state.energy.energy_j, 0.01);
}

TEST(GuardEnergy, StaysFiniteAfterAForceThatWasNot) {
  Desk desk = plain_desk();
  desk.tick(5, false);
  desk.asked_n = {kNan, 0, 0};
  (void)desk.tick(false);
  desk.asked_n = {};
  EXPECT_TRUE(std::isfinite(counted_j(desk, 1e-3F, 10)));
}

// ==== Heat

TEST(GuardHeat, ContinuousForceAboveTheLargestAllowsNoMore) {
  Desk desk = plain_desk();
  desk.config.continuous_force_n = 20;
  desk.asked_n = {0, 30, 0};
  desk.tick(200, false);
  EXPECT_EQ(size(desk.state.force_n), 8);
}

// A fall from F in 20 ms takes F^2 (20 ms / 3) of the budget, and a tick passes before it begins.
TEST(GuardHeat, ForceLeavesRoomForItsOwnFall) {
  Desk desk = plain_desk();
  desk.config.continuous_force_n = 0.3F;
  desk.config.thermal_s = 1;
  desk.config.max_slew_n_per_s = 10000;
  desk.asked_n = {0, 30, 0};
  desk.state.heat_n2 = 0.8 * 0.09;
  EXPECT_NEAR(size(desk.tick(false)), std::sqrt(0.2 * 0.09 / (0.02 / 3 + 0.001)), 1e-4);
}

// ==== Buzzing

// How many turns are counted of a force that changes sign every so many ticks.
bool buzzes(int half_period_ticks) {
  Desk desk = plain_desk();
  for (int i = 0; i < 40 * half_period_ticks && desk.state.fault == Fault::kNone; ++i) {
    desk.asked_n = {i / half_period_ticks % 2 == 0 ? 1.0F : -1.0F, 0, 0};
    (void)desk.tick(false);
  }
  return desk.state.fault == Fault::kBuzz;
}

TEST(GuardBuzz, TurnsAreAtMostHalfAPeriodApart) {
  EXPECT_TRUE(buzzes(25));
  EXPECT_FALSE(buzzes(26));
}

TEST(GuardBuzz, SwingsBeforeTheButtonWasPressedAreForgotten) {
  Desk desk;
  desk.config.ramp_s = 0;
  desk.tick(5, false);
  desk.state.buzz = {{}, {-3, 0, 0}, kBuzzTurns - 1, 0};
  (void)desk.tick(true);
  EXPECT_EQ(desk.state.mode, GuardMode::kLive);
  EXPECT_EQ(desk.state.fault, Fault::kNone);
}

// Forces that swing about other forces, in all directions. In the tick in which the fault is
// latched the force makes one step, not a second one for the fade.
TEST(GuardBuzz, ForceAtTheFaultKeepsTheSlewLimit) {
  std::mt19937_64 engine(33);
  const auto draw = [&engine] { return static_cast<float>(engine() >> 40U) * 0x1p-23F - 1; };
  int faults = 0;
  for (int session = 0; session < 300; ++session) {
    Desk desk = plain_desk();
    desk.config.max_slew_n_per_s = 1500 + 1000 * draw();
    const Vec3 about = {4 * draw(), 4 * draw(), 4 * draw()};
    const Vec3 swing = {6 * draw(), 6 * draw(), 6 * draw()};
    const int half_period_ticks = 5 + static_cast<int>(4 * draw());
    const double most = static_cast<double>(desk.config.max_slew_n_per_s) * 1e-3 * (1 + 1e-5);
    Vec3 last = {};
    for (int i = 0; i < 400; ++i) {
      const float side = i / half_period_ticks % 2 == 0 ? 1 : -1;
      desk.asked_n = {about.x + side * swing.x, about.y + side * swing.y, about.z + side * swing.z};
      const Vec3 force = desk.tick(false);
      ASSERT_LE(size({force.x - last.x, force.y - last.y, force.z - last.z}), most)
          << "session " << session << ", tick " << i;
      last = force;
    }
    faults += desk.state.fault == Fault::kBuzz ? 1 : 0;
  }
  EXPECT_GT(faults, 100);
}

// ==== Motors that have stopped by themselves

TEST(GuardMotor, AReportOfStoppedMotorsOnlyTakesForceAway) {
  std::mt19937_64 engine(6);
  const auto draw = [&engine] { return static_cast<float>(engine() >> 40U) * 0x1p-24F; };
  for (int i = 0; i < 100; ++i) {
    Desk desk = plain_desk();
    desk.asked_n = {1 + 3 * draw(), 0, 0};
    desk.tick(20, false);
    const Vec3 ours_n = desk.state.force_n;
    ASSERT_FLOAT_EQ(ours_n.x, desk.asked_n.x);
    const float share = 2 * draw();
    const Vec3 theirs_n = i % 5 == 0 ? Vec3{kNan, 0, 0} : Vec3{share * ours_n.x, 0, 0};
    guard_motor(desk.state, {theirs_n, {}, desk.state.arming, true});
    EXPECT_EQ(desk.state.fault, Fault::kForceExpired);
    const float left_n = i % 5 == 0 ? 0 : std::min(ours_n.x, theirs_n.x);
    EXPECT_FLOAT_EQ(desk.state.force_n.x, left_n) << share;
  }
}

// ==== Torque

struct TorqueDesk {
  Desk force = plain_desk();
  GuardState torque = guard_start();
  float most_nm = 0.1F;

  Vec3 tick(Vec3 torque_nm, bool pressed = false) {
    (void)force.tick(pressed);
    return guard_torque(force.config, most_nm, force.state, torque, torque_nm);
  }
};

TEST(GuardTorque, OfADeviceWithoutTorqueIsZero) {
  TorqueDesk desk;
  desk.most_nm = 0;
  for (const float asked_nm : {0.1F, kNan}) EXPECT_EQ(size(desk.tick({asked_nm, 0, 0})), 0);
  EXPECT_EQ(desk.force.state.fault, Fault::kNone);
}

TEST(GuardTorque, RisesToItsLimitInHalfTheTimeOfAFade) {
  TorqueDesk desk;
  for (int tick = 1; tick <= 15; ++tick) {
    const Vec3 felt = desk.tick({0.3F, 0.4F, 0});
    EXPECT_NEAR(size(felt), 0.1 * std::min(tick, 10) / 10, 1e-7) << tick;
    EXPECT_NEAR(felt.y * 3, felt.x * 4, 1e-7);
  }
}

TEST(GuardTorque, EndsWithTheForceAndComesBackWithIt) {
  TorqueDesk desk;
  for (int i = 0; i < 20; ++i) (void)desk.tick({0.05F, 0, 0});
  EXPECT_FLOAT_EQ(desk.tick({0.05F, 0, 0}).x, 0.05F);
  guard_trip(desk.force.state, Fault::kTooLate);
  for (int tick = 1; tick <= 25; ++tick) {
    EXPECT_NEAR(size(desk.tick({0.05F, 0, 0})), 0.05 * std::max(0, 20 - tick) / 20, 1e-8) << tick;
  }
  EXPECT_EQ(desk.torque.fault, Fault::kTooLate);
  ASSERT_TRUE(guard_rearm(desk.force.state, Fault::kTooLate));
  for (int i = 0; i < 20; ++i) (void)desk.tick({0.05F, 0, 0});
  EXPECT_FLOAT_EQ(desk.tick({0.05F, 0, 0}).x, 0.05F);
}

// As for a force: without a sample no time has passed, but a falling torque goes on falling by a
// period.
TEST(GuardTorque, WithoutASampleStaysOrGoesOnFalling) {
  TorqueDesk desk;
  for (int i = 0; i < 20; ++i) (void)desk.tick({0.05F, 0, 0});
  const auto again = [&] {
    (void)guard_force(desk.force.config, desk.force.state, desk.force.asked_n);
    return guard_torque(desk.force.config, desk.most_nm, desk.force.state, desk.torque,
                        {0.09F, 0, 0});
  };
  for (int call = 0; call < 5; ++call) EXPECT_FLOAT_EQ(again().x, 0.05F);
  guard_trip(desk.force.state, Fault::kTooLate);
  for (int call = 1; call <= 25; ++call) {
    EXPECT_NEAR(size(again()), 0.05 * std::max(0, 20 - call) / 20, 1e-8) << call;
  }
}

TEST(GuardTorque, ThatIsNotFiniteEndsBothAtOnce) {
  TorqueDesk desk;
  for (int i = 0; i < 20; ++i) (void)desk.tick({0.05F, 0, 0});
  EXPECT_EQ(size(desk.tick({kNan, 0, 0})), 0);
  EXPECT_EQ(desk.force.state.fault, Fault::kForceNotFinite);
  EXPECT_EQ(size(desk.force.tick(false)), 0);
}

// A torque may swing by the same fraction of its limit as a force: the bar is 0.8 of 8 N, so 0.06
// of 0.1 N m is above it.
TEST(GuardTorque, BuzzesAsAForceDoes) {
  for (const float share : {0.6F, 0.05F}) {
    TorqueDesk desk;
    desk.force.asked_n = {};
    for (int i = 0; i < 1000 && desk.force.state.fault == Fault::kNone; ++i) {
      const double phase = 2 * 3.14159265358979324 * 40 * 1e-3 * i;
      (void)desk.tick({0, share * desk.most_nm * static_cast<float>(std::sin(phase)), 0});
    }
    EXPECT_EQ(desk.force.state.fault, share > 0.5F ? Fault::kBuzz : Fault::kNone) << share;
  }
}

TEST(GuardTorque, WarmsTheMotorsAsAForceDoes) {
  TorqueDesk desk;
  desk.force.config.continuous_force_n = 2;  // a quarter of 8
  desk.force.asked_n = {};
  Vec3 last = {};
  for (int i = 0; i < 400'000; ++i) last = desk.tick({0, 0, 1});
  EXPECT_NEAR(size(last), 0.025, 1e-4);
  EXPECT_LE(desk.torque.heat_n2, 0.025 * 0.025 * (1 + 1e-3));
}

// When the device turns by 0.2 rad about y with a torque of 0.05 N m along it, the hand is given 10
// mJ. When it turns against the torque, the hand gives them.
TEST(GuardTorque, WorkIsThatOfTheTurn) {
  for (const float way : {1.0F, -1.0F}) {
    TorqueDesk desk;
    desk.force.asked_n = {};
    for (int i = 0; i < 20; ++i) (void)desk.tick({0, way * 0.05F, 0});
    const double before_j = desk.force.state.energy.energy_j;
    for (int i = 1; i <= 200; ++i) {
      const float half = 0.5e-3F * static_cast<float>(i);
      desk.force.rotation = {std::cos(half), 0, std::sin(half), 0};
      (void)desk.tick({0, way * 0.05F, 0});
    }
    const double expected_j = std::min(-0.01 * static_cast<double>(way), 0.8 - before_j);
    EXPECT_NEAR(desk.force.state.energy.energy_j - before_j, expected_j, 1e-5) << way;
  }
}

TEST(GuardTorque, NeedsTheSameButton) {
  TorqueDesk desk;
  desk.force.config.dead_man_button = kButton;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(size(desk.tick({0.05F, 0, 0}, true)), 0);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(size(desk.tick({0.05F, 0, 0}, false)), 0);
  for (int i = 0; i < 20; ++i) (void)desk.tick({0.05F, 0, 0}, true);
  EXPECT_FLOAT_EQ(desk.tick({0.05F, 0, 0}, true).x, 0.05F);
  for (int i = 0; i < 20; ++i) (void)desk.tick({0.05F, 0, 0}, false);
  EXPECT_EQ(size(desk.tick({0.05F, 0, 0}, false)), 0);
}

}  // namespace
}  // namespace stylet::hal
