// SPDX-License-Identifier: Apache-2.0
// Walls around label maps where the scan cuts the patient off, and other options together with a
// wall. Boxes are random; expected voxels are counted.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "base/refusal.h"
#include "maps/wall.h"
#include "maps/wall_thickness.h"
#include "offline_support.h"
#include "organ_places.h"
#include "pipeline/label_organ.h"
#include "random_bodies.h"

namespace stylet::test {
namespace {

using offline::LabelMap;
using offline::Recipe;
using offline::Vec;

constexpr double kStepM = 1e-3;

LabelMap empty_map(std::array<std::uint32_t, 3> size) {
  LabelMap map;
  map.size = size;
  map.step_m = {Vec{kStepM, 0, 0}, {0, kStepM, 0}, {0, 0, kStepM}};
  map.label.assign(std::size_t{size[0]} * size[1] * size[2], 0);
  return map;
}

template <typename Inside>
void fill(LabelMap& map, std::uint16_t label, Inside inside) {
  std::size_t i = 0;
  for (std::uint32_t z = 0; z < map.size[2]; ++z) {
    for (std::uint32_t y = 0; y < map.size[1]; ++y) {
      for (std::uint32_t x = 0; x < map.size[0]; ++x, ++i) {
        if (inside(std::array{x, y, z})) map.label[i] = label;
      }
    }
  }
}

offline::Built build_quietly(const LabelMap& map, const Recipe& recipe,
                             const offline::BuildOptions& options) {
  return offline::build_labels("map.nrrd", map, recipe, options, [](const char*, double) {});
}

// A box reaches some sides of its map. The map grows only at the other sides; there a wall of whole
// voxels covers the faces, and there is none where the box is cut.
TEST(Wall, EndsWhereTheScanDoes) {
  Draw draw(4);
  for (int round = 0; round < 20; ++round) {
    std::array<std::uint32_t, 3> size{}, low{}, high{};
    std::array<std::array<bool, 2>, 3> cut{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      size[axis] = 20 + static_cast<std::uint32_t>(draw.below(6));
      cut[axis] = {draw.coin(), draw.coin()};
      low[axis] = cut[axis][0] ? 0 : 3;
      high[axis] = size[axis] - (cut[axis][1] ? 0 : 4);
    }
    LabelMap map = empty_map(size);
    fill(map, 7, [&](const auto& at) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (at[axis] < low[axis] || at[axis] >= high[axis]) return false;
      }
      return true;
    });
    constexpr std::uint32_t kThick = 4;
    Recipe recipe = {{}, {{"gel", {7}}, {"fat", {9}}}};
    recipe.wall = {{"fat", kThick * kStepM}};
    const LabelMap before = map;
    offline::add_wall(map, recipe);
    ASSERT_EQ(recipe.groups.size(), 2U) << "fat is there already";
    ASSERT_EQ(recipe.groups[1].labels.size(), 2U);
    const std::uint16_t wall = recipe.groups[1].labels[1];
    EXPECT_NE(wall, 7);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double moved = before.origin_m[axis] - map.origin_m[axis];
      EXPECT_EQ(moved > 0, !cut[axis][0]) << axis;
      // From the middle of a face straight outward, in both directions.
      for (const bool up : {false, true}) {
        std::array<std::int64_t, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) {
          at[i] =
              (low[i] + high[i]) / 2 + std::lround((before.origin_m[i] - map.origin_m[i]) * 1e3);
        }
        std::size_t layers = 0;
        for (at[axis] += 0; at[axis] >= 0 && at[axis] < std::int64_t{map.size[axis]};
             at[axis] += up ? 1 : -1) {
          const auto index =
              static_cast<std::size_t>((at[2] * map.size[1] + at[1]) * map.size[0] + at[0]);
          layers += map.label[index] == wall ? 1 : 0;
        }
        EXPECT_EQ(layers, cut[axis][up ? 1 : 0] ? 0 : kThick) << axis << up;
      }
    }
  }
}

TEST(Wall, NeedsALabelThatIsFree) {
  LabelMap map = empty_map({65535, 1, 1});
  std::iota(map.label.begin(), map.label.end(), std::uint16_t{1});
  Recipe recipe = {{}, {{"gel", {1}}}};
  recipe.wall = {{"fat", 1e-3}};
  try {
    offline::add_wall(map, recipe);
    ADD_FAILURE() << "accepted";
  } catch (const offline::Refusal& refused) {
    EXPECT_THAT(refused.what(), testing::HasSubstr("uses every label from 1 to 65535"));
  }
}

LabelMap ball() {
  LabelMap map = empty_map({48, 48, 48});
  fill(map, 5, [](const auto& at) {
    const Vec from = {at[0] - 23.3, at[1] - 23.6, at[2] - 23.9};
    return length(from) < 16;
  });
  return map;
}

Recipe walled() {
  Recipe recipe = {{}, {{"gel", {5}}}};
  recipe.wall = {{"fat", 6e-3}};
  return recipe;
}

// The capsule of an organ inside a wall lies where the wall begins, as if the organ were bare.
TEST(Wall, BeginsAtTheCapsule) {
  offline::BuildOptions options;
  options.voxel_edge_m = 3e-3;
  options.capsule = "liver_capsule";
  options.capsule_of = "gel";
  options.wall = {"fat"};
  const auto bytes = build_quietly(ball(), walled(), options).bytes;
  const Organ organ = opened(bytes);
  const std::vector<VoxelPlace> cells = cells_of(organ);
  std::map<std::array<std::uint32_t, 3>, std::string> material;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    material[{cells[i].x, cells[i].y, cells[i].z}] =
        organ_material(organ, organ.voxel_material[i]).name;
  }
  std::size_t capsules = 0;
  for (const auto& [at, name] : material) {
    if (name == "fat") continue;
    bool beside_fat = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::uint32_t step : {1U, ~0U}) {
        std::array<std::uint32_t, 3> next = at;
        next[axis] += step;
        const auto found = material.find(next);
        beside_fat = beside_fat || (found != material.end() && found->second == "fat");
      }
    }
    EXPECT_EQ(name, beside_fat ? "liver_capsule" : "gel");
    capsules += beside_fat ? 1 : 0;
  }
  EXPECT_GT(capsules, 200U);
}

// The organ is cut to a box; the wall stays where the box leaves it.
TEST(Wall, IsCroppedAsTheMapIs) {
  Recipe recipe = walled();
  recipe.crop_around = {5};
  recipe.crop_margin_m = 2e-3;
  const offline::Built built = build_quietly(ball(), recipe, {});
  // The ball is 32 voxels wide, with 2 voxels of space on either side; the wall itself is 6 voxels
  // thick.
  constexpr double kAcrossM = 36e-3;
  const Organ organ = opened(built.bytes);
  const auto edge_m = static_cast<double>(organ.voxel_edge_m);
  for (const std::uint32_t size : {organ.size_x, organ.size_y, organ.size_z}) {
    EXPECT_NEAR(size * edge_m, kAcrossM, edge_m);
  }
  const LabelMap map = ball();
  EXPECT_EQ(built.report.labels[0].voxels,
            static_cast<std::size_t>(std::count(map.label.begin(), map.label.end(), 5)));
  EXPECT_GT(built.report.labels[1].voxels, 1000U);
}

// An organ has as many voxels as asked for, and gaps that were to be split stay open; both are
// measured.
TEST(LabelOrgan, IsAsFineAsAllowedAndSplitWhereAskedFor) {
  offline::BuildOptions options;
  options.most_voxels = 4000;
  options.measured = true;
  const offline::Built fine = build_quietly(ball(), {{}, {{"gel", {5}}}}, options);
  const auto swept = opened(fine.bytes).voxel_count;
  EXPECT_LE(swept, 4000U);
  EXPECT_GT(swept, 1500U);
  LabelMap two = empty_map({40, 20, 20});
  fill(two, 1, [](const auto& at) { return at[0] > 2 && at[0] < 19 && at[1] > 2 && at[1] < 17; });
  fill(two, 2, [](const auto& at) { return at[0] > 19 && at[0] < 37 && at[1] > 2 && at[1] < 17; });
  options.most_voxels = 0;
  options.voxel_edge_m = 4.3e-3;
  const Recipe halves = {{}, {{"gel", {1}}, {"liver", {2}}}};
  EXPECT_GT(build_quietly(two, halves, options).report.closed_gaps, 0U);
  options.split = true;
  EXPECT_EQ(build_quietly(two, halves, options).report.closed_gaps, 0U);
}

TEST(LabelOrgan, HasAtMostAsManyTissuesAsABytesNumbers) {
  Recipe recipe;
  for (std::uint16_t i = 1; i <= 256; ++i) recipe.groups.push_back({"gel", {i}});
  try {
    (void)build_quietly(ball(), recipe, {});
    ADD_FAILURE() << "accepted";
  } catch (const offline::Refusal& refused) {
    EXPECT_STREQ(refused.what(), "256 tissues: expected at most 255");
  }
}

// ---- how thick layers become --------------------------------------------------------------------

// A convex body, and the volume of all that is nearer to it than a distance (Steiner).
struct Convex {
  std::function<double(Vec)> distance;  // 0 and less inside
  std::function<double(double)> volume_within;
  double reach = 0;
};

Convex random_convex(Draw& draw, std::size_t kind) {
  using std::numbers::pi;
  const std::array<Vec, 3> frame = random_frame(draw);
  const double r = draw.between(12, 20), l = kind == 1 ? draw.between(5, 20) : 0;
  if (kind < 2) {  // a ball, a rod with round ends
    return {[=](Vec at) {
              const double along = std::clamp(dot(at, frame[0]), -l / 2, l / 2);
              return length(at - frame[0] * along) - r;
            },
            [=](double t) {
              const double all = r + t;
              return pi * all * all * l + 4 * pi / 3 * all * all * all;
            },
            r + l / 2};
  }
  // A box with round edges, which voxels can represent.
  const Vec half = {draw.between(5, 14), draw.between(5, 14), draw.between(5, 14)};
  const double edge = draw.between(5, 8);
  return {[=](Vec at) {
            double squared = 0;
            for (std::size_t i = 0; i < 3; ++i) {
              const double out = std::max(0.0, std::abs(dot(at, frame[i])) - half[i]);
              squared += out * out;
            }
            return std::sqrt(squared) - edge;
          },
          [=](double beyond) {
            const double t = edge + beyond;
            const double a = 2 * half.x, b = 2 * half.y, c = 2 * half.z;
            return a * b * c + 2 * (a * b + b * c + c * a) * t + pi * (a + b + c) * t * t +
                   4 * pi / 3 * t * t * t;
          },
          length(half) + edge};
}

LabelMap drawn(Draw& draw, const std::function<double(Vec)>& distance_mm, double reach_mm,
               Vec step_mm) {
  LabelMap map;
  const std::array<Vec, 3> frame = random_frame(draw);
  Vec corner;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    map.size[axis] = static_cast<std::uint32_t>(2 * reach_mm / step_mm[axis]) + 4;
    map.step_m[axis] = frame[axis] * (step_mm[axis] * 1e-3);
    corner = corner - map.step_m[axis] * (map.size[axis] / 2.0 + draw.between(-0.5, 0.5));
  }
  map.origin_m = corner;
  map.label.assign(std::size_t{map.size[0]} * map.size[1] * map.size[2], 0);
  fill(map, 5, [&](const auto& at) {
    const Vec place_m =
        map.origin_m + map.step_m[0] * at[0] + map.step_m[1] * at[1] + map.step_m[2] * at[2];
    return distance_mm(place_m * 1e3) <= 0;
  });
  return map;
}

// In a map a body is a little larger or smaller than in truth: the wall lies around the body in the
// map.
double drawn_larger_mm(const LabelMap& map, const Convex& body) {
  const auto voxels = std::count(map.label.begin(), map.label.end(), 5);
  const double drawn_mm3 = static_cast<double>(voxels) * offline::voxel_volume_m3(map) * 1e9;
  double low = -2, high = 2;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (body.volume_within(middle) < drawn_mm3 ? low : high) = middle;
  }
  return low;
}

// Every layer whose volume differs by more than 5 % from the closed form has a warning, and none
// that differs by at most half a percent has one.
TEST(Wall, LayersThatVoxelsMakeThinnerOrThickerAreReported) {
  int told_count = 0, silent = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Draw draw(seed);
    const Convex body = random_convex(draw, seed % 3);
    const double in_plane_mm = draw.between(0.7, 1.4);
    LabelMap map =
        drawn(draw, body.distance, body.reach, {in_plane_mm, in_plane_mm, draw.between(0.7, 3)});
    Recipe recipe = {{}, {{"gel", {5}}}};
    recipe.wall = {{"muscle", draw.between(2, 9) * 1e-3},
                   {"fat", draw.between(2, 9) * 1e-3},
                   {"skin", draw.between(1.2, 5) * 1e-3}};
    const std::vector<std::string> warnings = offline::add_wall(map, recipe);
    double below = drawn_larger_mm(map, body);
    for (std::size_t i = 0; i < recipe.wall.size(); ++i) {
      const std::string& tissue = recipe.wall[i].tissue;
      const double above = below + recipe.wall[i].thickness_m * 1e3;
      const auto voxels =
          std::count(map.label.begin(), map.label.end(), recipe.groups[i + 1].labels[0]);
      const double drawn_mm3 = static_cast<double>(voxels) * offline::voxel_volume_m3(map) * 1e9;
      const double off = drawn_mm3 / (body.volume_within(above) - body.volume_within(below)) - 1;
      const bool told = std::any_of(warnings.begin(), warnings.end(), [&](const auto& each) {
        return each.starts_with("layer " + tissue + ": ");
      });
      if (std::abs(off) > 0.05) {
        EXPECT_TRUE(told) << "seed " << seed << ", " << tissue << ": " << off;
      }
      if (std::abs(off) < 0.005) {
        EXPECT_FALSE(told) << "seed " << seed << ", " << tissue << ": " << off;
      }
      ++(told ? told_count : silent);
      below = above;
    }
  }
  EXPECT_GT(told_count, 20);
  EXPECT_GT(silent, 20);
}

// The innermost layer fills a gap between two bodies, which makes it neither thinner nor thicker.
TEST(Wall, AGapThatTheInnermostLayerFillsDoesNotCountAsThickness) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    Draw draw(seed);
    const Vec apart = draw.direction() * draw.between(17, 22);
    const auto two_balls = [&](Vec at) {
      return std::min(length(at - apart), length(at + apart)) - 16;
    };
    LabelMap map = drawn(draw, two_balls, 40, {0.5, 0.5, 0.5});
    Recipe recipe = {{}, {{"gel", {5}}}};
    recipe.wall = {{"muscle", 9.2e-3}, {"skin", 4.8e-3}};
    EXPECT_THAT(offline::add_wall(map, recipe), testing::IsEmpty()) << seed;
  }
}

// A row of voxels along a random axis, with nothing beside it: label, two layers, outside.
TEST(Wall, LayersOfARowAreAsThickAsTheirVoxels) {
  Draw draw(77);
  for (int n = 0; n < 30; ++n) {
    const std::size_t counts[] = {1 + draw.below(4), 1 + draw.below(5), 1 + draw.below(5),
                                  1 + draw.below(3)};
    const std::uint16_t labels[] = {5, 11, 12, 0};
    LabelMap map = empty_map({1, 1, 1});
    const std::size_t axis = draw.below(3);
    offline::WallDistances distances;
    distances.thickness_m = kStepM * static_cast<double>(counts[1] + counts[2]);
    map.label.clear();
    for (std::size_t part = 0; part < 4; ++part) {
      map.label.insert(map.label.end(), counts[part], labels[part]);
    }
    map.size[axis] = static_cast<std::uint32_t>(map.label.size());
    const int last_label = static_cast<int>(counts[0]) - 1;
    const int first_outside = static_cast<int>(counts[0] + counts[1] + counts[2]);
    for (int i = 0; i < static_cast<int>(map.label.size()); ++i) {
      distances.from_labels_m.push_back(static_cast<float>(kStepM * std::max(i - last_label, 0)));
      distances.from_outside_m.push_back(
          static_cast<float>(kStepM * std::max(first_outside - i, 0)));
    }
    const std::vector<double> thickness_m = offline::layer_thickness_m(map, distances, {11, 12});
    ASSERT_EQ(thickness_m.size(), 2U);
    EXPECT_NEAR(thickness_m[0], kStepM * static_cast<double>(counts[1]), 1e-9) << n;
    EXPECT_NEAR(thickness_m[1], kStepM * static_cast<double>(counts[2]), 1e-9) << n;
    // If no row enters, or there is no layer, area and thickness are zero.
    offline::WallDistances flat = distances;
    std::fill(flat.from_labels_m.begin(), flat.from_labels_m.end(), 0.0F);
    std::fill(flat.from_outside_m.begin(), flat.from_outside_m.end(), 0.0F);
    EXPECT_TRUE(std::isnan(offline::layer_thickness_m(map, flat, {11, 12})[0]));
    std::fill(map.label.begin(), map.label.end(), std::uint16_t{0});
    EXPECT_TRUE(std::isnan(offline::layer_thickness_m(map, distances, {11, 12})[1]));
  }
}

}  // namespace
}  // namespace stylet::test
