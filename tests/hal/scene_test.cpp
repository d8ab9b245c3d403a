// SPDX-License-Identifier: Apache-2.0
#include "hal/scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "hal/base/rotation.h"
#include "tiny_organ.h"

namespace stylet::hal {
namespace {

const std::string kGood = R"(mode = "paper"
[organ]
path = "liver.organ"
[loop]
period_us = 500
substeps = 2
cpu = 1
[tissue]
damping_ms = 1.5
[paper]
alpha = 0.25
[needle]
gauge = "22G"
length_mm = 120
unit_mm = 4
[approach]
direction = [0, 0, -2]
point_mm = [10, 20, 30]
start_mm = 5
[device]
max_force_n = 4
[guard]
max_force_n = 6
ramp_ms = 100
[hand]
mass_g = 300
[[hand.waypoint]]
travel_mm = 40
speed_mm_s = 10
hold_s = 1
[[hand.waypoint]]
lateral_mm = [2, -1]
time_s = 0.5
)";

std::string changed(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

int line_of(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

std::string error_of(const std::string& text) {
  try {
    (void)parse_scene(text, "s.toml");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

double of(float value) {
  return static_cast<double>(value);
}

TEST(Scene, EveryValueArrivesInSi) {
  const Scene scene = parse_scene(kGood, "s.toml");
  EXPECT_EQ(scene.config.mode, Mode::kPaper);
  EXPECT_EQ(scene.organ_path, "liver.organ");
  EXPECT_NEAR(of(scene.config.period_s), 5e-4, 1e-10);
  EXPECT_EQ(scene.config.substeps, 2U);
  EXPECT_EQ(scene.config.inertia, Inertia::kTrueMass);
  EXPECT_EQ(scene.cpu, 1);
  EXPECT_NEAR(of(scene.config.tissue_damping_s), 1.5e-3, 1e-9);
  EXPECT_NEAR(of(scene.config.paper_alpha), 0.25, 1e-9);
  EXPECT_NEAR(of(scene.config.needle[0].outer_radius_m), 0.3588e-3, 1e-9);
  EXPECT_NEAR(of(scene.config.needle[0].length_m), 0.12, 1e-8);
  EXPECT_NEAR(of(scene.config.needle[0].unit_m), 4e-3, 1e-9);
  EXPECT_NEAR(of(scene.hands[0].approach.direction.z), -1, 1e-7);
  ASSERT_TRUE(scene.hands[0].approach.through_m.has_value());
  EXPECT_NEAR(of(scene.hands[0].approach.through_m->y), 0.02, 1e-8);
  EXPECT_NEAR(of(scene.hands[0].approach.start_m), 5e-3, 1e-9);
  EXPECT_EQ(scene.hands[0].guard.max_force_n, 4.0F);  // the smaller one
  EXPECT_NEAR(of(scene.hands[0].guard.ramp_s), 0.1, 1e-8);
  EXPECT_EQ(scene.hands[0].guard.period_s, scene.config.period_s);
  EXPECT_NEAR(of(scene.hands[0].hand.mass_kg), 0.3, 1e-7);
  ASSERT_EQ(scene.hands[0].waypoints.size(), 2U);
  EXPECT_NEAR(of(scene.hands[0].waypoints[0].speed_m_per_s), 0.01, 1e-9);
  EXPECT_NEAR(of(scene.hands[0].waypoints[1].travel_m), 0.04, 1e-8);  // stays where it was
  EXPECT_NEAR(of(scene.hands[0].waypoints[1].right_m), 2e-3, 1e-9);
  EXPECT_NEAR(of(scene.hands[0].waypoints[1].up_m), -1e-3, 1e-9);
}

TEST(Scene, InertiaIsChosenByName) {
  const auto config = [](const std::string& line) {
    return parse_scene(changed("substeps = 2", line), "s.toml").config;
  };
  EXPECT_EQ(config("inertia = \"true_mass\"").inertia, Inertia::kTrueMass);
  EXPECT_EQ(config("inertia = \"true_mass\"").substeps, 1U);
  EXPECT_EQ(config("").substeps, 1U);
  EXPECT_EQ(config("inertia = \"added_mass\"").inertia, Inertia::kAddedMass);
  EXPECT_EQ(config("inertia = \"added_mass\"").substeps, 2U);  // mass grows with their square
  EXPECT_EQ(config("inertia = \"added_mass\"\nsubsteps = 1").substeps, 1U);
}

// The tables of a real device instead of the simulated one.
std::string attached(const std::string& device, const std::string& mapping) {
  return changed("[device]\n", "[mapping]\n" + mapping + "[device]\n" + device);
}

TEST(Scene, DeviceByUriIsHeldThroughTheMapping) {
  const std::string mapping =
      "motion_scale = 0.5\nforce_scale = 4\nturn_deg = [0, 90, 0]\nclutch_button = 1\n"
      "box_mm = [[-50, -40, -200], [50, 40, 20]]\npivot = true\n";
  Hand hand = parse_scene(attached("uri = \"hd:Left\"\n", mapping), "s").hands[0];
  EXPECT_EQ(hand.device, "attached");
  EXPECT_EQ(hand.uri, "hd:Left");
  EXPECT_TRUE(hand.grip.enabled);
  EXPECT_TRUE(hand.grip.pivots);
  EXPECT_EQ(hand.grip.motion_scale, 0.5F);
  EXPECT_EQ(hand.grip.force_scale, 4);
  EXPECT_EQ(hand.grip.clutch_button, 1);
  EXPECT_NEAR(of(hand.grip.turn.y), 0.70710678, 1e-6);
  EXPECT_NEAR(of(hand.grip.box_low_m.z), -0.2, 1e-7);
  EXPECT_NEAR(of(hand.grip.box_high_m.y), 0.04, 1e-8);
  EXPECT_NEAR(of(hand.grip.pivot_depth_m), 0.125, 1e-7);  // 5 mm outside, 120 mm long
  // The guard lets through, and the coupling asks for, no more than the device can do.
  fit_to_device(
      {.name = "", .max_force_n = 3, .max_slew_n_per_s = 1000, .max_stiffness_n_per_m = 400}, hand);
  EXPECT_EQ(hand.guard.max_force_n, 3);
  EXPECT_EQ(hand.guard.max_slew_n_per_s, 1000);
  EXPECT_NEAR(of(hand.coupling.stiffness_n_per_m), 0.7 * 400 / (0.5 * 4), 1e-3);
}

TEST(Scene, WithoutMappingTheSimulatedHandHoldsTheNeedleItself) {
  EXPECT_FALSE(parse_scene(kGood, "s").hands[0].grip.enabled);
  EXPECT_TRUE(parse_scene(attached("", ""), "s").hands[0].grip.enabled);
}

TEST(Scene, WrongDevicesAndMappingsAreRefused) {
  const auto refused = [](const std::string& text, const char* says) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find(says), std::string::npos) << error;
  };
  refused(attached("uri = \"phantom:\"\n", ""), "device.uri: 'phantom:': expected a device's URI");
  refused(attached("uri = \"hd:\"\nkind = \"steered\"\n", ""), "either kind or uri");
  refused(attached("", "motion_scale = 0\n"), "mapping.motion_scale");
  refused(attached("", "clutch_button = 32\n"), "mapping.clutch_button");
  refused(attached("", "box_mm = [[1, 0, 0], [2, 1, 1]]\n"), "two corners");
  refused(attached("", "pivott = true\n"), "pivott");
}

struct Mistake {
  const char* from;
  const char* to;
  const char* line_with;  // the line that must be named
  const char* says;
  int up = 0;  // lines above it: a missing key is reported at its table
};

// Every mistake names its line and what is allowed.
void expect_refusals(std::initializer_list<Mistake> mistakes) {
  for (const Mistake& each : mistakes) {
    const std::string text = changed(each.from, each.to);
    const std::string error = error_of(text);
    EXPECT_THAT(error, testing::HasSubstr(each.says)) << each.to;
    const int line = line_of(text, each.line_with) - each.up;
    EXPECT_THAT(error, testing::StartsWith("s.toml:" + std::to_string(line) + ": ")) << each.to;
  }
}

TEST(Scene, MistakesOfTheFileAndTheLoop) {
  expect_refusals({
      {"substeps = 2", "substep = 2",
       "substep =", "loop.substep: 2: expected one of the known keys cpu"},
      {"[tissue]", "[tisue]", "[tisue]", "expected one of the known keys approach"},
      {"substeps = 2", "substeps = 2.5", "2.5",
       "loop.substeps: 2.5: expected a whole number from 1 to 32"},
      {"substeps = 2", "inertia = \"none\"", "inertia", "added_mass"},
      {"substeps = 2", "substeps = 0", "substeps", "0: expected a whole number from 1 to 32"},
      {"cpu = 1", "threads = 0", "threads",
       "loop.threads: 0: expected a whole number from 1 to 16"},
      {"cpu = 1", "threads = 17", "threads",
       "loop.threads: 17: expected a whole number from 1 to 16"},
      {"cpu = 1", "threads = \"all\"", "threads", "a whole number from 1 to 16"},
      {"period_us = 500", "period_us = \"fast\"", "period_us", "a number from 10 to 10000"},
      {"period_us = 500", "period_us = nan", "period_us",
       "nan: expected a number from 10 to 10000"},
      {"period_us = 500", "period_us = inf", "period_us", "a number from 10 to 10000"},
      {"alpha = 0.25", "alpha = 1.25", "alpha",
       "paper.alpha: 1.25: expected a number from 0.001 to 1"},
      {"mode = \"paper\"", "mode = \"fast\"", "mode", "\"physical\" or \"paper\""},
      {"mode = \"paper\"", "mode = 1", "mode", "mode: 1: expected a text in quotes"},
      {"[hand]", "[hand", "[hand", "not TOML"},
  });
  EXPECT_THAT(error_of("loop = 3\n"), testing::StartsWith("s.toml:1: loop: 3: expected a table"));
}

TEST(Scene, MistakesOfNeedles) {
  expect_refusals({
      {"gauge = \"22G\"", "gauge = \"28G\"", "28G", "\"17G\" or \"18G\""},
      {"unit_mm = 4", "unit_mm = 4\nod_mm = 1", "gauge", "either gauge or od_mm"},
      {"unit_mm = 4", "preset = \"18G\"", "preset", "either gauge or preset"},
      {"unit_mm = 4", "unit_mm = 60", "unit_mm", "a number from 0.1 to 50"},
      {"unit_mm = 4", "id_mm = 0.3", "id_mm", "only with od_mm"},
      {"gauge = \"22G\"", "od_mm = 1\nid_mm = 1", "id_mm", "a number from 0 to 0.99"},
      {"unit_mm = 4", "flexible = 1", "flexible", "needle.flexible: 1: expected true or false"},
      {"unit_mm = 4", "rods = 129", "rods", "a whole number from 1 to 128"},
      {"unit_mm = 4", "half_angle_deg = 4.9", "half_angle_deg", "a number from 5 to 80"},
      {"unit_mm = 4", "tip = \"sharp\"", "tip", "\"bevel\" or \"bent\""},
      {"unit_mm = 4", "curvature_per_m = 5", "curvature_per_m", "only with tip = \"bevel\""},
      {"unit_mm = 4", "tip = \"bevel\"\nbent_angle_deg = 5", "bent_angle", "with tip = \"bent\""},
      {"unit_mm = 4", "tip = \"bent\"\nbent_length_mm = 121\nbent_angle_deg = 5", "bent_length",
       "a number from 0.1 to 120"},
  });
}

TEST(Scene, MistakesOfObstaclesAndBreathing) {
  expect_refusals({
      {"[guard]", "[breathing]\nperiod_s = 4\n[guard]", "[breathing]", "amplitude_mm: missing"},
      {"[guard]", "[breathing]\namplitude_mm = [80, 80, 0]\n[guard]", "amplitude_mm",
       "expected a way of at most 100 mm"},
      {"[guard]", "[gravity]\nat_rest_m_per_s2 = [0, 0, -9.81]\n[guard]", "[gravity]",
       "now_m_per_s2: missing: expected a list of 3 numbers"},
      {"[guard]", "[gravity]\nnow_m_per_s2 = [0, 0, -101]\n[guard]", "now_m_per_s2",
       "from -100 to 100"},
      {"[guard]", "[gravity]\nnow_m_per_s2 = [0, 0, -60]\nat_rest_m_per_s2 = [0, 0, 60]\n[guard]",
       "now_m_per_s2", "expected at most 100 from at_rest_m_per_s2"},
      {"[guard]", "[[obstacles]]\nshape = \"cone\"\n[guard]", "cone", "\"box\" or \"sphere\""},
      {"[guard]", "[[obstacles]]\nshape = \"box\"\n[guard]", "[[obst",
       "size_mm: missing: expected"},
      {"[guard]", "[[obstacles]]\nshape = \"sphere\"\nsize_mm = [1, 1, 1]\n[guard]", "size_mm",
       "only with shape = \"box\""},
      {"[guard]", "[[obstacles]]\nshape = \"sphere\"\nradius_mm = 3\n[guard]", "[[obst",
       "at_mm: missing: expected a list of 3 numbers"},
  });
}

TEST(Scene, MistakesOfHubAndSyringe) {
  expect_refusals({
      {"unit_mm = 4", "unit_mm = 4\nhub = \"cork\"", "cork", "\"open\" or \"syringe\""},
      {"unit_mm = 4", "unit_mm = 4\nopening_mm = 1", "opening_mm", "only with an open hub"},
      {"unit_mm = 4", "unit_mm = 4\nhub = \"open\"\nopening_mm = 30", "opening_mm", "from 0 to 20"},
      {"gauge = \"22G\"", "od_mm = 0.5\nhub = \"open\"", "hub", "the needle is solid"},
      {"unit_mm = 4", "unit_mm = 4\nhub = \"open\"\nsyringe = {gas_ml = 1}", "hub",
       "\"syringe\", as"},
      {"unit_mm = 4", "unit_mm = 4\nhub = \"syringe\"\nsyringe = {filled_ml = 11}", "filled_ml",
       "from 0 to 10"},
      {"hold_s = 1", "hold_s = 1\nplunger_n = 300", "plunger_n", "from -200 to 200"},
  });
}

TEST(Scene, MistakesOfApproachDeviceAndGuard) {
  expect_refusals({
      {"[0, 0, -2]", "[0, 0]", "direction",
       "approach.direction: [ 0, 0 ]: expected a list of 3 numbers"},
      {"[0, 0, -2]", "[0.02, {a = 0.5}, []]", "direction",
       "approach.direction: [ 0.02, a table, [] ]: "},
      {"[0, 0, -2]", "[0, 0, 0]", "direction", "a direction that is not zero"},
      {"[0, 0, -2]", "[0, 0, \"x\"]", "direction", "a number from -1000 to 1000"},
      {"start_mm = 5", "start_mm = 5\nthrough = \"centroid\"", "through",
       "either through or point_mm"},
      {"max_force_n = 4", "max_force_n = -4", "max_force_n = -4", "a number from 0.01 to 100"},
      {"max_force_n = 4", "max_force_n = 4\nmax_slew_n_per_s = 100", "max_slew_n_per_s",
       "100: expected at least 200"},
      {"max_force_n = 4", "kind = \"omni\"", "omni", "\"steered\" or \"replay\""},
      {"max_force_n = 4", "kind = \"replay\"", "[device]", "device.recording: missing"},
      {"[guard]", "[steering]\ntarget_mm = [1, 2, 3]\n[guard]", "target_mm", "none otherwise"},
      {"[guard]", "[steering]\nvia_mm = [1, 2, 3]\n[guard]", "via_mm", "a list of 3 numbers"},
      {"max_force_n = 4", "max_stiffness_n_per_m = 1000\n[coupling]\nstiffness_n_per_m = 701",
       "stiffness_n_per_m = 701", "a number from 0 to 700"},
      {"ramp_ms = 100", "watchdog_ms = 50", "watchdog_ms", "a number from 1 to 5"},
  });
}

TEST(Scene, MistakesOfDeviceModelsAndGuardLimits) {
  expect_refusals({
      {"max_force_n = 4", "model = \"Touch\"", "Touch", "one of \"touch\", \"omni\""},
      {"max_force_n = 4", "model = 3", "model", "model: 3: expected a text in quotes"},
      {"max_force_n = 4", "continuous_force_n = 0", "continuous", "a number from 0.01 to 100"},
      {"max_force_n = 4", "delay_ms = 9", "delay_ms", "at most 16 periods of the loop, 8 ms"},
      {"max_force_n = 4", "resolution_mm = 2", "resolution", "a number from 0 to 1"},
      {"max_force_n = 4", "mass_g = -1", "mass_g", "a number from 0 to 10000"},
      {"max_force_n = 4", "friction_n = 11", "friction_n", "a number from 0 to 10"},
      {"max_force_n = 4", "damping_n_s_per_m = \"x\"", "damping_n_s", "a number from 0 to 1000"},
      {"max_force_n = 4", "max_damping_n_s_per_m = 1e4", "max_damping", "a number from 0 to 1000"},
      {"ramp_ms = 100", "max_speed_mm_per_s = 5", "max_speed", "a number from 10 to 20000"},
      {"ramp_ms = 100", "buzz_n = 0", "buzz_n", "a number from 0.001 to 100"},
      {"ramp_ms = 100", "thermal_s = 0.5", "thermal_s", "a number from 1 to 3600"},
      {"ramp_ms = 100", "acknowledge_button = -2", "acknowledge", "a whole number from 0 to 31"},
      {"ramp_ms = 100", "dead_man_button = 32", "dead_man", "a whole number from 0 to 31"},
      {"ramp_ms = 100", "passivity_damping_n_s_per_m = -1", "passivity", "from 0 to 1000"},
      {"ramp_ms = 100", "max_slew_n_per_s = 150", "max_slew", "at least 200"},
  });
}

TEST(Scene, AModelBringsItsLimitsAndOwnKeysWin) {
  const Hand touch =
      parse_scene(changed("max_force_n = 4", "model = \"touch\""), "s.toml").hands[0];
  EXPECT_EQ(touch.guard.max_force_n, 3.3F);
  EXPECT_EQ(touch.guard.continuous_force_n, 0.88F);
  EXPECT_NEAR(of(touch.guard.buzz_n), 0.33, 1e-6);
  EXPECT_EQ(touch.guard.passivity_damping_n_s_per_m, 2);
  EXPECT_NEAR(of(touch.guard.stored_energy_j), 0.5 * 3.3 * 0.16, 1e-6);
  EXPECT_EQ(touch.guard.dead_man_button, -1);
  EXPECT_EQ(touch.guard.acknowledge_button, -1);
  EXPECT_NEAR(of(touch.coupling.stiffness_n_per_m), 280, 1e-3);
  EXPECT_EQ(touch.coupling.max_force_n, 3.3F);
  EXPECT_EQ(touch.coupling.period_s, 5e-4F);
  EXPECT_EQ(touch.hand.device.friction_n, 0.26F);
  EXPECT_EQ(touch.guard.device.delay_s, 1e-3F);
  EXPECT_EQ(touch.limits.max_stiffness_n_per_m, 400);
  const std::string own =
      "model = \"touch\"\nmax_force_n = 0.5\nresolution_mm = 0.02\nmax_damping_n_s_per_m = 6";
  std::string text = changed("max_force_n = 4", own);
  const std::string more =
      "dead_man_button = 1\nacknowledge_button = 2\nthermal_s = 30\nmax_speed_mm_per_s = 500\n";
  const Hand changed_hand = parse_scene(text.insert(text.find("ramp_ms"), more), "s.toml").hands[0];
  EXPECT_EQ(changed_hand.guard.max_force_n, 0.5F);
  EXPECT_EQ(changed_hand.guard.continuous_force_n, 0.5F);  // no more than the largest
  EXPECT_NEAR(of(changed_hand.hand.device.resolution_m), 2e-5, 1e-9);
  EXPECT_EQ(changed_hand.guard.passivity_damping_n_s_per_m, 3);
  EXPECT_EQ(changed_hand.guard.dead_man_button, 1);
  EXPECT_EQ(changed_hand.guard.acknowledge_button, 2);
  EXPECT_EQ(changed_hand.hand.held_buttons, 2U);
  EXPECT_EQ(changed_hand.guard.thermal_s, 30);
  EXPECT_NEAR(of(changed_hand.guard.max_speed_m_per_s), 0.5, 1e-7);
  // Without a device there is no thermal budget, only the forces.
  const Hand none = parse_scene(kGood, "s.toml").hands[0];
  EXPECT_EQ(none.guard.continuous_force_n, none.guard.max_force_n);
  EXPECT_EQ(none.guard.passivity_damping_n_s_per_m, 0);
  EXPECT_EQ(none.hand.device.mass_kg, 0);
}

TEST(Scene, AnAttachedDeviceLowersItsLimits) {
  Hand hand = parse_scene(kGood, "s.toml").hands[0];
  DeviceInfo info = {"Touch", 3, 2000, 400};
  fit_to_device(info, hand);
  EXPECT_EQ(hand.guard.max_force_n, 3);
  EXPECT_EQ(hand.guard.continuous_force_n, 4);  // the scene's: the device reports none
  EXPECT_EQ(hand.coupling.max_force_n, 3);
  EXPECT_NEAR(of(hand.coupling.stiffness_n_per_m), 280, 1e-3);
  info.continuous_force_n = 0.88F;
  fit_to_device(info, hand);
  EXPECT_EQ(hand.guard.continuous_force_n, 0.88F);
}

// Thresholds are those of the opened device; a scene's own can only make them stricter.
TEST(Scene, TheGuardsThresholdsAreThoseOfTheOpenedDevice) {
  const DeviceModel& touch = *find_device_model("touch");
  const DeviceInfo info = {.name = "Touch",
                           .max_force_n = 2.97F,
                           .max_slew_n_per_s = 1000,
                           .max_stiffness_n_per_m = 400,
                           .continuous_force_n = 0.88F,
                           .identity = "123",
                           .model = &touch};
  const char* strong = "[device]\nmax_force_n = 30\n[[hand.waypoint]]\nhold_s = 1\n";
  Hand hand = parse_scene(strong, "s").hands[0];
  const std::string told = fit_to_device(info, hand);
  EXPECT_NEAR(of(hand.guard.max_force_n), 2.97, 1e-6);
  EXPECT_NEAR(of(hand.guard.buzz_n), 0.297, 1e-6);
  EXPECT_NEAR(of(hand.guard.continuous_force_n), 0.88, 1e-6);
  EXPECT_NEAR(of(hand.guard.device.damping_n_s_per_m), 400 * 1.5e-3, 1e-6);
  EXPECT_NEAR(of(hand.guard.device.friction_n), 0.26, 1e-6);
  EXPECT_NEAR(of(hand.guard.device.resolution_m), 0.055e-3, 1e-9);
  EXPECT_NEAR(of(hand.guard.device.delay_s), 1e-3, 1e-9);
  EXPECT_NEAR(of(hand.guard.passivity_damping_n_s_per_m), 2, 1e-6);
  EXPECT_NEAR(of(hand.guard.stored_energy_j), 0.5 * 2.97 * 0.16, 1e-5);
  for (const char* part : {"Touch 123", "taken for \"touch\"", "at most 2.97 N (device)",
                           "buzz 0.297 N (device)", "friction 0.26 N", "(touch)"}) {
    EXPECT_NE(told.find(part), std::string::npos) << part << ": " << told;
  }
  Hand careful = parse_scene(std::string(strong) +
                                 "[guard]\nbuzz_n = 0.05\nmax_force_n = 1\n"
                                 "passivity_damping_n_s_per_m = 0.5\n",
                             "s")
                     .hands[0];
  EXPECT_NE(fit_to_device(info, careful).find("buzz 0.05 N (scene)"), std::string::npos);
  EXPECT_EQ(careful.guard.max_force_n, 1);
  EXPECT_EQ(careful.guard.buzz_n, 0.05F);
  EXPECT_EQ(careful.guard.passivity_damping_n_s_per_m, 0.5F);
  Hand loose = parse_scene(
                   "[device]\nmax_force_n = 30\nfriction_n = 5\n[guard]\nbuzz_n = 9\n"
                   "passivity_damping_n_s_per_m = 900\n[[hand.waypoint]]\nhold_s = 1\n",
                   "s")
                   .hands[0];
  (void)fit_to_device(info, loose);
  EXPECT_NEAR(of(loose.guard.buzz_n), 0.297, 1e-6);
  EXPECT_NEAR(of(loose.guard.device.friction_n), 0.26, 1e-6);
  EXPECT_EQ(loose.guard.passivity_damping_n_s_per_m, 2);
}

// A limit that scene and device share is of both. The scene's buzz is also at most a tenth of its
// own largest force.
TEST(Scene, ALimitOfTheOpenedDeviceIsToldWithWhoseItIs) {
  const auto told = [](const char* scene, float max_force_n, float force_life_s) {
    DeviceInfo info = {"peer", max_force_n, 2000, 400};
    info.continuous_force_n = 2;
    info.force_life_s = force_life_s;
    Hand hand = parse_scene(std::string(scene) + "[[hand.waypoint]]\nhold_s = 1\n", "s").hands[0];
    return fit_to_device(info, hand);
  };
  const char* both = "[device]\nmax_force_n = 3\ncontinuous_force_n = 2\n";
  EXPECT_EQ(told(both, 3, 4e-3F),
            "peer: at most 3 N (scene and device), buzz 0.3 N (scene and device), for ever 2 N "
            "(scene and device), coupling 280 N/m (device), watchdog 3 ms (scene and device)");
  EXPECT_EQ(told(both, 5, 0),
            "peer: at most 3 N (scene), buzz 0.3 N (scene), for ever 2 N (scene and device), "
            "coupling 280 N/m (device), watchdog 3 ms (scene)");
  EXPECT_EQ(told("[device]\nmax_force_n = 3\n[guard]\nbuzz_n = 9\n"
                 "[coupling]\nstiffness_n_per_m = 280\n",
                 5, 20e-3F),
            "peer: at most 3 N (scene), buzz 0.3 N (scene), for ever 2 N (device), coupling 280 "
            "N/m (scene and device), watchdog 15 ms (device)");
}

TEST(Scene, ANeedleThatADeviceWillHoldNeedsNoScript) {
  EXPECT_THROW(parse_scene("", "s"), SceneError);
  EXPECT_EQ(parse_scene("", "s", 1).hands.size(), 1U);
  const char* two = "[[needles]]\n[[needles]]\n";
  EXPECT_THROW(parse_scene(two, "s", 1), SceneError);
  EXPECT_EQ(parse_scene(two, "s", 2).hands.size(), 2U);
}

TEST(Scene, MistakesOfWaypoints) {
  expect_refusals({
      {"time_s = 0.5", "", "lateral_mm", "either speed_mm_s or time_s", 1},
      {"time_s = 0.5", "time_s = 0.5\nspeed_mm_s = 3", "speed_mm_s = 3",
       "either speed_mm_s or time_s"},
      {"lateral_mm = [2, -1]", "", "time_s", "a place to go to", 2},
      {"time_s = 0.5", "time_s = 0.5\nduty = 0.5", "duty", "only with turns"},
      {"time_s = 0.5", "time_s = 0.5\nturns = 1.5\nduty = 0.5", "turns", "a whole number where"},
      {"time_s = 0.5", "time_s = 0.5\nturns = -3\nduty = 0.5", "turns",
       "at most 9.55 for each second"},
  });
}

// EI = E pi (D^4 - d^4) / 64, for steel tubes of 200 GPa (four digits) and nitinol wires of 75 GPa
// (three digits).
TEST(Scene, GaugesHaveTheirStiffness) {
  const struct {
    const char* gauge;
    double outer_mm, bending_nm2, tolerance;
  } gauges[] = {{"17G", 1.473, 3.349e-2, 1e-3},        {"18G", 1.270, 2.070e-2, 1e-3},
                {"20G", 0.9081, 5.378e-3, 1e-3},       {"22G", 0.7176, 2.318e-3, 1e-3},
                {"25G", 0.5144, 6.425e-4, 1e-3},       {"nitinol-0.46", 0.46, 1.65e-4, 5e-3},
                {"nitinol-0.58", 0.58, 4.17e-4, 5e-3}, {"nitinol-0.70", 0.70, 8.84e-4, 5e-3},
                {"nitinol-1.0", 1.0, 3.68e-3, 5e-3}};
  for (const auto& each : gauges) {
    const std::string named = "gauge = \"" + std::string(each.gauge) + "\"";
    const NeedleConfig rigid = parse_scene(changed("gauge = \"22G\"", named), "s").config.needle[0];
    EXPECT_EQ(rigid.bending_nm2, 0) << each.gauge;
    EXPECT_NEAR(of(rigid.outer_radius_m), 0.5e-3 * each.outer_mm, 1e-9);
    const std::string text = changed("gauge = \"22G\"", named + "\nflexible = true");
    const double bending = of(parse_scene(text, "s").config.needle[0].bending_nm2);
    EXPECT_NEAR(bending / each.bending_nm2, 1, each.tolerance) << each.gauge;
  }
}

TEST(Scene, NeedlesWithDimensionsOfTheirOwn) {
  const auto needle = [](const std::string& keys) {
    return parse_scene(changed("gauge = \"22G\"", keys), "s").config.needle[0];
  };
  // A solid steel bar of 1 mm: E pi d^4 / 64.
  EXPECT_NEAR(of(needle("od_mm = 1\nflexible = true").bending_nm2), 9.8175e-3, 1e-6);
  EXPECT_NEAR(
      of(needle("od_mm = 1\nid_mm = 0.5\nmaterial = \"nitinol\"\nflexible = true").bending_nm2),
      9.8175e-3 * 75 / 200 * (1 - 0.0625), 1e-6);
  EXPECT_NEAR(of(needle("od_mm = 1\ne_gpa = 100\nflexible = true").bending_nm2), 4.9087e-3, 1e-6);
  EXPECT_EQ(needle("tip = \"bevel\"").torsion_nm2, 0);
  EXPECT_NEAR(of(needle("od_mm = 1\ne_gpa = 100\nroll_lag = true").torsion_nm2), 3.7759e-3, 1e-6);
  EXPECT_EQ(needle("tip = \"bevel\"").bevel_per_m, 5);
  EXPECT_EQ(needle("tip = \"bevel\"\ncurvature_per_m = 12").bevel_per_m, 12);
  EXPECT_EQ(needle("tip = \"diamond\"").bevel_per_m, 0);
  const NeedleConfig bent = needle("tip = \"bent\"\nbent_length_mm = 8\nbent_angle_deg = 18");
  EXPECT_NEAR(of(bent.bent_length_m), 8e-3, 1e-8);
  EXPECT_NEAR(of(bent.bent_angle_rad), 0.314159, 1e-6);
  EXPECT_EQ(needle("rods = 64").rods, 64U);
  EXPECT_EQ(needle("rods = 64").tip_half_angle_rad, NeedleConfig{}.tip_half_angle_rad);
  EXPECT_EQ(needle("half_angle_deg = 5").tip_half_angle_rad, kMinTipHalfAngleRad);
  EXPECT_EQ(needle("half_angle_deg = 80").tip_half_angle_rad, kMaxTipHalfAngleRad);
}

// What acts is what has changed since the organ's shape was taken.
TEST(Scene, Gravity) {
  const auto gravity = [](const char* table) {
    const std::string text = changed("[guard]", std::string(table) + "\n[guard]");
    return parse_scene(text, "s.toml").config.gravity_m_per_s2;
  };
  const auto nothing = [](Vec3 g) { return g.x == 0 && g.y == 0 && g.z == 0; };
  EXPECT_TRUE(nothing(gravity("")));
  const Vec3 weightless = gravity("[gravity]\nnow_m_per_s2 = [0, 9, -3]");
  EXPECT_EQ(weightless.y, 9);
  EXPECT_EQ(weightless.z, -3);
  const Vec3 turned =
      gravity("[gravity]\nnow_m_per_s2 = [0, 9, -3]\nat_rest_m_per_s2 = [1, 0, -9]");
  EXPECT_EQ(turned.x, -1);
  EXPECT_EQ(turned.y, 9);
  EXPECT_EQ(turned.z, 6);
  EXPECT_TRUE(
      nothing(gravity("[gravity]\nnow_m_per_s2 = [0, 9, 0]\nat_rest_m_per_s2 = [0, 9, 0]")));
}

// What flows through a needle: nothing, unless the scene opens its hub.
TEST(Scene, HubAndSyringe) {
  EXPECT_EQ(parse_scene(kGood, "s.toml").config.needle[0].hub, Hub::kClosed);
  const auto needle = [](const std::string& keys) {
    return parse_scene(changed("unit_mm = 4", "unit_mm = 4\n" + keys), "s.toml").config.needle[0];
  };
  const NeedleConfig open = needle("hub = \"open\"\nfilling_mpa_s = 0.0182");
  EXPECT_EQ(open.hub, Hub::kOpen);
  EXPECT_NEAR(of(open.bore_radius_m), 0.413e-3 / 2, 1e-9);  // 22G
  EXPECT_NEAR(of(open.opening_m), 0.7176e-3 / 4 / std::tan(15 * 3.14159265358979 / 180), 1e-9);
  EXPECT_NEAR(of(open.filling_pa_s), 18.2e-6, 1e-12);
  const NeedleConfig syringe = needle(R"(hub = "syringe"
opening_mm = 1.5
syringe = {plunger_mm = 12, friction_n = 0.2, barrel_ml = 5, filled_ml = 4, gas_ml = 0.3})");
  EXPECT_EQ(syringe.hub, Hub::kSyringe);
  EXPECT_NEAR(of(syringe.opening_m), 1.5e-3, 1e-9);
  EXPECT_NEAR(of(syringe.filling_pa_s), 1e-3, 1e-9);
  EXPECT_NEAR(of(syringe.plunger_radius_m), 6e-3, 1e-9);
  EXPECT_NEAR(of(syringe.plunger_friction_n), 0.2, 1e-7);
  EXPECT_NEAR(of(syringe.syringe_m3), 5e-6, 1e-12);
  EXPECT_NEAR(of(syringe.syringe_filled), 0.8, 1e-7);
  EXPECT_NEAR(of(syringe.syringe_gas_m3), 3e-7, 1e-13);
}

// The thumb presses from a waypoint on, or while a button of the device is pressed.
TEST(Scene, ForceOnThePlunger) {
  const Scene scene = parse_scene(changed("time_s = 0.5",
                                          "time_s = 0.5\nplunger_n = -2\n[[hand.waypoint]]\n"
                                          "hold_s = 1\n[mapping]\nplunger_button = 3\n"
                                          "plunger_n = 7"),
                                  "s.toml");
  const auto& way = scene.hands[0].waypoints;
  ASSERT_EQ(way.size(), 3U);
  EXPECT_EQ(way[0].plunger_n, 0);
  EXPECT_EQ(way[1].plunger_n, -2);
  EXPECT_EQ(way[2].plunger_n, -2);
  EXPECT_EQ(scene.hands[0].grip.plunger_button, 3);
  EXPECT_EQ(scene.hands[0].grip.plunger_n, 7);
}

TEST(Scene, ObstaclesAndBreathing) {
  const std::string text = changed("[guard]", R"([breathing]
amplitude_mm = [0, 6, -8]
period_s = 5
[[obstacles]]
shape = "box"
size_mm = [10, 20, 30]
at_mm = [1, 2, 3]
turn_deg = [90, 0, 90]
stiffness_n_per_mm = 15
largest_force_n = 12
friction = 0.1
[[obstacles]]
shape = "sphere"
radius_mm = 7
at_mm = [0, 0, 0]
[guard])");
  const Scene scene = parse_scene(text, "s.toml");
  EXPECT_NEAR(of(scene.config.breathing.amplitude_m.z), -8e-3, 1e-8);
  EXPECT_EQ(scene.config.breathing.period_s, 5);
  ASSERT_EQ(scene.obstacles.size(), 2U);
  const ObstacleConfig& box = scene.obstacles[0];
  ASSERT_EQ(box.vertex_count, 8U);
  EXPECT_NEAR(of(box.vertices_m[7].y), 10e-3, 1e-8);
  EXPECT_NEAR(of(box.pose.position_m.z), 3e-3, 1e-8);
  EXPECT_NEAR(of(box.stiffness_n_per_m), 15e3, 1e-2);
  EXPECT_NEAR(of(box.largest_force_n), 12, 1e-6);
  EXPECT_NEAR(of(box.friction), 0.1, 1e-7);
  // First about x: y becomes z; then about z: x becomes y.
  EXPECT_NEAR(of(rotate(box.pose.rotation, {0, 1, 0}).z), 1, 1e-6);
  EXPECT_NEAR(of(rotate(box.pose.rotation, {1, 0, 0}).y), 1, 1e-6);
  EXPECT_EQ(scene.obstacles[1].vertex_count, 1U);
  EXPECT_NEAR(of(scene.obstacles[1].rounding_m), 7e-3, 1e-8);
  // Defaults are those of hal/scene/README.md, and to the bit those of the hosts.
  const ObstacleConfig contact;
  EXPECT_EQ(contact.stiffness_n_per_m, 20e3F);
  EXPECT_EQ(contact.largest_force_n, 50);
  EXPECT_EQ(contact.friction, 0.3F);
  EXPECT_EQ(scene.obstacles[1].stiffness_n_per_m, contact.stiffness_n_per_m);
  EXPECT_EQ(scene.obstacles[1].largest_force_n, contact.largest_force_n);
  EXPECT_EQ(scene.obstacles[1].friction, contact.friction);
}

std::string written(const char* name, const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / (std::to_string(getpid()) + name);
  std::ofstream(path) << text;
  return path.string();
}

TEST(Scene, HullsAreReadFromTheirFile) {
  const std::string hull = written("hull.toml",
                                   "source = \"rib.stl\"\nsha256 = \"00\"\n"
                                   "deviation_mm = 0.1\nvertices_m = [\n  [0, 0, 0],\n"
                                   "  [0.01, 0, 0],\n  [0, 0.02, 0],\n  [0, 0, 0.03],\n]\n");
  const std::string keys = "[[obstacles]]\nshape = \"hull\"\nat_mm = [0, 0, 0]\nhull = \"" +
                           std::filesystem::path(hull).filename().string() + "\"\n[guard]";
  const std::string beside = std::filesystem::path(hull).replace_filename("s.toml").string();
  const Scene scene = parse_scene(changed("[guard]", keys), beside);
  ASSERT_EQ(scene.obstacles.at(0).vertex_count, 4U);
  EXPECT_NEAR(of(scene.obstacles[0].vertices_m[3].z), 0.03, 1e-8);
  (void)written("hull.toml", "source = \"rib.stl\"\nvertices_m = [\n  [0, 0],\n]\n");
  try {
    (void)parse_scene(changed("[guard]", keys), beside);
    ADD_FAILURE() << "a vertex with two numbers";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(hull + ":2: vertices_m: "));
    EXPECT_THAT(error.what(), testing::EndsWith("a list of 3 numbers"));
  }
  std::filesystem::remove(hull);
  EXPECT_THROW((void)parse_scene(changed("[guard]", keys), beside), SceneError);
}

TEST(Scene, WaypointsThatRoll) {
  const auto last = [](const std::string& keys) {
    return parse_scene(changed("time_s = 0.5", "time_s = 0.5\n" + keys), "s").hands[0].waypoints[1];
  };
  EXPECT_EQ(last("").turns, 0);
  EXPECT_EQ(last("turns = -2").turns, -2);
  EXPECT_EQ(last("turns = 1.25").duty, 1);
  EXPECT_EQ(last("turns = 2\nduty = 0.5").duty, 0.5F);
}

TEST(Scene, SteeredHandNeedsATarget) {
  EXPECT_THAT(error_of(changed("max_force_n = 4", "kind = \"steered\"")),
              testing::HasSubstr("steering.target_mm: missing: expected a point"));
  EXPECT_THAT(
      error_of(changed("max_force_n = 4", "kind = \"steered\"\n[steering]\ntarget_mm = [1, 2, 3]")),
      testing::HasSubstr("s.toml:22: steering.curvature_per_m: missing"));
}

TEST(Scene, SteeringAndCoupling) {
  std::string text = changed("max_force_n = 4", R"(kind = "steered"
max_stiffness_n_per_m = 1000
[steering]
via_mm = [[1, 2, 3], [4, 5, 6]]
target_mm = [7, 8, 9]
speed_mm_per_s = 4
roll_deg_per_s = 180)");
  const std::string sharp = "tip = \"bevel\"\ncurvature_per_m = 6\n";
  const Scene scene = parse_scene(text.insert(text.find("unit_mm"), sharp), "s.toml");
  ASSERT_EQ(scene.hands[0].steering.targets_m.size(), 3U);
  EXPECT_NEAR(of(scene.hands[0].steering.targets_m[1].z), 6e-3, 1e-9);
  EXPECT_NEAR(of(scene.hands[0].steering.targets_m[2].x), 7e-3, 1e-9);
  EXPECT_NEAR(of(scene.hands[0].steering.speed_m_per_s), 4e-3, 1e-9);
  EXPECT_EQ(scene.hands[0].steering.curvature_per_m, 6);
  EXPECT_NEAR(of(scene.hands[0].steering.roll_rad_per_s), 3.14159, 1e-5);
  EXPECT_NEAR(of(scene.hands[0].coupling.stiffness_n_per_m), 700, 1e-3);
  EXPECT_EQ(parse_scene(kGood, "s.toml").hands[0].coupling.stiffness_n_per_m, 0);
}

const std::string kTwo = R"([[needles]]
gauge = "17G"
[needles.approach]
direction = [1, 0, 0]
[[needles.hand.waypoint]]
travel_mm = 20
speed_mm_s = 10
[[needles]]
gauge = "25G"
[needles.approach]
direction = [0, 1, 0]
[needles.device]
max_force_n = 3
[[needles.hand.waypoint]]
travel_mm = 30
speed_mm_s = 10
)";

TEST(Scene, EachOfSeveralNeedlesHasItsOwn) {
  const Scene scene = parse_scene(kTwo, "s.toml");
  ASSERT_EQ(scene.config.needle_count, 2U);
  ASSERT_EQ(scene.hands.size(), 2U);
  EXPECT_NEAR(of(scene.config.needle[1].outer_radius_m), 0.2572e-3, 1e-9);
  EXPECT_EQ(scene.hands[1].approach.direction.y, 1);
  EXPECT_EQ(scene.hands[0].guard.max_force_n, 8);
  EXPECT_EQ(scene.hands[1].guard.max_force_n, 3);
  EXPECT_NEAR(of(scene.hands[1].waypoints.at(0).travel_m), 0.03, 1e-8);
}

TEST(Scene, SeveralNeedlesRefuse) {
  EXPECT_THAT(error_of("[needle]\ngauge = \"18G\"\n" + kTwo),
              testing::HasSubstr("s.toml:1: needle: "));
  EXPECT_THAT(error_of(kTwo + "[approach]\nstart_mm = 3\n"),
              testing::HasSubstr("s.toml:17: approach: "));
  std::string text = kTwo;
  text.replace(text.find("25G"), 3, "28G");
  EXPECT_THAT(error_of(text), testing::StartsWith("s.toml:9: needles.gauge: '28G': "));
  EXPECT_THAT(error_of(kTwo + kTwo + kTwo), testing::HasSubstr("at most 4 needles"));
  text = kTwo;
  text.replace(text.find("[needles.device]"), 16, "[needles.devise]");
  EXPECT_THAT(error_of(text), testing::StartsWith("s.toml:12: needles.devise: "));
}

TEST(Scene, SimulatedHandNeedsAScript) {
  EXPECT_THAT(error_of("[hand]\nmass_g = 100\n"),
              testing::HasSubstr("hand.waypoint: missing: expected at least one"));
}

TEST(Scene, MissingFileIsNamed) {
  try {
    (void)read_scene("/nowhere/s.toml");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/nowhere/s.toml: no such file"));
  }
}

TEST(Scene, ProjectScenesLoad) {
  const Scene scene = read_scene(STYLET_SCENES "/fig09-force-curve.toml");
  EXPECT_EQ(scene.hands[0].waypoints.size(), 2U);
  EXPECT_EQ(
      script_ticks(make_script(scene.hands[0].waypoints, scene.hands[0].approach.start_m), 1e-3),
      18000U);
}

// ---- from the scene to the world
// -------------------------------------------------------------------

struct Block {
  std::vector<std::byte> bytes;
  Organ organ;
};

// 40 x 40 x 60 mm with its low corner at (100, 0, -20) mm.
Block block() {
  Block result;
  test::TinyOrgan tiny;
  tiny.nz = 12;
  tiny.origin_m = {0.1F, 0, -0.02F};
  result.bytes = test::tiny_organ(tiny);
  EXPECT_EQ(organ_open(result.bytes, result.organ), Status::kOk);
  return result;
}

TEST(Placement, TipStartsOutsideTheSurfaceAndPointsIn) {
  const Block b = block();
  const float half = std::sqrt(0.5F);
  for (const Vec3 d : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1},
                       Vec3{half, 0, half}, Vec3{0, -half, -half}}) {
    Scene scene;
    scene.hands[0].approach.direction = d;
    scene.hands[0].approach.start_m = 0.01F;
    const Placement placed = place_needle(scene, b.organ);
    const Pose start = to_world(placed.mapping, {{}, {1, 0, 0, 0}});
    const Vec3 needle = rotate(start.rotation, {0, 0, -scene.config.needle[0].length_m});
    // Tip = entry - start * direction, and the needle lies along the direction.
    EXPECT_NEAR(of(start.position_m.x + needle.x), of(placed.course.entry_m.x - 0.01F * d.x), 1e-6);
    EXPECT_NEAR(of(start.position_m.y + needle.y), of(placed.course.entry_m.y - 0.01F * d.y), 1e-6);
    EXPECT_NEAR(of(start.position_m.z + needle.z), of(placed.course.entry_m.z - 0.01F * d.z), 1e-6);
    EXPECT_NEAR(of(needle.x), of(0.15F * d.x), 1e-6);
    EXPECT_NEAR(of(needle.y), of(0.15F * d.y), 1e-6);
    EXPECT_NEAR(of(needle.z), of(0.15F * d.z), 1e-6);
    // A push of the device along -z moves the needle in; the tissue's force comes back along +z.
    const Pose pushed = to_world(placed.mapping, {{0, 0, -0.02F}, {1, 0, 0, 0}});
    EXPECT_NEAR(of(pushed.position_m.x - start.position_m.x), of(0.02F * d.x), 1e-6);
    EXPECT_NEAR(of(to_device(placed.mapping, {-d.x, -d.y, -d.z}).z), 1, 1e-6);
  }
}

TEST(Placement, EntryIsOnTheFaceTowardsTheNeedle) {
  const Block b = block();
  Scene scene;
  EXPECT_NEAR(of(place_needle(scene, b.organ).course.entry_m.x), 0.1, 1e-6);
  scene.hands[0].approach.direction = {-1, 0, 0};
  EXPECT_NEAR(of(place_needle(scene, b.organ).course.entry_m.x), 0.14, 1e-6);
  scene.hands[0].approach.direction = {0, 0, -1};
  scene.hands[0].approach.through_m = Vec3{0.11F, 0.01F, 0};
  const Vec3 entry = place_needle(scene, b.organ).course.entry_m;
  EXPECT_NEAR(of(entry.x), 0.11, 1e-6);
  EXPECT_NEAR(of(entry.y), 0.01, 1e-6);
  EXPECT_NEAR(of(entry.z), 0.04, 1e-6);
}

TEST(Placement, ALineThatMissesIsRefused) {
  const Block b = block();
  Scene scene;
  scene.file = "s.toml";
  scene.hands[0].approach.through_m = Vec3{0.1F, 0.5F, 0};
  EXPECT_THROW((void)place_needle(scene, b.organ), SceneError);
}

}  // namespace
}  // namespace stylet::hal
