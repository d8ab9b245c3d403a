// SPDX-License-Identifier: Apache-2.0
// The guard's states: every cell of the table in hal/guard/GUARD.md, and the limits beside it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "guard_desk.h"

namespace stylet::hal {
namespace {

bool is_pressed_in(GuardMode mode) {
  return mode != GuardMode::kUnarmed && mode != GuardMode::kRelease;
}

// A guard that reached this state by itself, two ticks before it would leave it.
Desk desk_in(GuardMode mode) {
  Desk desk;
  if (mode == GuardMode::kLetGo) desk.tick(5, true);
  if (mode == GuardMode::kUnarmed) desk.tick(5, false);
  if (mode >= GuardMode::kRamp) {
    desk.tick(2, false);
    desk.tick(mode == GuardMode::kRamp ? 98 : 130, true);
  }
  if (mode == GuardMode::kRelease) desk.tick(18, false);
  if (mode >= GuardMode::kFading) guard_trip(desk.state, Fault::kTooLate);
  if (mode == GuardMode::kFading) desk.tick(18, true);
  if (mode == GuardMode::kFault) desk.tick(25, true);
  EXPECT_EQ(desk.state.mode, mode) << mode_name(mode);
  return desk;
}

// What a column of the table does to the guard.
std::map<std::string, std::function<void(Desk&)>> inputs() {
  const auto good = [](Desk& d) { (void)d.tick(is_pressed_in(d.state.mode)); };
  return {
      {"pressed", [](Desk& d) { (void)d.tick(true); }},
      {"released", [](Desk& d) { (void)d.tick(false); }},
      {"blind", [](Desk& d) { d.miss(1); }},
      {"blind too long",
       [](Desk& d) {
         for (int i = 0; i < 3; ++i) (void)guard_sample(d.config, d.state, false, {}, d.now_ns);
         (void)guard_force(d.config, d.state, d.asked_n);
       }},
      {"too fast",
       [good](Desk& d) {
         d.state.energy.velocity_m_per_s = {0, 2.6F, 0};
         good(d);
       }},
      {"tripped",
       [good](Desk& d) {
         guard_trip(d.state, Fault::kKernelFault);
         good(d);
       }},
      {"not finite",
       [good](Desk& d) {
         d.asked_n.y = std::numeric_limits<float>::quiet_NaN();
         good(d);
       }},
      {"buzz",
       [good](Desk& d) {
         d.state.buzz = {{}, {-3, 0, 0}, kBuzzTurns - 1, 0};
         good(d);
       }},
      {"energy",
       [good](Desk& d) {
         d.state.energy.energy_j = -2 * kLostEnergyJ;
         good(d);
       }},
      {"its time is over",
       [](Desk& d) {
         const bool pressed = is_pressed_in(d.state.mode);
         for (int i = 0; i < 2; ++i) (void)d.tick(pressed);
       }},
      {"acknowledged",
       [good](Desk& d) {
         d.acknowledges = true;
         good(d);
       }},
      {"rearm by name", [](Desk& d) { (void)guard_rearm(d.state, d.state.fault); }},
      {"rearm by another name", [](Desk& d) { EXPECT_FALSE(guard_rearm(d.state, Fault::kBuzz)); }},
      {"rearm while blind",
       [](Desk& d) {
         (void)guard_sample(d.config, d.state, false, {}, d.now_ns);
         EXPECT_FALSE(guard_rearm(d.state, d.state.fault));
       }},
  };
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(" `"), last = cell.find_last_not_of(" `");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

// The rows of the only table whose first column is called "state", its head first.
std::vector<std::vector<std::string>> table_of_states() {
  std::ifstream page(STYLET_GUARD_PAGE);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(page, line);) {
    const bool head = line.starts_with("| state |");
    if (head || (!rows.empty() && line.starts_with("| `"))) rows.push_back(cells_of(line));
    if (!rows.empty() && line.empty()) break;
  }
  return rows;
}

TEST(GuardStates, AreThoseOfTheTable) {
  const auto rows = table_of_states();
  const auto columns = inputs();
  ASSERT_EQ(rows.size(), 1U + 7U) << "seven states in " << STYLET_GUARD_PAGE;
  ASSERT_EQ(rows[0].size(), 1 + columns.size());
  std::size_t tried = 0;
  for (std::uint32_t i = 0; i < 7; ++i) {
    const auto mode = static_cast<GuardMode>(i);
    ASSERT_EQ(rows[i + 1][0], mode_name(mode));
    for (std::size_t c = 1; c < rows[0].size(); ++c) {
      ASSERT_TRUE(columns.contains(rows[0][c])) << rows[0][c];
      Desk desk = desk_in(mode);
      columns.at(rows[0][c])(desk);
      EXPECT_EQ(mode_name(desk.state.mode), rows[i + 1].at(c))
          << rows[i + 1][0] << ", " << rows[0][c];
      const bool latched =
          desk.state.mode == GuardMode::kFading || desk.state.mode == GuardMode::kFault;
      EXPECT_EQ(latched, desk.state.fault != Fault::kNone) << rows[i + 1][0] << ", " << rows[0][c];
      ++tried;
    }
  }
  EXPECT_EQ(tried, 7 * columns.size());
}

TEST(GuardStates, EachHasItsNameAndUnknownOnesHaveNone) {
  EXPECT_STREQ(mode_name(static_cast<GuardMode>(7)), "unknown mode");
  EXPECT_STREQ(fault_name(static_cast<Fault>(10)), "unknown fault");
  std::map<std::string, int> names;
  for (std::uint32_t i = 0; i < 10; ++i) ++names[fault_name(static_cast<Fault>(i))];
  EXPECT_EQ(names.size(), 10U);
}

TEST(GuardStates, WithAButtonNothingArmsBeforeTheFirstSample) {
  Desk desk;
  EXPECT_EQ(size(guard_force(desk.config, desk.state, desk.asked_n)), 0);
  EXPECT_EQ(desk.state.mode, GuardMode::kLetGo);
}

TEST(GuardStates, WithoutAButtonTheFirstTickArms) {
  Desk desk;
  desk.config.dead_man_button = -1;
  EXPECT_GT(size(desk.tick(false)), 0);
  EXPECT_EQ(desk.state.mode, GuardMode::kRamp);
  EXPECT_EQ(desk.state.button_seen, 0U);
}

TEST(DeadMansButton, ReleasedIsZeroInTwentyMillisecondsAndPressedAgainFadesIn) {
  Desk desk = desk_in(GuardMode::kLive);
  EXPECT_GT(size(desk.state.force_n), 2.9);
  double last = size(desk.state.force_n);
  for (int tick = 1; tick <= 20; ++tick) {
    const double now = size(desk.tick(tick > 5));  // pressed again meanwhile
    EXPECT_LT(now, last);
    last = now;
  }
  EXPECT_EQ(last, 0);
  EXPECT_NEAR(size(desk.tick(true)), 0.03, 1e-6);
  EXPECT_EQ(desk.state.mode, GuardMode::kRamp);
}

TEST(DeadMansButton, TapedDownArmsNothing) {
  Desk desk;
  desk.tick(1000, true);
  EXPECT_EQ(desk.state.mode, GuardMode::kLetGo);
  Desk faulty = desk_in(GuardMode::kFault);
  ASSERT_TRUE(guard_rearm(faulty.state, Fault::kTooLate));
  faulty.tick(1000, true);
  EXPECT_EQ(faulty.state.mode, GuardMode::kLetGo);
}

TEST(DeadMansButton, OfALostDeviceDoesNotCountAsHeld) {
  Desk desk = desk_in(GuardMode::kLive);
  desk.miss(23);
  EXPECT_EQ(desk.state.mode, GuardMode::kFault);
  EXPECT_EQ(size(desk.state.force_n), 0);
}

// Faults of the loop's or the device's timing before anybody felt a force, in any order, however
// often.
TEST(BeforeAnyForce, FaultsOfTimeClearWithTheNextUsableSampleAndNoOthers) {
  std::mt19937 random(20);
  constexpr std::array kOthers = {Fault::kForceNotFinite, Fault::kKernelFault, Fault::kTooFast,
                                  Fault::kBuzz, Fault::kEnergy};
  for (int round = 0; round < 200; ++round) {
    Desk desk;
    desk.config.dead_man_button = -1;
    desk.config.ramp_s = 0.05F;
    desk.asked_n = {};
    const auto upset = [&] {
      const std::uint64_t way = random() % 4, ticks = 1 + random() % 30;
      if (way == 0) desk.miss(static_cast<int>(ticks));
      if (way == 1) guard_trip(desk.state, Fault::kTooLate);
      if (way == 2) guard_motor(desk.state, {{}, {}, desk.state.arming, true});
      for (std::uint64_t i = 0; way == 3 && i < ticks; ++i) {  // the same again and again
        (void)guard_sample(desk.config, desk.state, true, {desk.seq, desk.now_ns, {}, 0},
                           desk.now_ns);
        (void)guard_force(desk.config, desk.state, {});
      }
    };
    for (std::uint64_t i = 0, times = random() % 5; i < times; ++i) {
      upset();
      const std::uint32_t arming = desk.state.arming;
      const bool latched = desk.state.fault != Fault::kNone;
      (void)desk.tick(false);
      ASSERT_EQ(desk.state.fault, Fault::kNone) << round;
      ASSERT_EQ(desk.state.arming, arming + (latched ? 1U : 0U)) << "motors need a newer one";
    }
    desk.tick(60, false);
    ASSERT_EQ(desk.state.mode, GuardMode::kLive);
    const Desk before = desk;
    guard_trip(desk.state, kOthers[random() % kOthers.size()]);
    desk.tick(50, false);
    ASSERT_NE(desk.state.fault, Fault::kNone) << round;
    desk = before;
    desk.asked_n = {0, 1e-3F, 0};  // even the smallest force counts
    desk.tick(1, false);
    desk.asked_n = {};
    do upset();
    while (desk.state.fault == Fault::kNone);
    desk.tick(50, false);
    ASSERT_NE(desk.state.fault, Fault::kNone) << round;
  }
}

// A force that only the motors report, and a torque, count as felt, too.
TEST(BeforeAnyForce, AMotorsForceAndATorqueCountAsOne) {
  Desk desk;
  desk.config.dead_man_button = -1;
  desk.asked_n = {};
  Desk turned = desk;
  GuardState torque = guard_start();
  desk.tick(5, false);
  guard_motor(desk.state, {{0, 0.1F, 0}, {}, desk.state.arming - 1, false});
  guard_trip(desk.state, Fault::kTooLate);
  desk.tick(50, false);
  EXPECT_EQ(desk.state.fault, Fault::kTooLate);
  turned.tick(5, false);
  (void)guard_torque(turned.config, 0.1F, turned.state, torque, {0.01F, 0, 0});
  ASSERT_GT(size(torque.force_n), 0);
  guard_trip(turned.state, Fault::kTooLate);
  turned.tick(50, false);
  EXPECT_EQ(turned.state.fault, Fault::kTooLate);
}

// A button that has been held since before the fault was pressed for something else.
TEST(AcknowledgeButton, CountsOnlyWhenPressedAgainAtZeroForce) {
  Desk desk = desk_in(GuardMode::kLive);
  desk.acknowledges = true;
  desk.tick(5, true);
  guard_trip(desk.state, Fault::kBuzz);
  desk.tick(10, true);
  desk.acknowledges = false;
  desk.tick(5, true);  // still fading
  desk.acknowledges = true;
  desk.tick(100, true);
  EXPECT_EQ(desk.state.fault, Fault::kBuzz);
  desk.acknowledges = false;
  desk.tick(1, true);
  EXPECT_EQ(desk.state.fault, Fault::kBuzz);
  desk.acknowledges = true;
  desk.tick(1, true);
  EXPECT_EQ(desk.state.fault, Fault::kNone);
  EXPECT_EQ(desk.state.mode, GuardMode::kLetGo);
  desk.tick(100, true);  // the dead man's button must be released before it is pressed
  EXPECT_EQ(size(desk.state.force_n), 0);
  // A release that was seen before another fault does not count after that fault.
  guard_trip(desk.state, Fault::kTooLate);
  desk.tick(100, true);
  EXPECT_EQ(desk.state.fault, Fault::kTooLate);
}

TEST(ThermalBudget, PeakForceIsForSecondsAndTheMeanSquareIsKept) {
  Desk desk;
  desk.config.dead_man_button = -1;
  desk.config.max_force_n = 3.3F;
  desk.config.continuous_force_n = 0.88F;
  desk.asked_n = {0, 0, 5};
  double longest = 0;
  for (int tick = 1; tick <= 300'000; ++tick) {
    const double force = size(desk.tick(true));
    if (force > 3.2) longest = tick;
    ASSERT_LE(desk.state.heat_n2, 0.88 * 0.88 * (1 + 1e-6)) << tick;
  }
  // 60 s ln(1 / (1 - 0.8 (0.88 / 3.3)^2)) = 3.51 s, and 0.07 s for the ramp.
  EXPECT_NEAR(longest / 1000, 3.58, 0.05);
  EXPECT_NEAR(size(desk.state.force_n), 0.88, 0.02);
  EXPECT_NEAR(desk.state.force_n.z, size(desk.state.force_n), 1e-6);  // shortened, not turned
  EXPECT_GT(desk.state.counters.force_warm, 200'000U);
  EXPECT_LT(desk.state.counters.force_warm, 300'000U);
  EXPECT_EQ(desk.state.fault, Fault::kNone);
  desk.asked_n = {};
  desk.tick(120'000, true);  // cools
  desk.asked_n = {0, 0, 5};
  desk.tick(10, true);
  EXPECT_NEAR(size(desk.state.force_n), 3.3, 1e-4);
}

// For any force asked, ending at any time, however short the averaging time and however small the
// continuous force.
TEST(ThermalBudget, IsKeptAtItsEdges) {
  for (const float thermal_s : {1.0F, 5.0F, 60.0F}) {
    for (const float always : {0.05F, 0.3F, 2.0F}) {
      for (const int swing : {0, 3, 40, 700}) {
        Desk desk;
        desk.config.dead_man_button = -1;
        desk.config.max_force_n = 8;
        desk.config.max_slew_n_per_s = 400;
        desk.config.buzz_n = 100;
        desk.config.continuous_force_n = always;
        desk.config.thermal_s = thermal_s;
        const double most = static_cast<double>(always * always) * (1 + 1e-5);
        for (int tick = 1; tick <= 5000; ++tick) {
          const bool rests = swing > 0 && tick / swing % 2 == 1;
          desk.asked_n = {rests ? 0.0F : 20.0F, 0, 0};
          if (tick % 997 == 0) guard_trip(desk.state, Fault::kKernelFault);
          (void)desk.tick(true);
          (void)guard_rearm(desk.state, desk.state.fault);
          ASSERT_LE(desk.state.heat_n2, most) << thermal_s << " " << always << " " << tick;
        }
      }
    }
  }
}

TEST(VelocityFuse, OneGlitchIsLeftOutAndAFastHandLatches) {
  Desk desk = desk_in(GuardMode::kLive);
  desk.position_m.x = 0.3F;
  EXPECT_FALSE(desk.hear(true));
  desk.position_m.x = 0;
  EXPECT_TRUE(desk.hear(true));
  EXPECT_EQ(desk.state.fault, Fault::kNone);
  EXPECT_EQ(desk.state.counters.samples_jumped, 1U);
  const auto ticks_to_fault = [](float m_per_s) {
    Desk fast = desk_in(GuardMode::kLive);
    int tick = 0;
    for (; tick < 100 && fast.state.fault == Fault::kNone; ++tick) {
      fast.position_m.y += m_per_s * 1e-3F;
      (void)fast.tick(true);
    }
    EXPECT_TRUE(tick == 100 || fast.state.fault == Fault::kTooFast);
    return tick;
  };
  EXPECT_EQ(ticks_to_fault(1.9F), 100);  // the limit is 2 m/s
  EXPECT_LT(ticks_to_fault(2.2F), 20);
  EXPECT_LT(ticks_to_fault(30), 5);
}

TEST(VelocityFuse, AJumpThatStaysIsAFaultOfItsOwnNameAndMayBeAcknowledgedAtZeroForce) {
  Desk desk = desk_in(GuardMode::kLive);
  desk.position_m.x = 0.3F;
  desk.tick(25, true);
  EXPECT_EQ(desk.state.fault, Fault::kTooFast);
  EXPECT_EQ(desk.state.blind_ns, 0U);
  EXPECT_EQ(desk.state.energy.least_j, 0);  // the jump was no motion against a force
  EXPECT_TRUE(guard_rearm(desk.state, Fault::kTooFast));
  desk.tick(5, false);
  desk.tick(5, true);
  EXPECT_EQ(desk.state.mode, GuardMode::kRamp);
}

// A force that swings as a sine. Returns the tick of the fault, or 2000.
int ticks_of_swing(double hz, double amplitude_n) {
  Desk desk = desk_in(GuardMode::kLive);
  desk.asked_n = {};
  desk.tick(200, true);
  for (int tick = 1; tick < 2000; ++tick) {
    const double phase = 2 * 3.14159265358979 * hz * 1e-3 * tick;
    desk.asked_n = {0, static_cast<float>(amplitude_n * std::sin(phase)), 1};
    (void)desk.tick(true);
    if (desk.state.fault == Fault::kBuzz) return tick;
  }
  return 2000;
}

TEST(BuzzDetector, SeesBuzzingAndNotHandsOrSteps) {
  EXPECT_LE(ticks_of_swing(30, 1.2), 250);
  EXPECT_LE(ticks_of_swing(100, 1), 80);
  EXPECT_LE(ticks_of_swing(300, 2), 40);
  EXPECT_EQ(ticks_of_swing(100, 0.7), 2000);  // the bar is 0.8 N
  EXPECT_EQ(ticks_of_swing(25, 1), 2000);     // 0.78 N of it are above 20 Hz
  EXPECT_EQ(ticks_of_swing(8, 3), 2000);      // a fast hand
  Desk desk = desk_in(GuardMode::kLive);
  for (int step = 0; step < 40; ++step) {  // a puncture every 30 ms
    desk.asked_n.x = step % 2 == 0 ? -3.0F : 3.0F;
    desk.tick(30, true);
  }
  EXPECT_EQ(desk.state.fault, Fault::kNone);
}

// A hand that moves to and fro against a force that is stronger on the way back.
double least_energy(const GuardConfig& config, int cycles, GuardState& state_out) {
  Desk desk;
  desk.config = config;
  for (int i = 0; i < cycles * 400; ++i) {
    const bool back = i % 400 >= 200;
    desk.position_m.x += back ? 5e-5F : -5e-5F;
    desk.asked_n = {back ? 1.2F : 1.0F, 0, 0};
    (void)desk.tick(true);
  }
  state_out = desk.state;
  return desk.state.energy.least_j;
}

TEST(EnergyObserver, CountsWhatTheForcesSentGive) {
  GuardConfig config = with_button();
  config.dead_man_button = -1;
  config.ramp_s = 0;
  config.passivity_damping_n_s_per_m = 0;
  GuardState state = {};
  // 10 mm each way: 2 mJ a cycle.
  EXPECT_NEAR(least_energy(config, 10, state), -0.02, 0.0015);
  EXPECT_EQ(state.fault, Fault::kNone);  // the guard only observes
  EXPECT_EQ(state.counters.force_damped, 0U);
  EXPECT_LT(least_energy(config, 30, state), -kLostEnergyJ);
  EXPECT_EQ(state.fault, Fault::kNone);
  config.device.friction_n = 0.11F;  // of the device: takes 2.2 mJ
  EXPECT_GT(least_energy(config, 10, state), -0.0005);
}

TEST(EnergyObserver, ControllerTakesBackWhatDampingCan) {
  GuardConfig config = with_button();
  config.dead_man_button = -1;
  config.ramp_s = 0;
  config.passivity_damping_n_s_per_m = 10;  // 0.2 N need 4 N s/m at 50 mm/s
  GuardState state = {};
  EXPECT_GT(least_energy(config, 100, state), -0.003);
  EXPECT_EQ(state.fault, Fault::kNone);
  EXPECT_GT(state.counters.force_damped, 1000U);
  EXPECT_LT(state.counters.force_damped, 40'000U);
  config.passivity_damping_n_s_per_m = 0.5F;  // too little
  EXPECT_LT(least_energy(config, 100, state), -kLostEnergyJ);
  EXPECT_EQ(state.fault, Fault::kEnergy);
  EXPECT_GT(state.counters.force_damped, 0U);
}

// A spring of 1000 N/m makes energy because its force is held for a tick. Returns what the observer
// sees of this energy if the position is reported 2.5 ticks late, as a fraction of the real amount.
double held_spring(float known_delay_s) {
  constexpr double kStiffness = 1000;
  Desk desk;
  desk.config.dead_man_button = -1;
  desk.config.ramp_s = 0;
  desk.config.passivity_damping_n_s_per_m = 0;
  desk.config.device.delay_s = known_delay_s;
  std::vector<double> way(4, 0.0);
  double made_j = 0;
  for (int i = 0; i < 3142; ++i) {  // ten cycles
    const double last = way.back();
    way.push_back(2e-3 * std::sin(2e-2 * i));
    made_j += 0.5 * kStiffness * (way.back() - last) * (way.back() - last);
    const auto told = [&way](std::size_t ago) { return way[way.size() - 1 - ago]; };
    desk.position_m.x = static_cast<float>(0.5 * (told(2) + told(3)));
    desk.asked_n = {static_cast<float>(-kStiffness * way.back()), 0, 0};
    (void)desk.tick(true);
  }
  return -desk.state.energy.least_j / made_j;
}

TEST(EnergyObserver, KnowsTheDelayOfTheDevice) {
  EXPECT_NEAR(held_spring(2.5e-3F), 1, 0.05);
  // If it does not know the delay, the force seems to lead the motion, which looks like damping.
  EXPECT_EQ(held_spring(0), 0);
}

TEST(EnergyObserver, ControllerLeavesAHandAtRestAlone) {
  Desk desk;
  desk.config.dead_man_button = -1;
  desk.config.ramp_s = 0;
  desk.tick(10, true);
  desk.state.energy.energy_j = -0.01;
  EXPECT_EQ(desk.tick(true).x, desk.asked_n.x);
  EXPECT_EQ(desk.state.counters.force_damped, 0U);
}

TEST(EnergyObserver, IgnoresMotionBelowTheResolution) {
  Desk flicker;
  flicker.config.dead_man_button = -1;
  flicker.config.device = {.resolution_m = 1e-4F};
  for (int i = 0; i < 1000; ++i) {
    flicker.position_m.x = i % 2 == 0 ? 1e-4F : 0;
    flicker.asked_n = {i % 2 == 0 ? -1.0F : 1.0F, 0, 0};
    (void)flicker.tick(true);
  }
  EXPECT_EQ(flicker.state.energy.least_j, 0);
}

TEST(EnergyObserver, ASpringSwitchedOnGivesBackWhatItHolds) {
  // The spring is pressed in by 3 mm without force, then armed and released during the ramp: 4.5 mJ
  // come back, and 1/2 K (v T)^2 more in each tick, because the force is held.
  Desk desk;
  desk.config.passivity_damping_n_s_per_m = 0;
  const auto at = [&desk](double x_m, bool pressed) {
    desk.position_m.x = static_cast<float>(x_m);
    desk.asked_n = {static_cast<float>(-1000 * x_m), 0, 0};
    (void)desk.tick(pressed);
  };
  for (int i = 0; i <= 300; ++i) at(1e-5 * i, false);
  for (int i = 300; i >= 0; --i) at(1e-5 * i, true);
  EXPECT_EQ(desk.state.mode, GuardMode::kLive);
  EXPECT_GT(desk.state.energy.least_j, -600 * 500 * 1e-10 - 1e-6);
}

TEST(EnergyObserver, AssumesTheMostStoredAfterTicksWithoutSamplesAndNoneAtTheStart) {
  Desk desk;
  desk.config.stored_energy_j = 0.25F;
  desk.miss(10);
  EXPECT_EQ(desk.state.energy.energy_j, 0);  // nobody has moved yet
  desk.tick(3, false);
  desk.miss(2);
  desk.tick(1, false);
  EXPECT_EQ(desk.state.energy.energy_j, 0);
  desk.miss(3);  // the watchdog's time
  desk.position_m.x = 0.004F;
  desk.tick(1, false);
  EXPECT_EQ(desk.state.energy.energy_j, 0.25);
  EXPECT_EQ(desk.state.energy.least_j, 0);
  EXPECT_EQ(size(desk.state.energy.velocity_m_per_s), 0);
}

TEST(EnergyObserver, KeepsNoMoreThanASpringCouldGiveBack) {
  Desk desk;
  desk.config.dead_man_button = -1;
  desk.config.stored_energy_j = 0.01F;
  for (int i = 0; i < 5000; ++i) {  // friction of 3 N over 250 mm: 0.75 J
    desk.position_m.x -= 5e-5F;
    (void)desk.tick(true);
  }
  EXPECT_NEAR(desk.state.energy.energy_j, 0.01, 1e-9);
}

}  // namespace
}  // namespace stylet::hal
