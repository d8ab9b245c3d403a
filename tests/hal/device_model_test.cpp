// SPDX-License-Identifier: Apache-2.0
// Models of devices by name, and the simulated hand with their dynamics, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <string>

#include "hal/device/drivers/simulated_hand.h"
#include "hal/device/model.h"
#include "hal/guard/guard.h"
#include "hal/loop/steady.h"

namespace stylet::hal {
namespace {

double of(float value) {
  return static_cast<double>(value);
}

TEST(DeviceModel, TheTwoOfTheReferencePageAreThere) {
  const DeviceModel* touch = find_device_model("touch");
  ASSERT_NE(touch, nullptr);
  EXPECT_EQ(touch->max_force_n, 3.3F);
  EXPECT_EQ(touch->continuous_force_n, 0.88F);
  EXPECT_EQ(touch->max_stiffness_n_per_m, 400);
  EXPECT_EQ(touch->motion.resolution_m, 0.055e-3F);
  EXPECT_EQ(touch->motion.delay_s, 1e-3F);
  EXPECT_EQ(touch->motion.friction_n, 0.26F);
  EXPECT_NEAR(of(touch->motion.damping_n_s_per_m), 400 * 1.5e-3, 1e-6);
  const DeviceModel* omega = find_device_model("omega.7");
  ASSERT_NE(omega, nullptr);
  EXPECT_EQ(omega->max_force_n, 12);
  EXPECT_EQ(omega->max_stiffness_n_per_m, 5000);
  EXPECT_EQ(find_device_model("Touch"), nullptr);
}

TEST(DeviceModel, EachIsPhysicallyPossible) {
  std::set<std::string> names;
  for (const DeviceModel& each : device_models()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_LE(each.continuous_force_n, each.max_force_n) << each.name;
    EXPECT_GE(of(each.max_slew_n_per_s) * of(kDecayS), of(each.max_force_n)) << each.name;
    EXPECT_LE(of(each.motion.delay_s), kMaxDelayTicks * 1e-3) << each.name;
    EXPECT_GT(each.max_stiffness_n_per_m, 0) << each.name;
    EXPECT_GT(each.motion.mass_kg, 0) << each.name;
    // Abbott and Okamura 2005: friction must dissipate the energy that a step of the encoder makes.
    const bool eaten = each.motion.friction_n == 0 ||
                       of(each.max_stiffness_n_per_m) <
                           2 * of(each.motion.friction_n) / of(each.motion.resolution_m);
    EXPECT_TRUE(eaten) << each.name;
  }
}

// Names as drivers give them, and other names that people use; both as in data sheets.
TEST(DeviceModel, DevicesAreRecognisedByTheNameTheyGive) {
  const auto model = [](const char* called) {
    const DeviceModel* found = recognise_device_model(called);
    return std::string(found != nullptr ? found->name : "none");
  };
  EXPECT_EQ(model("Touch"), "touch");
  EXPECT_EQ(model("Geomagic Touch"), "touch");
  EXPECT_EQ(model("Touch X"), "touch-x");
  EXPECT_EQ(model("TOUCHX"), "touch-x");
  EXPECT_EQ(model("PHANTOM Omni"), "omni");
  EXPECT_EQ(model("PHANTOM Desktop"), "touch-x");
  EXPECT_EQ(model("PHANTOM Premium 1.5"), "premium-1.5");
  EXPECT_EQ(model("Premium 6DOF"), "premium-1.5");
  EXPECT_EQ(model("PHANTOM Premium 3.0 6DOF"), "premium-3.0");
  EXPECT_EQ(model("omega.7"), "omega.7");
  EXPECT_EQ(model(""), "none");
  EXPECT_EQ(model("Wooden spoon"), "none");
}

TEST(DeviceModel, NoModelIsMoreCarefulThanAnUnknownDevice) {
  const DeviceModel& unknown = unknown_device_model();
  for (const DeviceModel& each : device_models()) {
    EXPECT_LE(unknown.max_force_n, each.max_force_n) << each.name;
    EXPECT_LE(unknown.continuous_force_n, each.continuous_force_n) << each.name;
    EXPECT_LE(unknown.max_stiffness_n_per_m, each.max_stiffness_n_per_m) << each.name;
    EXPECT_LE(unknown.motion.damping_n_s_per_m, each.motion.damping_n_s_per_m) << each.name;
    EXPECT_LE(unknown.motion.friction_n, each.motion.friction_n) << each.name;
  }
  EXPECT_EQ(unknown.max_force_n, 3.3F);
  EXPECT_EQ(unknown.continuous_force_n, 0.88F);
}

// A hand so soft that it only carries the device along, and a push.
struct Pushed {
  SimulatedHand hand;
  Device device;
  explicit Pushed(const DeviceDynamics& dynamics) {
    hand.config = {0.05F, 1e-9F, 0, dynamics};
    hand.script = {{0, 0, 0, 0}};
    device = simulated_hand_device(hand, {"pushed", 8, 2000});
  }
  Vec3 tick(Vec3 force_n) {
    device.write(device.self, {force_n});
    Sample sample = {};
    EXPECT_TRUE(device.read(device.self, 0, sample));
    return sample.pose.position_m;
  }
  double speed() const { return std::fabs(hand.velocity_m_per_s[0]); }
};

TEST(SimulatedDevice, MassAndDampingAddToTheHand) {
  Pushed pushed({.mass_kg = 0.15F, .damping_n_s_per_m = 2});
  double x = 0;
  for (int i = 0; i < 100; ++i) x = of(pushed.tick({1, 0, 0}).x);
  // m v' = F - b v from rest: x = F/b (t - tau (1 - e^(-t/tau))), tau = m/b = 0.1 s.
  EXPECT_NEAR(x, 0.5 * (0.1 - 0.1 * (1 - std::exp(-1.0))), 1e-6);
}

TEST(SimulatedDevice, HoldsItsButtonsFromTheSecondSampleOn) {
  Pushed pushed({});
  pushed.hand.config.held_buttons = 5;
  Sample sample = {};
  for (const std::uint32_t held : {0U, 5U, 5U}) {
    ASSERT_TRUE(pushed.device.read(pushed.device.self, 0, sample));
    EXPECT_EQ(sample.buttons, held);
  }
}

TEST(SimulatedDevice, FrictionHoldsBelowItsLimitAndSlowsAboveIt) {
  Pushed held({.friction_n = 0.26F});
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(held.tick({0.15F, 0.2F, 0}).y, 0);  // 0.25 N
  Pushed pushed({.mass_kg = 0.05F, .friction_n = 0.26F});
  double x = 0;
  for (int i = 0; i < 100; ++i) x = of(pushed.tick({0.46F, 0, 0}).x);
  EXPECT_NEAR(x, 0.5 * (0.46 - 0.26) / 0.1 * 0.01, 1e-6);
  const double fast = pushed.speed();
  for (int i = 0; i < 50; ++i) (void)pushed.tick({});
  EXPECT_NEAR(pushed.speed(), fast - 2.6 * 0.05, 1e-6);
  for (int i = 0; i < 60; ++i) (void)pushed.tick({});
  EXPECT_EQ(pushed.speed(), 0);
}

TEST(SimulatedDevice, ReportsItsPositionInStepsAndLate) {
  for (const double delay_ms : {0.0, 0.25, 1.0, 3.0, 16.0}) {
    Pushed exact({});
    Pushed told({.resolution_m = 1e-4F, .delay_s = static_cast<float>(delay_ms * 1e-3)});
    exact.hand.velocity_m_per_s[0] = told.hand.velocity_m_per_s[0] = 0.1;
    for (int i = 1; i <= 100; ++i) {
      (void)exact.tick({});
      const double x = of(told.tick({}).x);
      const double was = std::max(0.1 * (i * 1e-3 - delay_ms * 1e-3), 0.0);
      ASSERT_LE(std::fabs(x - was), 0.5e-4 + 2e-6) << delay_ms << " " << i;
      const double counts = x / 1e-4;
      ASSERT_NEAR(counts, std::round(counts), 1e-3);
    }
    // The motion is the same with and without: what the device reports changes nothing.
    EXPECT_EQ(exact.hand.position_m[0], told.hand.position_m[0]);
  }
}

TEST(SimulatedDevice, EnergyReceivedIsWorkAgainstForceAndLossOfTheArm) {
  Pushed pushed({.mass_kg = 0.1F, .damping_n_s_per_m = 1, .friction_n = 0.1F});
  for (int i = 0; i < 500; ++i) (void)pushed.tick({i < 250 ? 1.0F : -0.7F, 0.3F, 0});
  // The hand's spring is so soft that it carries nothing: the energy that it gave is what the
  // device lost.
  const double* v = pushed.hand.velocity_m_per_s;
  const double kinetic = 0.5 * 0.15 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  EXPECT_NEAR(pushed.hand.received_j, -kinetic, 1e-6 + 1e-5 * kinetic);
  EXPECT_LE(pushed.hand.least_received_j, pushed.hand.received_j);
}

// ---- steps made steady
// -----------------------------------------------------------------------------

constexpr float kStepM = 5.5e-5F;

Vec3 along_x(double x) {
  return {static_cast<float>(x), 0, 0};
}

double told(double x) {
  return of(kStepM) * std::floor(x / of(kStepM) + 0.5);
}

TEST(Steady, IsWithinHalfAStepOfAnyReportedPosition) {
  std::mt19937 random(5);
  SteadyState state;
  double x = 0;
  for (int i = 0; i < 20'000; ++i) {
    x += 1e-6 * (static_cast<double>(random() % 401) - 200) * (i % 1000 == 0 ? 100 : 1);
    const double y = of(steady_position(kStepM, 1e-3F, state, along_x(told(x))).x);
    ASSERT_LE(std::fabs(y - told(x)), 0.5 * of(kStepM) + 1e-7) << i;
  }
}

TEST(Steady, AMotionHasItsVelocityAndNoSteps) {
  for (const double m_per_s : {0.005, 0.01, 0.03, 0.2}) {
    SteadyState state;
    double last = 0, roughest = 0;
    for (int i = 0; i < 3000; ++i) {
      const double y =
          of(steady_position(kStepM, 1e-3F, state, along_x(told(m_per_s * 1e-3 * i))).x);
      if (i > 1000) roughest = std::max(roughest, std::fabs(y - last - m_per_s * 1e-3));
      last = y;
    }
    EXPECT_LT(roughest, 0.2 * of(kStepM)) << m_per_s;  // as reported it would be 0.8 to 1 of a step
  }
}

TEST(Steady, ACountThatFlickersIsNoMotion) {
  SteadyState state;
  (void)steady_position(kStepM, 1e-3F, state, {});
  for (int i = 0; i < 100; ++i)
    (void)steady_position(kStepM, 1e-3F, state, along_x(i % 2 * of(kStepM)));
  const float rest = state.position_m.x;
  for (int i = 0; i < 1000; ++i) {
    const float y = steady_position(kStepM, 1e-3F, state, along_x(i % 2 * of(kStepM))).x;
    ASSERT_NEAR(of(y), of(rest), 1e-3 * of(kStepM));
  }
}

TEST(Steady, WithoutAResolutionItIsTheReportedPosition) {
  SteadyState state;
  for (const float x : {0.0F, 0.01F, -0.3F}) {
    EXPECT_EQ(steady_position(0, 1e-3F, state, {x, 1, 2}).x, x);
  }
}

}  // namespace
}  // namespace stylet::hal
