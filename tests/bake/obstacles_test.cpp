// SPDX-License-Identifier: Apache-2.0
// Obstacles of label maps: convex pieces that leave what they go around free, and a warning where
// they do not.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "bake_support.h"
#include "label_organ.h"
#include "random_bodies.h"
#include "stylet/limits.h"

namespace stylet::test {
namespace {

using bake::Vec;

std::string warning_of(const std::vector<std::string>& warnings, const std::string& of) {
  for (const std::string& each : warnings) {
    if (each.starts_with(of)) return each;
  }
  return "";
}

// A ring around a ball of liver, both tilted: one hull would hold the ball.
bake::LabelMap ring_map(Draw& draw) {
  bake::LabelMap map;
  map.size = {90, 90, 90};
  map.step_m = {Vec{1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, 1e-3}};
  map.origin_m = {-45e-3, -45e-3, -45e-3};
  map.sha256 = std::string(64, '0');
  const std::array<Vec, 3> frame = random_frame(draw);
  const double ring = draw.between(32, 36), tube = draw.between(4, 6), ball = draw.between(12, 18);
  for (int i = 0; i < 90 * 90 * 90; ++i) {
    const Vec at{i % 90 - 45.0, i / 90 % 90 - 45.0, i / 8100 - 45.0};
    const double out = std::hypot(dot(at, frame[0]), dot(at, frame[1])) - ring;
    const bool in_ring = std::hypot(out, dot(at, frame[2])) < tube;
    map.label.push_back(in_ring ? 2 : length(at) < ball ? 1 : 0);
  }
  return map;
}

TEST(Obstacles, ARingLeavesWhatItGoesAroundFree) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Draw draw(seed);
    const bake::LabelMap map = ring_map(draw);
    bake::Recipe recipe = {{}, {{"liver", {1}}}};
    recipe.obstacles = {{"rib", {2}}};
    const bake::Built built =
        bake::build_labels("ring", map, recipe, {}, [](const char*, double) {});
    double hulls_m3 = 0, labels_m3 = 0;
    for (const bake::NamedHull& each : built.obstacles) {
      hulls_m3 += each.hull.volume_m3;
      labels_m3 += each.label_m3;
      EXPECT_EQ(each.obstacle, "rib");
      EXPECT_TRUE(each.swallowed_m3.empty()) << each.name;
      // No voxel of liver is on the inner side of all of the hull's faces.
      const auto planes = bake::hull_planes(each.hull);
      for (std::size_t i = 0; i < map.label.size(); i += 37) {
        if (map.label[i] != 1) continue;
        const Vec at = Vec{static_cast<double>(i % 90), static_cast<double>(i / 90 % 90),
                           static_cast<double>(i / 8100)} *
                           1e-3 +
                       map.origin_m;
        EXPECT_TRUE(std::any_of(planes.begin(), planes.end(), [&](const bake::HullPlane& plane) {
          return dot(plane.normal, at) > plane.limit;
        }));
      }
    }
    const auto ring_voxels = std::count(map.label.begin(), map.label.end(), 2);
    EXPECT_NEAR(labels_m3, static_cast<double>(ring_voxels) * 1e-9, 1e-12);
    EXPECT_GT(built.obstacles.size(), 3U);
    EXPECT_LE(built.obstacles.size(), kMaxObstacles);
    EXPECT_LT(hulls_m3 / labels_m3, 1.5);  // one hull: 3 to 6 times
    for (const bake::NamedHull& each : built.obstacles) {
      const double off = std::abs(each.hull.volume_m3 / each.label_m3 - 1);
      const bool told = !warning_of(built.report.warnings, "obstacle " + each.name + ":").empty();
      EXPECT_TRUE(off > 0.05 ? told : off > 0.01 || !told) << each.name << ": " << off;
    }
  }
}

// With as many obstacles as the kernel takes there is no room to cut: what they hold is told.
TEST(Obstacles, WhatAHullSwallowsIsTold) {
  Draw draw(9);
  const bake::LabelMap map = ring_map(draw);
  bake::LabelMap many = map;
  std::uint16_t next = 3;
  constexpr std::uint16_t kTumour = 40;  // the half of the ball toward the head
  for (std::size_t i = many.label.size() / 2; i < many.label.size(); ++i) {
    if (many.label[i] == 1) many.label[i] = kTumour;
  }
  bake::Recipe recipe = {{}, {{"liver", {1}}, {"tumour", {kTumour}}}};
  recipe.obstacles = {{"rib", {2}}};
  for (; next < 3 + kMaxObstacles - 1; ++next) {
    many.label[next * std::size_t{4}] = next;
    recipe.obstacles.push_back({fmt::format("bone{}", next), {next}});
  }
  const bake::Built built =
      bake::build_labels("ring", many, recipe, {}, [](const char*, double) {});
  const std::string said = warning_of(built.report.warnings, "obstacle rib: ");
  const double liver_ml =
      static_cast<double>(std::count(map.label.begin(), map.label.end(), 1)) * 1e-3;
  EXPECT_THAT(said, testing::HasSubstr("% off its labels of "));
  std::smatch found;
  const std::regex both("in it ([0-9.]+) ml of liver, ([0-9.]+) ml of tumour: ");
  ASSERT_TRUE(std::regex_search(said, found, both)) << said;
  EXPECT_GT(std::stod(found[1]) + std::stod(found[2]), 0.3 * liver_ml);
  EXPECT_LE(std::stod(found[1]) + std::stod(found[2]), 1.01 * liver_ml);
}

// A piece of an obstacle does not get the name that another obstacle has; what is nowhere in the
// map is told, and is not in the scene.
TEST(Obstacles, NamesAreTheirOwnAndWhatIsMissingIsTold) {
  Draw draw(5);
  bake::LabelMap map = ring_map(draw);
  for (const std::size_t corner : {0U, 1U, 90U, 91U, 8100U, 8101U, 8190U, 8191U}) {
    map.label[corner] = 3;
  }
  bake::Recipe recipe = {{}, {{"liver", {1}}}};
  recipe.obstacles = {{"rib", {2}}, {"rib-1", {3}}, {"spine", {8}}};
  recipe.targets = {{"lesion", {9}}};
  const bake::Built built = bake::build_labels("ring", map, recipe, {}, [](const char*, double) {});
  std::set<std::string> names;
  for (const bake::NamedHull& each : built.obstacles) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_EQ(each.name == "rib-1", each.obstacle == "rib-1");
  }
  EXPECT_TRUE(names.contains("rib-1") && names.contains("rib-2") && names.contains("rib-3"));
  EXPECT_TRUE(built.targets.empty());
  for (const char* missing : {"spine", "lesion"}) {
    EXPECT_EQ(warning_of(built.report.warnings, std::string("none of the labels of ") + missing),
              std::string("none of the labels of ") + missing + " is in the map");
  }
  EXPECT_THAT(bake::scene_toml("a.organ", {}, built.targets),
              testing::Not(testing::HasSubstr("point_mm")));
}

}  // namespace
}  // namespace stylet::test
