// SPDX-License-Identifier: Apache-2.0
// Needles by name: their tubes are those of the standard, a scene takes them and may say otherwise.
#include "hal/base/needles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "hal/scene/scene.h"

namespace stylet::hal {
namespace {

NeedleConfig needle_in(const std::string& keys) {
  return parse_scene("[needle]\n" + keys + "\n[[hand.waypoint]]\ntravel_mm = 10\nspeed_mm_s = 10\n",
                     "s")
      .config.needle[0];
}

// Outer diameters that ISO 9626:2016 allows, by gauge.
TEST(Needles, TubesAreThoseOfTheStandard) {
  const struct {
    const char* gauge;
    double least_mm, most_mm;
  } standard[] = {{"17G", 1.400, 1.510}, {"18G", 1.200, 1.300}, {"19G", 1.030, 1.100},
                  {"20G", 0.860, 0.920}, {"21G", 0.800, 0.830}, {"22G", 0.698, 0.730},
                  {"23G", 0.600, 0.673}, {"24G", 0.550, 0.580}, {"25G", 0.500, 0.530},
                  {"26G", 0.440, 0.470}, {"27G", 0.400, 0.420}, {"14G", 1.950, 2.150}};
  std::set<std::string> names;
  for (const NeedlePreset& each : needle_presets()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_NE(find_tip(each.tip), nullptr) << each.name;
    EXPECT_LT(each.inner_mm, each.outer_mm) << each.name;
    for (const auto& of : standard) {
      if (!std::string(each.name).starts_with(of.gauge)) continue;
      EXPECT_GE(each.outer_mm, of.least_mm) << each.name;
      EXPECT_LE(each.outer_mm, of.most_mm) << each.name;
    }
  }
  for (const auto& of : standard) {
    const std::string gauge = of.gauge;
    EXPECT_TRUE(names.contains(gauge) || names.contains(gauge + "-biopsy")) << gauge;
  }
}

TEST(Needles, ASceneTakesAllOfOne) {
  for (const NeedlePreset& each : needle_presets()) {
    const std::string name = std::string("preset = \"") + each.name + "\"";
    const NeedleConfig scene = needle_in(name + "\nflexible = true"), whole = needle_of(each);
    EXPECT_EQ(scene.outer_radius_m, whole.outer_radius_m) << each.name;
    EXPECT_EQ(scene.length_m, whole.length_m) << each.name;
    EXPECT_EQ(scene.bending_nm2, whole.bending_nm2) << each.name;
    EXPECT_EQ(scene.tip_half_angle_rad, whole.tip_half_angle_rad) << each.name;
    EXPECT_EQ(scene.torn_diameters, whole.torn_diameters) << each.name;
    EXPECT_EQ(scene.bevel_per_m, whole.bevel_per_m) << each.name;
    EXPECT_EQ(needle_in(name).bending_nm2, 0) << each.name;
  }
}

TEST(Needles, ASceneMaySayOtherwise) {
  const NeedleConfig needle =
      needle_in("gauge = \"25G-quincke\"\nlength_mm = 120\ntip = \"blunt\"\nhalf_angle_deg = 45");
  EXPECT_NEAR(static_cast<double>(needle.length_m), 0.12, 1e-8);
  EXPECT_NEAR(static_cast<double>(needle.torn_diameters), std::numbers::pi, 1e-6);
  EXPECT_NEAR(static_cast<double>(needle.tip_half_angle_rad), std::numbers::pi / 4, 1e-6);
  EXPECT_EQ(needle.bevel_per_m, 0);
  EXPECT_EQ(needle_in("gauge = \"22G-bevel\"\ntorn_diameters = 0.8").torn_diameters, 0.8F);
  EXPECT_EQ(needle_in("gauge = \"22G-bevel\"\ncurvature_per_m = 12").bevel_per_m, 12);
  // As ever: a gauge alone is a cone.
  EXPECT_EQ(needle_in("gauge = \"18G\"").torn_diameters, NeedleConfig{}.torn_diameters);
  EXPECT_EQ(needle_in("gauge = \"18G\"").tip_half_angle_rad, NeedleConfig{}.tip_half_angle_rad);
}

// Young's moduli of data sheets, in GPa, of the materials that tables and scenes name.
TEST(Needles, AMaterialByItsNameHasItsModulus) {
  const std::map<std::string, std::pair<double, double>> sheets = {{"steel", {193, 200}},
                                                                   {"nitinol", {40, 83}}};
  ASSERT_EQ(needle_materials().size(), sheets.size());
  for (const NeedleMaterial& each : needle_materials()) {
    const auto& [least_gpa, most_gpa] = sheets.at(each.name);
    // A solid bar of 1 mm: E pi d^4 / 64.
    const NeedleConfig bar =
        needle_in(std::string("od_mm = 1\nflexible = true\nmaterial = \"") + each.name + "\"");
    const double gpa = static_cast<double>(bar.bending_nm2) * 64 / std::numbers::pi * 1e3;
    EXPECT_GT(gpa, least_gpa - 0.01) << each.name;
    EXPECT_LT(gpa, most_gpa + 0.01) << each.name;
  }
  for (const NeedlePreset& each : needle_presets()) {
    const bool nitinol = std::string(each.name).starts_with("nitinol");
    EXPECT_STREQ(each.material.name, nitinol ? "nitinol" : "steel") << each.name;
  }
}

TEST(Needles, AnUnknownOneIsRefusedWithTheList) {
  try {
    (void)needle_in("preset = \"22G-sharp\"");
    FAIL();
  } catch (const SceneError& error) {
    const std::string said = error.what();
    EXPECT_THAT(said, testing::StartsWith("s:2: needle.preset: '22G-sharp': "));
    for (const NeedlePreset& each : needle_presets()) {
      EXPECT_THAT(said, testing::HasSubstr(std::string("\"") + each.name + "\""));
    }
  }
  EXPECT_THROW((void)needle_in("gauge = \"22G\"\ntorn_diameters = 6"), SceneError);
}

}  // namespace
}  // namespace stylet::hal
