// SPDX-License-Identifier: Apache-2.0
// Obstacles from label maps: convex pieces that do not cover what they surround, and a warning if
// they do.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <set>

#include "offline_support.h"
#include "pipeline/label_organ.h"
#include "random_bodies.h"
#include "stylet/limits.h"

namespace stylet::test {
namespace {

using offline::Vec;

std::string warning_of(const std::vector<std::string>& warnings, const std::string& of) {
  for (const std::string& each : warnings) {
    if (each.starts_with(of)) return each;
  }
  return "";
}

// A ring around a ball of liver, both tilted: a single hull would contain the ball.
offline::LabelMap ring_map(Draw& draw) {
  offline::LabelMap map;
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

TEST(Obstacles, ARingDoesNotCoverWhatItSurrounds) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Draw draw(seed);
    const offline::LabelMap map = ring_map(draw);
    offline::Recipe recipe = {{}, {{"liver", {1}}}};
    recipe.obstacles = {{"rib", {2}}};
    const offline::Built built =
        offline::build_labels("ring", map, recipe, {}, [](const char*, double) {});
    double hulls_m3 = 0, labels_m3 = 0;
    for (const offline::NamedHull& each : built.obstacles) {
      hulls_m3 += each.hull.volume_m3;
      labels_m3 += each.label_m3;
      EXPECT_EQ(each.obstacle, "rib");
      EXPECT_TRUE(each.swallowed_m3.empty()) << each.name;
      // No voxel of liver is on the inner side of all of a hull's faces.
      const auto planes = offline::hull_planes(each.hull);
      for (std::size_t i = 0; i < map.label.size(); i += 37) {
        if (map.label[i] != 1) continue;
        const Vec at = Vec{static_cast<double>(i % 90), static_cast<double>(i / 90 % 90),
                           static_cast<double>(i / 8100)} *
                           1e-3 +
                       map.origin_m;
        EXPECT_TRUE(std::any_of(planes.begin(), planes.end(), [&](const offline::HullPlane& plane) {
          return dot(plane.normal, at) > plane.limit;
        }));
      }
    }
    const auto ring_voxels = std::count(map.label.begin(), map.label.end(), 2);
    EXPECT_NEAR(labels_m3, static_cast<double>(ring_voxels) * 1e-9, 1e-12);
    EXPECT_GT(built.obstacles.size(), 3U);
    EXPECT_LE(built.obstacles.size(), kMaxObstacles);
    EXPECT_LT(hulls_m3 / labels_m3, 1.5);  // one hull: 3 to 6 times
    for (const offline::NamedHull& each : built.obstacles) {
      const double off = std::abs(each.hull.volume_m3 / each.label_m3 - 1);
      const bool told = !warning_of(built.report.warnings, "obstacle " + each.name + ":").empty();
      EXPECT_TRUE(off > 0.05 ? told : off > 0.01 || !told) << each.name << ": " << off;
    }
  }
}

// The part of a box that lies in the convex hull of some points: on the inner side of every plane
// through three of them that has all others on one side.
double hull_mm3(Draw& draw, const std::vector<Vec>& vertices_m) {
  std::vector<Vec> places;
  Vec low = vertices_m[0] * 1e3, high = low;
  for (const Vec& each : vertices_m) {
    places.push_back(each * 1e3);
    const Vec at = places.back();
    low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
  }
  std::vector<std::pair<Vec, double>> planes;
  for (std::size_t a = 0; a < places.size(); ++a) {
    for (std::size_t b = a + 1; b < places.size(); ++b) {
      for (std::size_t c = b + 1; c < places.size(); ++c) {
        const Vec across = cross(places[b] - places[a], places[c] - places[a]);
        if (length(across) < 1e-6) continue;
        for (const double side : {1.0, -1.0}) {
          const Vec normal = across * (side / length(across));
          const double limit = dot(normal, places[a]) + 1e-4;
          const bool is_face = std::all_of(places.begin(), places.end(), [&](const Vec& each) {
            return dot(normal, each) <= limit;
          });
          if (is_face) planes.emplace_back(normal, limit);
        }
      }
    }
  }
  constexpr int kPlaces = 100000;
  int inside = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec at = {draw.between(low.x, high.x), draw.between(low.y, high.y),
                    draw.between(low.z, high.z)};
    inside += std::all_of(planes.begin(), planes.end(),
                          [&](const auto& plane) { return dot(plane.first, at) <= plane.second; });
  }
  return (high.x - low.x) * (high.y - low.y) * (high.z - low.z) * inside / kPlaces;
}

// Bent rods of any thickness on voxels of any shape, some nearly balls, and blocks of whole voxels.
// A volume that is more than 5 % off is reported, one that is at most 1 % off is not. The expected
// volume is known to half a percent.
TEST(Obstacles, HullsThatDifferFromTheirLabelsAreReported) {
  int told_count = 0, silent = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Draw draw(seed);
    offline::LabelMap map;
    map.size = {60, 60, 60};
    map.sha256 = std::string(64, '0');
    const std::array<Vec, 3> frame = random_frame(draw), bend = random_frame(draw);
    const double in_plane_mm = draw.between(0.6, 1.5);
    const Vec step_mm = {in_plane_mm, in_plane_mm, draw.between(0.6, 1.5)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      map.step_m[axis] = frame[axis] * (step_mm[axis] * 1e-3);
    }
    const double arm = draw.between(0, 9), thick = draw.between(5, 9);
    const auto from_arm = [&](Vec at, Vec along) {
      return length(at - along * std::clamp(dot(at, along), 0.0, arm));
    };
    std::size_t voxels = 0;
    for (int i = 0; i < 60 * 60 * 60; ++i) {
      const Vec at = Vec{step_mm.x * (i % 60 - 30.3), step_mm.y * (i / 60 % 60 - 29.6),
                         step_mm.z * (i / 3600 - 29.9)};
      const bool is_block = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) < thick;
      const bool is_rod =
          seed % 3 == 0 ? is_block : std::min(from_arm(at, bend[0]), from_arm(at, bend[1])) < thick;
      map.label.push_back(is_rod ? 2 : i / 3600 < 3 ? 1 : 0);
      voxels += is_rod ? 1 : 0;
    }
    offline::Recipe recipe = {{}, {{"liver", {1}}}};
    recipe.obstacles = {{"rod", {2}}};
    const offline::Built built =
        offline::build_labels("rod", map, recipe, {}, [](const char*, double) {});
    if (built.obstacles.size() != 1) continue;
    const double label_mm3 = static_cast<double>(voxels) * step_mm.x * step_mm.y * step_mm.z;
    const double off = hull_mm3(draw, built.obstacles[0].hull.vertices_m) / label_mm3 - 1;
    const bool told = !warning_of(built.report.warnings, "obstacle rod:").empty();
    EXPECT_TRUE(std::abs(off) > 0.05 ? told : std::abs(off) > 0.01 || !told) << seed << ": " << off;
    ++(told ? told_count : silent);
  }
  EXPECT_GT(told_count, 5);
  EXPECT_GT(silent, 5);
}

// With as many obstacles as the kernel takes, none can be divided further: what else they cover is
// reported.
TEST(Obstacles, WhatAHullCoversIsReported) {
  Draw draw(9);
  const offline::LabelMap map = ring_map(draw);
  offline::LabelMap many = map;
  std::uint16_t next = 3;
  constexpr std::uint16_t kTumour = 40;  // the half of the ball toward the head
  for (std::size_t i = many.label.size() / 2; i < many.label.size(); ++i) {
    if (many.label[i] == 1) many.label[i] = kTumour;
  }
  offline::Recipe recipe = {{}, {{"liver", {1}}, {"tumour", {kTumour}}}};
  recipe.obstacles = {{"rib", {2}}};
  for (; next < 3 + kMaxObstacles - 1; ++next) {
    many.label[next * std::size_t{4}] = next;
    recipe.obstacles.push_back({fmt::format("bone{}", next), {next}});
  }
  const offline::Built built =
      offline::build_labels("ring", many, recipe, {}, [](const char*, double) {});
  const std::string said = warning_of(built.report.warnings, "obstacle rib: ");
  const double liver_ml =
      static_cast<double>(std::count(map.label.begin(), map.label.end(), 1)) * 1e-3;
  EXPECT_THAT(said, testing::HasSubstr("ml of its labels"));
  std::smatch found;
  const std::regex both("in it ([0-9.]+) ml of liver, ([0-9.]+) ml of tumour: ");
  ASSERT_TRUE(std::regex_search(said, found, both)) << said;
  EXPECT_GT(std::stod(found[1]) + std::stod(found[2]), 0.3 * liver_ml);
  EXPECT_LE(std::stod(found[1]) + std::stod(found[2]), 1.01 * liver_ml);
}

// A piece of an obstacle does not get the name of another obstacle. An obstacle whose labels are
// not in the map is reported, and is not in the scene.
TEST(Obstacles, NamesAreUniqueAndMissingOnesAreReported) {
  Draw draw(5);
  offline::LabelMap map = ring_map(draw);
  for (const std::size_t corner : {0U, 1U, 90U, 91U, 8100U, 8101U, 8190U, 8191U}) {
    map.label[corner] = 3;
  }
  offline::Recipe recipe = {{}, {{"liver", {1}}}};
  recipe.obstacles = {{"rib", {2}}, {"rib-1", {3}}, {"spine", {8}}};
  recipe.targets = {{"lesion", {9}}};
  const offline::Built built =
      offline::build_labels("ring", map, recipe, {}, [](const char*, double) {});
  std::set<std::string> names;
  for (const offline::NamedHull& each : built.obstacles) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_EQ(each.name == "rib-1", each.obstacle == "rib-1");
  }
  EXPECT_TRUE(names.contains("rib-1") && names.contains("rib-2") && names.contains("rib-3"));
  EXPECT_TRUE(built.targets.empty());
  for (const char* missing : {"spine", "lesion"}) {
    EXPECT_EQ(warning_of(built.report.warnings, std::string("none of the labels of ") + missing),
              std::string("none of the labels of ") + missing + " is in the map");
  }
  EXPECT_THAT(offline::scene_toml("a.organ", {}, built.targets),
              testing::Not(testing::HasSubstr("point_mm")));
}

}  // namespace
}  // namespace stylet::test
