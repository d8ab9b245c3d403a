// SPDX-License-Identifier: Apache-2.0
// The simulated hand against the closed form of a mass, a spring and a damper.
#include "hal/device/drivers/simulated_hand.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stylet::hal {
namespace {

constexpr double kPeriodS = 1e-3;

SimulatedHand resting_hand(const SimulatedHandConfig& config) {
  SimulatedHand hand;
  hand.config = config;
  hand.script = {{0, 0, 0, 0}};
  return hand;
}

double read_x(const Device& device) {
  Sample sample{};
  EXPECT_TRUE(device.read(device.self, 0, sample));
  return static_cast<double>(sample.pose.position_m.x);
}

// Displacement under a force that starts at t = 0, for a hand that was at rest.
double step_response(const SimulatedHandConfig& config, double force_n, double t_s) {
  const double m = static_cast<double>(config.mass_kg),
               c = static_cast<double>(config.damping_n_s_per_m),
               k = static_cast<double>(config.stiffness_n_per_m);
  const double decay = c / (2 * m), square = k / m - decay * decay;
  if (square > 0) {
    const double w = std::sqrt(square);
    return force_n / k *
           (1 - std::exp(-decay * t_s) * (std::cos(w * t_s) + decay / w * std::sin(w * t_s)));
  }
  const double root = std::sqrt(-square), slow = -decay + root, fast = -decay - root;
  return force_n / k *
         (1 - (fast * std::exp(slow * t_s) - slow * std::exp(fast * t_s)) / (fast - slow));
}

TEST(SimulatedHand, StepResponseIsTheClosedForm) {
  for (const SimulatedHandConfig config :
       {SimulatedHandConfig{0.2F, 2000, 5}, SimulatedHandConfig{0.2F, 2000, 30},
        SimulatedHandConfig{0.1F, 500, 60}}) {
    SimulatedHand hand = resting_hand(config);
    const Device device = simulated_hand_device(hand, {"hand", 8, 2000});
    device.write(device.self, {{2, 0, 0}});
    const double final_m = 2.0 / static_cast<double>(config.stiffness_n_per_m);
    for (int tick = 1; tick <= 500; ++tick) {
      EXPECT_NEAR(read_x(device), step_response(config, 2, tick * kPeriodS), 1e-4 * final_m)
          << tick;
    }
  }
}

TEST(SimulatedHand, FollowsARampWithoutLag) {
  // Spring and damper both act relative to the moving target: at steady speed there is no lag.
  SimulatedHand hand = resting_hand({});
  hand.script = make_script({Waypoint{.travel_m = 0.06F, .speed_m_per_s = 0.01F}}, 0.01F);
  const Device device = simulated_hand_device(hand, {"hand", 8, 2000});
  Sample sample{};
  for (int tick = 0; tick < 3000; ++tick) (void)device.read(device.self, 0, sample);
  EXPECT_NEAR(static_cast<double>(sample.pose.position_m.z), -0.03, 1e-6);
}

TEST(SimulatedHand, StableForExtremeValues) {
  for (const float mass_kg : {1e-3F, 100.0F}) {
    for (const float stiffness : {1.0F, 1e7F}) {
      for (const float damping : {0.0F, 1e5F}) {
        SimulatedHand hand = resting_hand({mass_kg, stiffness, damping});
        const Device device = simulated_hand_device(hand, {"hand", 8, 2000});
        device.write(device.self, {{1, 0, 0}});
        for (int tick = 0; tick < 20000; ++tick) {
          const double x = read_x(device);
          ASSERT_LE(std::fabs(x), 2.001 / static_cast<double>(stiffness) + 1e-9);
        }
      }
    }
  }
}

TEST(SimulatedHand, SamplesAreNumberedAndTimed) {
  SimulatedHand hand = resting_hand({});
  const Device device = simulated_hand_device(hand, {"hand", 8, 2000});
  for (std::uint64_t seq = 1; seq < 5; ++seq) {
    Sample sample{};
    ASSERT_TRUE(device.read(device.self, 77, sample));
    EXPECT_EQ(sample.seq, seq);
    EXPECT_EQ(sample.t_ns, 77);
  }
}

TEST(Script, TimesFollowFromSpeedsTimesAndHolds) {
  const auto script = make_script({Waypoint{.travel_m = 0.06F, .speed_m_per_s = 0.01F, .hold_s = 3},
                                   Waypoint{.travel_m = 0.06F, .right_m = 0.01F, .time_s = 2},
                                   Waypoint{.travel_m = -0.01F, .speed_m_per_s = 0.02F}},
                                  0.01F);
  ASSERT_EQ(script.size(), 5U);
  EXPECT_NEAR(script[1].t_s, 7, 1e-6);
  EXPECT_NEAR(script[1].z_m, -0.07, 1e-8);
  EXPECT_NEAR(script[2].t_s, 10, 1e-6);
  EXPECT_NEAR(script[3].t_s, 12, 1e-6);
  EXPECT_NEAR(script[3].x_m, 0.01, 1e-8);
  EXPECT_NEAR(script[4].t_s, 12 + std::hypot(0.07, 0.01) / 0.02, 1e-5);
  EXPECT_EQ(script_ticks({{0, 0, 0, 0}, {18, 0, 0, 0}}, 1e-3), 18000U);
  EXPECT_EQ(script_ticks({{0, 0, 0, 0}, {0.0015, 0, 0, 0}}, 1e-3), 2U);
}

TEST(SimulatedHand, ItsThumbPressesOnTheWayAndWhileHolding) {
  SimulatedHand hand;
  hand.script = make_script({Waypoint{.travel_m = 0.01F, .time_s = 1},
                             Waypoint{.travel_m = 0.02F, .time_s = 1, .hold_s = 1, .plunger_n = 9}},
                            0);
  const Device device = simulated_hand_device(hand, {"hand", 8, 2000});
  for (int tick = 1; tick <= 3200; ++tick) {
    Sample sample{};
    ASSERT_TRUE(device.read(device.self, 0, sample));
    if (tick != 1000) {
      EXPECT_EQ(sample.plunger_n, tick < 1000 ? 0 : 9) << tick;
    }
  }
}

// Roll of the base in turns, from the quaternion about z.
double turns_of(const Sample& sample) {
  const Quat& q = sample.pose.rotation;
  return std::atan2(static_cast<double>(q.z), static_cast<double>(q.w)) / 3.14159265358979;
}

TEST(SimulatedHand, RollsForTheDutyOfEveryTurn) {
  // Four turns in 2 s, each in the first quarter of its half second; then half a turn back.
  SimulatedHand hand;
  hand.script = make_script(
      {Waypoint{
           .travel_m = 0.02F, .speed_m_per_s = 0.01F, .hold_s = 0.5F, .turns = 4, .duty = 0.25F},
       Waypoint{.travel_m = 0.02F, .time_s = 1, .turns = -0.5F}},
      0);
  const Device device = simulated_hand_device(hand, {"hand", 8, 2000});
  double total = 0, last = 0;
  for (int tick = 1; tick <= 3500; ++tick) {
    Sample sample{};
    ASSERT_TRUE(device.read(device.self, 0, sample));
    const double now = turns_of(sample);
    double step = now - last;
    step -= 2 * std::round(0.5 * step);  // the quaternion's angle comes back after two turns
    last = now;
    total += step;
    const double t = tick * kPeriodS, cycle = t / 0.5 - std::floor(t / 0.5 + 1e-9);
    const double wanted = t <= 2     ? std::floor(t / 0.5 + 1e-9) + std::min(1.0, 4 * cycle)
                          : t <= 2.5 ? 4
                                     : 4 - 0.5 * (t - 2.5);
    ASSERT_NEAR(total, wanted, 1e-6) << tick;
  }
}

}  // namespace
}  // namespace stylet::hal
