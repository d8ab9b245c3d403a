// SPDX-License-Identifier: Apache-2.0
// Volumes that are off by more than 5 % are reported: random layers, labels and meshes, against
// volumes in closed form or counted voxels, and against the voxels and planes of the file.
#include "voxels/losses.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numeric>

#include "base/refusal.h"
#include "meshes/phantom.h"
#include "offline_support.h"
#include "pipeline/label_organ.h"
#include "random_bodies.h"
#include "voxels/crop.h"

namespace stylet::test {
namespace {

using offline::Mesh;
using offline::Vec;

// ---- from outside -------------------------------------------------------------------------------

// The fraction of the unit cube where n . place <= limit: exact along the axis to which the plane's
// normal is closest, by midpoints across it.
double integrated_before(std::array<double, 3> n, double limit, int across = 24) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) axis = std::abs(n[i]) > std::abs(n[axis]) ? i : axis;
  if (n[axis] == 0) return limit >= 0 ? 1 : 0;
  double sum = 0;
  for (int i = 0; i < across * across; ++i) {
    const double u = (i % across + 0.5) / across, v = (i / across + 0.5) / across;
    const double at = (limit - n[(axis + 1) % 3] * u - n[(axis + 2) % 3] * v) / n[axis];
    const double below = std::clamp(at, 0.0, 1.0);
    sum += n[axis] > 0 ? below : 1 - below;
  }
  return sum / (across * across);
}

// For a material in an organ file: the volume in which a needle meets it, and that of its voxels.
offline::Held held_in(const Organ& organ, const std::string& name) {
  std::vector<const OrganMixed*> plane(organ.voxel_count, nullptr);
  for (const OrganMixed& each : organ.mixed) plane[each.voxel] = &each;
  const auto is = [&](std::uint32_t material) {
    return material != kNoTissue && organ_material(organ, material).name == name;
  };
  offline::Held cells;
  for (std::uint32_t voxel = 0; voxel < organ.voxel_count; ++voxel) {
    const bool own = is(organ.voxel_material[voxel]);
    const double filled = own ? organ.voxel_fill[voxel] / 255.0 : 0;
    cells.voxel_m3 += filled;
    const OrganMixed* mixed = plane[voxel];
    if (mixed == nullptr) {
      cells.met_m3 += filled;
    } else if (own || is(mixed->material)) {
      const auto exact = [](float value) { return static_cast<double>(value); };
      const double before = integrated_before(
          {exact(mixed->nx), exact(mixed->ny), exact(mixed->nz)}, exact(mixed->limit));
      cells.met_m3 += own ? before : 1 - before;
    }
  }
  const double edge = static_cast<double>(organ.voxel_edge_m);
  return {cells.met_m3 * edge * edge * edge, cells.voxel_m3 * edge * edge * edge};
}

struct Counts {
  int told = 0, silent = 0;
};

// Every volume that is off by more than 5 % has a warning, and none that is off by at most 1 % has
// one.
void expect_told(const offline::Built& built, const std::string& what, const std::string& material,
                 double given_m3, unsigned seed, Counts& counts) {
  const offline::Held held = held_in(opened(built.bytes), material);
  const double off =
      std::max(std::abs(held.met_m3 / given_m3 - 1), std::abs(held.voxel_m3 / given_m3 - 1));
  const std::vector<std::string>& warnings = built.report.warnings;
  const bool told = std::any_of(warnings.begin(), warnings.end(), [&](const std::string& each) {
    return each.starts_with(what + " " + material + ": ");
  });
  if (off > 0.05) {
    EXPECT_TRUE(told) << "seed " << seed << ", " << material << ": " << off;
  }
  if (off < 0.01) {
    EXPECT_FALSE(told) << "seed " << seed << ", " << material << ": " << off;
  }
  ++(told ? counts.told : counts.silent);
}

TEST(Losses, AreMeasuredExactly) {
  Draw draw(1);
  for (int i = 0; i < 400; ++i) {
    Vec n = draw.direction();
    if (i % 4 == 0) n.x = 0;
    if (i % 8 == 0) n.y = i % 16 == 0 ? 0 : 1e-7;
    const double limit = draw.between(-1.2, 1.2);
    EXPECT_NEAR(offline::volume_before(n, limit), integrated_before({n.x, n.y, n.z}, limit, 200),
                2e-4)
        << n.x << " " << n.y << " " << n.z << " " << limit;
  }
  EXPECT_EQ(offline::volume_before({0, 0, 0}, 1), 1);
  EXPECT_EQ(offline::volume_before({0, 0, 0}, -1), 0);
}

// ---- layers -------------------------------------------------------------------------------------

// A sloped block whose footprint lies in any direction: along z it is equally deep everywhere.
Mesh sloping_block(Vec size_mm, double turn, double slope_x, double slope_y) {
  Mesh mesh = box_mesh({0, 0, -size_mm.z}, {size_mm.x, size_mm.y, 0});
  for (Vec& p : mesh.points) {
    const double x = std::cos(turn) * p.x - std::sin(turn) * p.y;
    const double y = std::sin(turn) * p.x + std::cos(turn) * p.y;
    p = {x, y, p.z + slope_x * x + slope_y * y};
  }
  return mesh;
}

offline::BuildOptions layered(double fat_mm, double fascia_mm, double voxel_mm) {
  offline::BuildOptions options;
  options.voxel_edge_m = voxel_mm * 1e-3;
  options.layers = {{fat_mm * 1e-3, "fat"}, {fascia_mm * 1e-3, "fascia"}, {1, "gel"}};
  options.layer_course = {2, true, ""};
  return options;
}

TEST(Losses, HalfAMillimetreOfFasciaIsMissedByName) {
  const auto built = build_quietly({input_of(box_mesh({0, 0, 0}, {40, 36, 30}), 1e-3, "gel")},
                                   layered(4, 0.5, 3.3));
  // 40 x 36 x 0.5 mm.
  EXPECT_THAT(built.report.warnings,
              testing::Contains(testing::AllOf(
                  testing::StartsWith("layer fascia: at a voxel edge of 3.3 mm, of the 0.72"),
                  testing::HasSubstr("voxels hold 0 ml (-100 %)"))));
}

TEST(Losses, OfLayersAreReported) {
  Counts counts;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Draw draw(seed);
    const Vec size_mm = {draw.between(30, 50), draw.between(30, 50), 30};
    const Mesh block = sloping_block(size_mm, draw.between(0, 3), draw.between(-0.4, 0.4),
                                     draw.between(-0.4, 0.4));
    const double fat_mm = draw.between(3, 8), fascia_mm = draw.between(0.4, 6);
    const auto built = build_quietly({input_of(block, 1e-3, "gel")},
                                     layered(fat_mm, fascia_mm, draw.between(1, 4)));
    const double area_m2 = size_mm.x * size_mm.y * 1e-6;
    expect_told(built, "layer", "fat", area_m2 * fat_mm * 1e-3, seed, counts);
    expect_told(built, "layer", "fascia", area_m2 * fascia_mm * 1e-3, seed, counts);
  }
  EXPECT_GT(counts.told, 10);
  EXPECT_GT(counts.silent, 2);
}

// Percentage by which layers are thinner across the surface, as reported to the user; 0 if nothing
// is reported.
double told_thinner(const offline::Built& built, const std::string& along = "-z") {
  for (const std::string& each : built.report.warnings) {
    const std::size_t at = each.find("layers are ");
    if (!each.starts_with("--layers-along " + along + ": ") || at == std::string::npos) continue;
    return std::stod(each.substr(at + std::string("layers are ").size()));
  }
  return 0;
}

// A plane z = x sx + y sy meets rows along z at an angle of cosine 1 / sqrt(1 + sx^2 + sy^2); then
// z is replaced by any axis, in either direction.
TEST(Losses, LayersUnderASlopeAreReportedAsThinnerAcrossIt) {
  int told = 0, silent = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Draw draw(seed);
    const double steep = draw.coin() ? 0.6 : 0.1;
    const double slope_x = draw.between(-steep, steep), slope_y = draw.between(-steep, steep);
    Mesh block = sloping_block({draw.between(30, 50), draw.between(30, 50), 30}, draw.between(0, 3),
                               slope_x, slope_y);
    const std::size_t axis = draw.below(3);
    const bool backwards = draw.coin();
    for (Vec& p : block.points) {
      const double height = backwards ? p.z : -p.z;
      p = axis == 0   ? Vec{height, p.x, p.y}
          : axis == 1 ? Vec{p.y, height, p.x}
                      : Vec{p.x, p.y, height};
    }
    offline::BuildOptions options = layered(4, 5, 2);
    options.layer_course = {axis, backwards, ""};
    const auto built = build_quietly({input_of(block, 1e-3, "gel")}, options);
    const double thinner = 1 - 1 / std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
    const double said =
        told_thinner(built, fmt::format("{}{}", backwards ? '-' : '+', std::string("xyz")[axis]));
    if (thinner > 0.05) {
      EXPECT_NEAR(said, 100 * thinner, 0.51) << seed;
    }
    if (thinner < 0.01) {
      EXPECT_EQ(said, 0) << seed;
    }
    told += thinner > 0.05 ? 1 : 0;
    silent += thinner < 0.01 ? 1 : 0;
  }
  EXPECT_GT(told, 10);
  EXPECT_GT(silent, 2);
}

// Over the rows that enter a ball, r^2 = 1 - cosine^2 is distributed evenly: the mean cosine is
// 2/3.
TEST(Losses, LayersOfABallAreAThirdThinnerAcrossIt) {
  const auto built =
      build_quietly({input_of(offline::ball_phantom(60, 1.5), 1e-3, "gel")}, layered(2, 2, 3));
  EXPECT_NEAR(told_thinner(built), 100.0 / 3, 0.75);
}

// Sides along the rows are no slope, not even for a plate that is all surface; neither is there a
// slope where a cut body has no surface.
TEST(Losses, SidesAndCutsAreNoSlopes) {
  const auto plate =
      build_quietly({input_of(box_mesh({0, 0, 0}, {40, 40, 3}), 1e-3, "gel")}, layered(1, 1, 2));
  EXPECT_EQ(told_thinner(plate), 0);
  offline::BuildOptions options = layered(4, 5, 2);
  options.crop = offline::parse_crop({"x>10", "x<30", "y>10", "y<30", "z>10", "z<30"});
  const auto inner =
      build_quietly({input_of(box_mesh({0, 0, 0}, {40, 40, 40}), 1e-3, "gel")}, options);
  EXPECT_EQ(told_thinner(inner), 0);
}

// Each side of a roof with two different slopes counts with the rows that enter it.
TEST(Losses, EachSlopeCountsWithTheRowsThatEnterIt) {
  const double along_mm = 40, left_mm = 30, right_mm = 15, high_mm = 12;
  const Mesh roof = {
      {{-left_mm, 0, 0},
       {right_mm, 0, 0},
       {0, 0, high_mm},
       {-left_mm, along_mm, 0},
       {right_mm, along_mm, 0},
       {0, along_mm, high_mm}},
      {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}}};
  const auto built = build_quietly({input_of(roof, 1e-3, "gel")}, layered(2, 2, 1));
  const auto cosine = [&](double wide_mm) { return wide_mm / std::hypot(wide_mm, high_mm); };
  const double mean =
      (left_mm * cosine(left_mm) + right_mm * cosine(right_mm)) / (left_mm + right_mm);
  EXPECT_NEAR(told_thinner(built), 100 * (1 - mean), 0.51);
}

// Layers begin where rows enter the tissue that they replace: at the flat top of two bodies of it,
// whatever lies between these; under a body that they do not replace, at the slope below it.
TEST(Losses, OnlyTheSurfaceWhereLayersBeginCounts) {
  const double slope = 0.5;
  const Mesh below = sloping_block({40, 40, 30}, 0, slope, 0);
  Mesh above = box_mesh({0, 0, 0}, {40, 40, 40});
  for (Vec& p : above.points) p.z = p.z > 0 ? p.z : slope * p.x;
  for (const bool both : {true, false}) {
    offline::BuildOptions options = layered(4, 5, 2);
    options.layer_course.of = "gel";
    const auto built = build_quietly(
        {input_of(below, 1e-3, "gel"), input_of(above, 1e-3, both ? "gel" : "fat")}, options);
    EXPECT_NEAR(told_thinner(built), both ? 0 : 100 * (1 - 1 / std::hypot(1, slope)), 0.51);
  }
}

// A wall of cells along any axis, the first of them filled in only some of its rows, next to cells
// of another tissue. Counted by hand: a layer of t edges takes t of each of the 64 rows, and the
// tissue below it takes the rest of the rows.
TEST(Losses, VolumesOfLayersAreCountedInEveryRow) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Draw draw(seed);
    const std::size_t axis = draw.below(3), across = (axis + 1) % 3;
    const std::uint32_t deep = 3;
    offline::Grid grid{{0, 0, 0}, draw.between(1, 5) * 1e-3, {1, 1, 1}};
    grid.size[axis] = deep;
    grid.size[across] = 2;
    offline::SamplePlaces places;
    for (std::size_t s = 0; s < 64; ++s) {
      const auto at = [&](std::size_t i) {
        return (0.5 + static_cast<double>(i % 4) + draw.between(-0.1, 0.1)) / 4;
      };
      places[s] = {at(s), at(s / 4), at(s / 16)};
    }
    draw.shuffle(places);
    const bool backwards = draw.coin(), low_side = draw.coin();
    const auto quarters = static_cast<double>(1 + draw.below(3));
    const auto index = [&](std::uint32_t step, std::uint32_t beside) {
      std::array<std::uint32_t, 3> at{};
      at[axis] = backwards ? deep - 1 - step : step;
      at[across] = beside;
      return offline::cell_index(grid, at[0], at[1], at[2]);
    };
    offline::Claims claims = offline::no_claims(grid);
    double others = 0;
    for (std::uint32_t step = 0; step < deep; ++step) {
      for (std::size_t s = 0; s < 64; ++s) {
        const bool filled = step > 0 || (places[s][across] < quarters / 4) == low_side;
        claims.inside[index(step, 0)] |= std::uint64_t{filled} << s;
        const bool other = draw.coin();
        claims.inside[index(step, 1)] |= std::uint64_t{other} << s;
        others += other ? 1 : 0;
      }
      claims.owner[index(step, 1)] = 1;
    }
    const double layer = draw.between(0.1, deep - 1.1), wall_m3 = draw.between(1, 2) * 1e-9;
    const double filled = low_side ? 16 * quarters : 64 - 16 * quarters;
    const offline::TissueNumbers numbers = {
        {0, 4}, {1, 0}, {{layer * grid.edge_m, 2}, {1, 3}}, {axis, backwards, ""}};
    const auto given_m3 = offline::given_volumes(claims, places, numbers, {}, {wall_m3, 3e-9});
    EXPECT_NEAR(given_m3[2] / wall_m3, 64 * layer, 1e-9) << seed;
    EXPECT_NEAR(given_m3[3] / wall_m3, 64 * (deep - 1 - layer) + filled, 1e-9) << seed;
    EXPECT_NEAR(given_m3[4] / 3e-9, others, 1e-9) << seed;
    EXPECT_EQ(std::accumulate(given_m3.begin(), given_m3.end(), 0.0),
              given_m3[2] + given_m3[3] + given_m3[4]);
  }
}

// ---- labels -------------------------------------------------------------------------------------

offline::LabelMap random_map(Draw& draw) {
  offline::LabelMap map;
  map.size = {60, 56, 40};
  const std::array<Vec, 3> frame = random_frame(draw);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    map.step_m[axis] = frame[axis] * (draw.between(0.7, 2.5) * 1e-3);
  }
  map.sha256 = std::string(64, '0');
  map.label.assign(60 * 56 * 40, 0);
  for (std::uint16_t label = 1; label <= 3; ++label) {
    const Vec middle = {draw.between(20, 40), draw.between(20, 36), draw.between(14, 26)};
    const double share = label == 1 ? 1 : 0.3;
    const Vec half = Vec{draw.between(5, 20), draw.between(5, 18), draw.between(3, 13)} * share;
    for (int i = 0; i < 60 * 56 * 40; ++i) {
      const Vec at = Vec{1.0 * (i % 60), 1.0 * (i / 60 % 56), 1.0 * (i / 3360)} - middle;
      const Vec part = {at.x / half.x, at.y / half.y, at.z / half.z};
      if (dot(part, part) <= 1) map.label[static_cast<std::size_t>(i)] = label;
    }
  }
  return map;
}

TEST(Losses, OfLabelsAreReported) {
  Counts counts;
  const std::array<std::string, 3> tissues = {"liver", "kidney", "gel"};
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Draw draw(seed);
    const offline::LabelMap map = random_map(draw);
    offline::Recipe recipe = {{}, {{"liver", {1}}, {"kidney", {2}}, {"gel", {3}}}};
    offline::BuildOptions options;
    options.voxel_edge_m = draw.between(1, 4) * 1e-3;
    const auto built =
        offline::build_labels("map", map, recipe, options, [](const char*, double) {});
    const double voxel_m3 = std::abs(dot(map.step_m[0], cross(map.step_m[1], map.step_m[2])));
    for (std::uint16_t label = 1; label <= 3; ++label) {
      const auto count = std::count(map.label.begin(), map.label.end(), label);
      if (count == 0) continue;  // the next body covers it
      const offline::Held held = held_in(opened(built.bytes), tissues[label - 1U]);
      const bool lost = held.met_m3 == 0;
      expect_told(built, lost ? "labels of" : "tissue", tissues[label - 1U],
                  static_cast<double>(count) * voxel_m3, seed, counts);
    }
  }
  EXPECT_GT(counts.told, 10);
  EXPECT_GT(counts.silent, 10);
}

// Fat and skin of a wall around labels; the skin falls between the map's voxels.
TEST(Losses, AWallTooThinForTheMapIsReported) {
  Draw draw(7);
  offline::LabelMap map = random_map(draw);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    map.step_m[axis] = map.step_m[axis] * (2e-3 / length(map.step_m[axis]));
  }
  offline::Recipe recipe = {{}, {{"gel", {1, 2, 3}}}};
  recipe.wall = {{"fat", 5e-3}, {"skin", 0.01e-3}};
  const auto built = offline::build_labels("map", map, recipe, {}, [](const char*, double) {});
  EXPECT_THAT(built.report.warnings,
              testing::Contains(testing::StartsWith("layer skin: its 0.01 mm fall between")));
}

// ---- meshes -------------------------------------------------------------------------------------

TEST(Losses, OfNestedMeshesAreReported) {
  Counts counts;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Draw draw(seed);
    const Vec outer = {draw.between(20, 50), draw.between(20, 50), draw.between(20, 50)};
    const Vec inner = {draw.between(2, 15), draw.between(2, 15), draw.between(2, 15)};
    const auto frame = random_frame(draw), inner_frame = random_frame(draw);
    const Mesh body = turned(box_mesh(outer * -0.5, outer * 0.5), frame);
    const Mesh lesion = turned(box_mesh(inner * -0.25, inner * 0.25), inner_frame);
    offline::BuildOptions options;
    options.voxel_edge_m = draw.between(1, 4) * 1e-3;
    offline::Built built;
    try {
      built = build_quietly({input_of(body, 1e-3), input_of(lesion, 1e-3, "kidney", 1)}, options);
    } catch (const offline::Refusal&) {
      continue;  // between all samples
    }
    const double lesion_m3 = inner.x * inner.y * inner.z * 0.125e-9;
    const double body_m3 = outer.x * outer.y * outer.z * 1e-9 - lesion_m3;
    const bool sampled_badly = std::any_of(
        built.report.warnings.begin(), built.report.warnings.end(),
        [](const std::string& each) { return each.find("its surface encloses") < each.size(); });
    expect_told(built, "tissue", "liver", body_m3, seed, counts);
    if (!sampled_badly) expect_told(built, "tissue", "kidney", lesion_m3, seed, counts);
  }
  EXPECT_GT(counts.told, 10);
  EXPECT_GT(counts.silent, 10);
}

// Tissue that the user cuts away is not lost.
TEST(Losses, ACropIsNoLoss) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Draw draw(seed);
    const Mesh body = turned(box_mesh({0, 0, 0}, {50, 40, 60}), random_frame(draw));
    offline::BuildOptions options;
    options.voxel_edge_m = draw.between(2, 3) * 1e-3;
    options.crop = offline::parse_crop({fmt::format("x>{:.0f}%", draw.between(20, 60)),
                                        fmt::format("z<{:.0f}%", draw.between(40, 80))});
    EXPECT_THAT(build_quietly({input_of(body, 1e-3)}, options).report.warnings, testing::IsEmpty());
  }
}

}  // namespace
}  // namespace stylet::test
