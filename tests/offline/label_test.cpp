// SPDX-License-Identifier: Apache-2.0
// Label maps: they lie where their headers say, other files are refused, and organs are made of
// them.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "base/refusal.h"
#include "maps/names.h"
#include "offline_support.h"
#include "pipeline/label_organ.h"

namespace stylet::test {
namespace {

using offline::LabelMap;
using offline::Recipe;
using offline::Vec;

offline::Built build_quietly(const LabelMap& map, const Recipe& recipe,
                             const offline::BuildOptions& options) {
  return offline::build_labels("map.nrrd", map, recipe, options, [](const char*, double) {});
}

std::string nrrd(const std::string& space, const std::string& directions, const std::string& voxels,
                 const std::string& type = "uchar") {
  return "NRRD0004\ntype: " + type + "\ndimension: 3\nspace: " + space +
         "\nsizes: 2 3 4\nspace directions: " + directions +
         "\nspace origin: (10,20,30)\nencoding: raw\nendian: little\n\n" + voxels;
}

void expect_near(Vec seen, Vec expected) {
  EXPECT_NEAR(seen.x, expected.x, 1e-9);
  EXPECT_NEAR(seen.y, expected.y, 1e-9);
  EXPECT_NEAR(seen.z, expected.z, 1e-9);
}

// ---- where a map lies ---------------------------------------------------------------------------

TEST(LabelMap, PermutedAndMirroredAxesAreThoseOfTheHeader) {
  const Scratch scratch;
  std::string voxels(24, '\0');
  voxels[1] = 7;
  const auto path = scratch.write(
      "a.nrrd", nrrd("left-posterior-superior", "(0,0.75,0) (0,0,-0.5) (2,0,0)", voxels));
  const LabelMap map = offline::read_label_map(path);
  EXPECT_EQ(map.size, (std::array<std::uint32_t, 3>{2, 3, 4}));
  EXPECT_EQ(map.label[1], 7);
  expect_near(map.origin_m, {0.010, 0.020, 0.030});
  expect_near(map.step_m[0], {0, 0.75e-3, 0});
  expect_near(map.step_m[1], {0, 0, -0.5e-3});
  expect_near(map.step_m[2], {2e-3, 0, 0});
  EXPECT_NEAR(offline::voxel_volume_m3(map), 0.75e-9, 1e-18);
}

TEST(LabelMap, RightAnteriorSuperiorBecomesLeftPosteriorSuperior) {
  const Scratch scratch;
  const auto path = scratch.write(
      "a.nrrd", nrrd("right-anterior-superior", "(1,0,0) (0,2,0) (0,0,3)", std::string(24, 1)));
  const LabelMap map = offline::read_label_map(path);
  expect_near(map.origin_m, {-0.010, -0.020, 0.030});
  expect_near(map.step_m[0], {-1e-3, 0, 0});
  expect_near(map.step_m[1], {0, -2e-3, 0});
  expect_near(map.step_m[2], {0, 0, 3e-3});
}

TEST(LabelMap, MetaImageWithARotation) {
  const Scratch scratch;
  const auto path = scratch.write(
      "a.mha",
      "ObjectType = Image\nNDims = 3\nTransformMatrix = 0.6 0.8 0 -0.8 0.6 0 0 0 1\n"
      "Offset = 1 2 3\nElementSpacing = 2 1 4\nDimSize = 2 2 2\nElementType = MET_SHORT\n"
      "BinaryData = True\nBinaryDataByteOrderMSB = False\nElementDataFile = LOCAL\n" +
          std::string("\1\0\2\0\3\0\0\0\0\0\0\0\0\0\1\1", 16));
  const LabelMap map = offline::read_label_map(path);
  expect_near(map.step_m[0], {1.2e-3, 1.6e-3, 0});
  expect_near(map.step_m[1], {-0.8e-3, 0.6e-3, 0});
  expect_near(map.step_m[2], {0, 0, 4e-3});
  EXPECT_THAT(map.label, testing::ElementsAre(1, 2, 3, 0, 0, 0, 0, 257));
}

// ---- real maps ----------------------------------------------------------------------------------

struct RealMap {
  const char* file;
  double voxel_mm3;
  std::map<int, std::size_t> some_labels;
};

// Expected counts and spacings are in the table beside the files.
const RealMap kRealMaps[] = {
    {"ts_example_seg.nii.gz", 27, {{5, 38634}, {13, 1}, {117, 2100}}},
    {"ts_example_seg_roi_subset.nii.gz", 27, {{5, 38631}}},
    {"ts_example_seg_fast_force_split.nii.gz", 27, {{5, 41692}, {20, 59968}}},
    {"dcmqi_liver_spine_seg.nrrd", 0.81055 * 0.81055, {{1, 107098}, {2, 12439}}},
    {"dcmqi_liver_seg.nrrd", 0.81055 * 0.81055, {{1, 107098}}},
    {"pyradiomics_brain1_label.nrrd", 0.78125 * 0.78125 * 6.5, {{1, 4137}}},
    {"pyradiomics_lung1_label.nrrd", 0.57031 * 0.57031 * 5, {{1, 837}}},
    {"spl_skin.nrrd", 0.75 * 0.75 * 0.75, {{3, 9234366}}},
    {"cgal_liver.inr.gz", 0.61719 * 0.61719 * 1.3333, {{85, 17702}, {127, 314086}, {255, 3160496}}},
    {"cgal_12323.inr", 1e6, {{1, 1}, {2, 2}, {3, 2}}}};

TEST(RealMaps, HaveTheirCountsAndKeepTheirVolumes) {
  for (const RealMap& real : kRealMaps) {
    const auto path = data_folder() / "labelmaps" / real.file;
    SKIP_WITHOUT(path);
    SCOPED_TRACE(real.file);
    const LabelMap map = offline::read_label_map(path);
    EXPECT_NEAR(offline::voxel_volume_m3(map) * 1e9, real.voxel_mm3, 1e-4 * real.voxel_mm3);
    std::map<int, std::size_t> counts;
    for (const offline::LabelCount& each : offline::count_labels(map))
      counts[each.label] = each.voxels;
    Recipe recipe;
    for (const auto& [label, voxels] : real.some_labels) {
      EXPECT_EQ(counts[label], voxels) << label;
      if (voxels < 800) continue;  // too few for a percent
      recipe.groups.push_back(
          {recipe.groups.empty() ? "liver" : "bone", {static_cast<std::uint16_t>(label)}});
    }
    if (recipe.groups.empty()) continue;
    offline::BuildOptions options;
    options.voxel_edge_m = counts.size() == 1 && counts.begin()->second < 5000 ? 2e-3 : 4e-3;
    const offline::Built built = build_quietly(map, recipe, options);
    for (const offline::LabelReport& each : built.report.labels) {
      EXPECT_NEAR(each.filled_volume_m3 / each.map_volume_m3, 1, 0.01) << each.tissue;
    }
    EXPECT_GT(opened(built.bytes).voxel_count, 0U);
  }
}

// Eight voxels of 100 mm, five of them labelled: few enough to count by hand.
TEST(RealMaps, CornerOfThreeMaterialsIsFiveCubes) {
  const auto path = data_folder() / "labelmaps" / "cgal_12323.inr";
  SKIP_WITHOUT(path);
  offline::BuildOptions options;
  options.voxel_edge_m = 25e-3;
  const Recipe recipe = {{}, {{"gel", {1}}, {"liver", {2}}, {"muscle", {3}}}};
  const offline::Built built = build_quietly(offline::read_label_map(path), recipe, options);
  const double litres[] = {1, 2, 2};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(built.report.labels[i].filled_volume_m3 * 1e3, litres[i], 0.01 * litres[i]);
  }
}

TEST(RealMaps, OtherFilesAreRefusedWithTheReason) {
  const std::pair<const char*, const char*> traps[] = {
      {"ts_example_ct_sm.nii.gz", "-1024: expected labels, which are whole numbers from 0"},
      {"sofa_tooth_closed.mhd", "expected labels, which are whole numbers from 0"},
      {"tooth_closed.raw", "expected a label map: .nrrd"}};
  for (const auto& [file, reason] : traps) {
    const auto path = data_folder() / "labelmaps" / file;
    SKIP_WITHOUT(path);
    const std::string said = refusal_of([&path = path] { (void)offline::read_label_map(path); });
    EXPECT_THAT(said, testing::HasSubstr(reason));
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST(RealMaps, CutShortAreRefusedInOneLine) {
  const Scratch scratch;
  for (const char* file :
       {"ts_example_seg.nii.gz", "dcmqi_liver_seg.nrrd", "cgal_12323.inr", "cgal_liver.inr.gz"}) {
    const auto path = data_folder() / "labelmaps" / file;
    SKIP_WITHOUT(path);
    const std::string whole = slurp(path);
    for (const std::size_t size : {std::size_t{0}, std::size_t{10}, std::size_t{300},
                                   whole.size() / 2, whole.size() * 9 / 10}) {
      if (size >= whole.size()) continue;
      const auto cut = scratch.write(file, whole.substr(0, size));
      const std::string said = refusal_of([&] { (void)offline::read_label_map(cut); });
      EXPECT_NE(said, "") << file << " " << size;
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
  }
}

TEST(LabelMap, CutShortWithoutCompressionIsRefusedToo) {
  const Scratch scratch;
  const std::string header =
      "ObjectType = Image\nNDims = 3\nDimSize = 2 3 4\nElementSpacing = 1 1 1\n"
      "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
  std::string nifti(352, '\0');
  const auto put = [&nifti](std::size_t at, const auto& value) {
    std::memcpy(nifti.data() + at, &value, sizeof value);
  };
  put(0, std::int32_t{348});
  put(40, std::array<std::int16_t, 4>{3, 2, 3, 4});
  put(70, std::array<std::int16_t, 2>{2, 8});
  put(76, std::array<float, 4>{1, 1, 1, 1});
  put(108, 352.0F);
  put(344, std::array<char, 4>{'n', '+', '1', '\0'});
  for (const std::size_t voxels : {23U, 24U}) {
    const std::string data(voxels, '\1');
    for (const auto& path :
         {scratch.write("a.mha", header + data), scratch.write("a.nii", nifti + data),
          scratch.write("a.nrrd",
                        nrrd("left-posterior-superior", "(1,0,0) (0,1,0) (0,0,1)", data))}) {
      const std::string said = refusal_of([&path] { (void)offline::read_label_map(path); });
      EXPECT_EQ(said.empty(), voxels == 24) << path << said;
    }
  }
}

TEST(LabelMap, FilesWithoutAVolumeOfLabelsAreRefused) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& name, const std::string& text) {
    const auto path = scratch.write(name, text);
    return refusal_of([&] { (void)offline::read_label_map(path); });
  };
  const std::string axes = "(1,0,0) (0,1,0) (0,0,1)";
  std::string many;
  for (int i = 0; i < 24; ++i) many += std::string("\0\0", 2);
  EXPECT_EQ(refusal("fine.nrrd", nrrd("left-posterior-superior", axes, many, "short")), "");
  many[6] = static_cast<char>(0xFF);
  many[7] = static_cast<char>(0xFF);
  EXPECT_THAT(refusal("a.nrrd", nrrd("left-posterior-superior", axes, many, "short")),
              testing::HasSubstr("voxel 3: -1: expected labels"));
  EXPECT_THAT(refusal("b.nrrd", nrrd("left-posterior-superior", "(1,0,0) (0,1,0) (0,1,0)",
                                     std::string(24, 1))),
              testing::HasSubstr("b.nrrd: "));
  EXPECT_THAT(refusal("huge.nrrd",
                      "NRRD0004\ntype: uchar\ndimension: 3\nspacings: 1 1 1\nsizes: 9999 9999 "
                      "9999\nencoding: "
                      "raw\n\nabc"),
              testing::HasSubstr("expected a smaller image"));
  EXPECT_THAT(refusal("flat.nrrd",
                      "NRRD0004\ntype: uchar\ndimension: 2\nsizes: 2 2\nencoding: raw\n\nabcd"),
              testing::HasSubstr("expected 3"));
  EXPECT_THAT(refusal("a.dcm", "x"), testing::HasSubstr("expected a whole DICOM file"));
  EXPECT_THAT(refusal("a.inr", "x"), testing::HasSubstr("expected the header of an Inrimage"));
  EXPECT_THAT(refusal("a.txt", "x"), testing::HasSubstr("expected a label map"));
  EXPECT_THAT(refusal_of([] { (void)offline::read_label_map("nowhere.nrrd"); }),
              testing::HasSubstr("no such file"));
}

TEST(LabelMap, ManyValuesAreGreyNotLabels) {
  const Scratch scratch;
  for (const unsigned different : {500U, 501U}) {
    std::string voxels;
    for (unsigned i = 0; i < 1000; ++i) {
      const unsigned value = i % different;
      voxels += static_cast<char>(value & 0xFFU);
      voxels += static_cast<char>(value >> 8U);
    }
    const auto path = scratch.write("a.nrrd",
                                    "NRRD0004\ntype: ushort\ndimension: 3\nspacings: 1 1 1\nsizes: "
                                    "10 10 10\nendian: little\nencoding: raw\n\n" +
                                        voxels);
    const std::string said = refusal_of([&] { (void)offline::read_label_map(path); });
    EXPECT_EQ(said.find("expected a label map, not grey values") != std::string::npos,
              different == 501)
        << said;
  }
}

// ---- organs of maps -----------------------------------------------------------------------------

// A ball of 20 mm radius around `centre_m`, in a map whose axes are `step_m`. Its half towards +x
// is label 2, the other half label 1.
LabelMap ball_map(std::array<Vec, 3> step_m, Vec centre_m) {
  LabelMap map;
  map.size = {64, 64, 64};
  map.step_m = step_m;
  map.origin_m = centre_m - (step_m[0] + step_m[1] + step_m[2]) * 31.7;
  for (std::uint32_t k = 0; k < 64; ++k) {
    for (std::uint32_t j = 0; j < 64; ++j) {
      for (std::uint32_t i = 0; i < 64; ++i) {
        const Vec p = map.origin_m + step_m[0] * i + step_m[1] * j + step_m[2] * k - centre_m;
        map.label.push_back(length(p) > 0.02 ? 0 : p.x > 0 ? 2 : 1);
      }
    }
  }
  return map;
}

// The vertices, in metres.
std::vector<Vec> surface_of(const Organ& organ) {
  std::vector<Vec> cells, points;
  for (const OrganRun& run : organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i)
      cells.push_back({1.0 * (run.x + i), 1.0 * run.y, 1.0 * run.z});
  }
  const Vec origin = {static_cast<double>(organ.origin_m.x), static_cast<double>(organ.origin_m.y),
                      static_cast<double>(organ.origin_m.z)};
  for (const OrganVertex& v : organ.vertices) {
    const Vec in_cell = Vec{1.0 * v.fx, 1.0 * v.fy, 1.0 * v.fz} * (1 / 65535.0);
    points.push_back(origin + (cells[v.voxel] + in_cell) * static_cast<double>(organ.voxel_edge_m));
  }
  return points;
}

const Recipe kHalves = {{}, {{"gel", {1}}, {"muscle", {2}}}};

TEST(LabelOrgan, LiesWhereTheMapIsWhateverItsAxes) {
  const double u = 1e-3;
  const std::array<Vec, 3> axes[] = {
      {Vec{u, 0, 0}, {0, u, 0}, {0, 0, u}},
      {Vec{-u, 0, 0}, {0, u, 0}, {0, 0, u}},                                // mirrored
      {Vec{0, u, 0}, {0, 0, -u}, {u, 0, 0}},                                // permuted
      {Vec{0.6 * u, 0.8 * u, 0}, {-0.8 * u, 0.6 * u, 0}, {0, 0, 1.5 * u}},  // rotated, stretched
  };
  const Vec centre = {0.1, -0.2, 0.3};
  const double volume = 4.0 / 3 * 3.14159265358979 * 0.02 * 0.02 * 0.02;
  for (const auto& step : axes) {
    offline::BuildOptions options;
    options.voxel_edge_m = 2.5e-3;
    const offline::Built built = build_quietly(ball_map(step, centre), kHalves, options);
    const Organ organ = opened(built.bytes);
    std::array<double, 2> filled{};
    Vec sum;
    double total = 0;
    std::size_t voxel = 0;
    for (const OrganRun& run : organ.runs) {
      for (std::uint32_t i = 0; i < run.count; ++i, ++voxel) {
        const double fill = organ.voxel_fill[voxel] / 255.0;
        const auto edge = static_cast<double>(organ.voxel_edge_m);
        const Vec at = {static_cast<double>(organ.origin_m.x) + (run.x + i + 0.5) * edge,
                        static_cast<double>(organ.origin_m.y) + (run.y + 0.5) * edge,
                        static_cast<double>(organ.origin_m.z) + (run.z + 0.5) * edge};
        sum = sum + at * fill;
        total += fill;
        filled.at(organ.voxel_material[voxel]) += fill * edge * edge * edge;
        if (fill < 0.99) continue;
        // Material 0 is gel, at low x; voxels that lie across the middle may have either material.
        if (std::fabs(at.x - centre.x) > edge) {
          EXPECT_EQ(organ.voxel_material[voxel], at.x > centre.x ? 1 : 0);
        }
      }
    }
    EXPECT_NEAR(length(sum * (1 / total) - centre), 0, 0.3e-3);
    EXPECT_NEAR((filled[0] + filled[1]) / volume, 1, 0.02);
    EXPECT_NEAR(filled[0] / filled[1], 1, 0.1);
    for (const offline::LabelReport& each : built.report.labels) {
      EXPECT_NEAR(each.filled_volume_m3 / each.map_volume_m3, 1, 0.01) << each.tissue;
    }
  }
}

// The surface is smooth and closed, turned outward, and encloses what the labels do.
TEST(LabelOrgan, SurfaceIsThatOfTheLabelsWithoutTheirSteps) {
  const double u = 1e-3;
  for (const double side : {1.0, -1.0}) {
    const std::array<Vec, 3> step = {Vec{side * u, 0, 0}, {0, u, 0}, {0, 0, u}};
    offline::BuildOptions options;
    options.voxel_edge_m = 2.5e-3;
    const offline::Built built = build_quietly(ball_map(step, {}), kHalves, options);
    const Organ organ = opened(built.bytes);
    const std::vector<Vec> points = surface_of(organ);
    double least = 1, most = 0;
    for (const Vec& point : points) {
      least = std::min(least, length(point));
      most = std::max(most, length(point));
    }
    // The map's steps of 1 mm would leave corners up to 0.9 mm off the ball.
    EXPECT_GT(least, 0.0194);
    EXPECT_LT(most, 0.0206);
    double six_volumes = 0;
    for (const OrganTriangle& t : organ.triangles) {
      six_volumes += dot(points[t.a], cross(points[t.b], points[t.c]));
    }
    EXPECT_NEAR(six_volumes / 6 / (4.0 / 3 * 3.14159265358979 * 8e-6), 1, 0.02);
  }
}

// Voxels that hold a little of the smoothed surface but none of the samples have the tissue beside
// them, not the recipe's first.
TEST(LabelOrgan, ThinVoxelsAreOfTheTissueBesideThem) {
  const double u = 1e-3;
  offline::BuildOptions options;
  options.voxel_edge_m = 1.7e-3;
  const offline::Built built =
      build_quietly(ball_map({Vec{u, 0, 0}, {0, u, 0}, {0, 0, u}}, {}), kHalves, options);
  const Organ organ = opened(built.bytes);
  std::size_t thin = 0, voxel = 0;
  for (const OrganRun& run : organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i, ++voxel) {
      const double x = static_cast<double>(organ.origin_m.x) + (run.x + i + 0.5) * 1.7e-3;
      if (organ.voxel_fill[voxel] > 1 || std::fabs(x) < 4e-3) continue;
      ++thin;
      EXPECT_EQ(organ.voxel_material[voxel], x > 0 ? 1 : 0) << x;
    }
  }
  EXPECT_GT(thin, 5U);
}

// The half of the ball with label 2 reaches from 0 to 20 mm; 5 mm of the other half stay.
TEST(LabelOrgan, CropKeepsALabelAndItsMargin) {
  const double u = 1e-3;
  const LabelMap map = ball_map({Vec{u, 0, 0}, {0, u, 0}, {0, 0, u}}, {});
  Recipe recipe = kHalves;
  recipe.crop_around = {2};
  recipe.crop_margin_m = 5e-3;
  offline::BuildOptions options;
  options.voxel_edge_m = 2.5e-3;
  const offline::Built built = build_quietly(map, recipe, options);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < map.label.size(); ++i) {
    const double x = static_cast<double>(i % 64) * u - 31.7e-3;
    kept += map.label[i] == 1 && x > -5e-3 ? 1 : 0;
  }
  EXPECT_EQ(built.report.labels[0].voxels, kept);
  EXPECT_EQ(built.report.labels[1].voxels,
            static_cast<std::size_t>(std::count(map.label.begin(), map.label.end(), 2)));
  recipe.crop_around = {9};
  EXPECT_THAT(refusal_of([&] { (void)build_quietly(map, recipe, options); }),
              testing::HasSubstr("holds none of the labels of [crop]"));
}

// The half of the ball with label 2 is a body, the half with label 1 a target: the centroid of a
// half ball lies 3/8 of the radius from its flat side. A hull of 64 vertices is a few per cent
// smaller.
TEST(LabelOrgan, ObstaclesAndTargetsLieWhereTheirLabelsDo) {
  const double u = 1e-3;
  const LabelMap map = ball_map({Vec{u, 0, 0}, {0, u, 0}, {0, 0, u}}, {});
  Recipe recipe = {{}, {{"gel", {1}}}};
  recipe.obstacles = {{"stone", {2}}, {"nothing", {9}}};
  recipe.targets = {{"lesion", {1}}};
  const offline::Built built = build_quietly(map, recipe, {});
  ASSERT_EQ(built.obstacles.size(), 1U);
  ASSERT_EQ(built.targets.size(), 1U);
  const auto voxels = [&](int label) {
    return static_cast<double>(std::count(map.label.begin(), map.label.end(), label)) * u * u * u;
  };
  EXPECT_NEAR(built.obstacles[0].hull.volume_m3 / voxels(2), 1, 0.1);
  for (const Vec& v : built.obstacles[0].hull.vertices_m) {
    EXPECT_GT(v.x, -1.01e-3);
    EXPECT_LT(length(v), 22e-3);
  }
  EXPECT_NEAR(built.targets[0].volume_m3, voxels(1), 1e-9);
  EXPECT_LT(length(built.targets[0].middle_m - Vec{-7.5e-3, 0, 0}), 1.5e-3);
  EXPECT_THAT(built.report.warnings,
              testing::Contains("none of the labels of nothing is in the map"));
  EXPECT_TRUE(built.targets[0].in_tissue);
  // The needle is aimed at the first target that lies in tissue.
  const std::string scene =
      offline::scene_toml("a.organ", {"a.stone.toml"},
                          {{"beside", {0.5, 0.5, 0.5}, 1e-6, 6e-3, false},
                           {"lesion", {0.001, -0.02, 0.3}, 1e-6, 6e-3, true}});
  EXPECT_THAT(scene, testing::HasSubstr("point_mm = [1.00, -20.00, 300.00]"));
  EXPECT_THAT(scene, testing::HasSubstr("hull = \"a.stone.toml\""));
}

// Around a ball of 20 mm: shells of 5 and 3 mm.
TEST(LabelOrgan, WallLiesAroundInLayers) {
  const double u = 1e-3;
  const LabelMap map = ball_map({Vec{u, 0, 0}, {0, u, 0}, {0, 0, u}}, {});
  Recipe recipe = {{}, {{"gel", {1, 2}}}};
  recipe.wall = {{"fat", 5e-3}, {"skin", 3e-3}};
  offline::BuildOptions options;
  options.voxel_edge_m = 2e-3;
  const offline::Built built = build_quietly(map, recipe, options);
  ASSERT_EQ(built.report.labels.size(), 3U);
  const auto ball = [](double mm) { return 4 * std::numbers::pi / 3 * mm * mm * mm * 1e-9; };
  EXPECT_NEAR(built.report.labels[0].map_volume_m3 / ball(20), 1, 0.01);
  EXPECT_NEAR(built.report.labels[1].map_volume_m3 / (ball(25) - ball(20)), 1, 0.05);
  EXPECT_NEAR(built.report.labels[2].map_volume_m3 / (ball(28) - ball(25)), 1, 0.05);
  EXPECT_NEAR(volume_m3(opened(built.bytes)) / ball(28), 1, 0.03);
}

TEST(LabelOrgan, SameMapSameBytes) {
  const double u = 1e-3;
  const LabelMap map = ball_map({Vec{u, 0, 0}, {0, u, 0}, {0, 0, u}}, {});
  const offline::BuildOptions options;
  EXPECT_EQ(build_quietly(map, kHalves, options).bytes, build_quietly(map, kHalves, options).bytes);
}

// A ball of 20 mm in the voxels of a map: 15 000 triangles, then 2000.
TEST(LabelOrgan, FewerTrianglesLieWhereMoreDid) {
  const double u = 1e-3;
  const LabelMap map = ball_map({Vec{u, 0, 0}, {0, u, 0}, {0, 0, u}}, {});
  Recipe recipe = kHalves;
  const auto rest_of = [&](const std::vector<std::byte>& bytes) {
    const Organ organ = opened(bytes);
    double least = 1, most = 0;
    for (const Vec& point : surface_of(organ)) {
      least = std::min(least, length(point));
      most = std::max(most, length(point));
    }
    return std::array{static_cast<double>(organ.triangles.size()), least, most};
  };
  const auto fine = rest_of(build_quietly(map, recipe, {}).bytes);
  recipe.most_triangles = 2000;
  const auto coarse = rest_of(build_quietly(map, recipe, {}).bytes);
  EXPECT_GT(fine[0], 10000);
  EXPECT_LE(coarse[0], 2000);
  EXPECT_GE(coarse[0], 1900);
  EXPECT_GT(coarse[1], fine[1] - 0.3e-3);
  EXPECT_LT(coarse[2], fine[2] + 0.3e-3);
}

// 60 balls as labels in 512 x 512 x 300 voxels of 0.8 x 0.8 x 1 mm; ten of them make one tissue.
LabelMap whole_body_map() {
  LabelMap map;
  map.size = {512, 512, 300};
  map.step_m = {Vec{0.8e-3, 0, 0}, {0, 0.8e-3, 0}, {0, 0, 1e-3}};
  map.label.resize(std::size_t{512} * 512 * 300);
  for (std::uint32_t label = 1; label <= 60; ++label) {
    const std::uint32_t radius = 24 + label % 10, n = label - 1;
    const std::array<std::uint32_t, 3> centre = {60 + n % 5 * 95, 60 + n / 5 % 4 * 120,
                                                 50 + n / 20 * 95};
    for (std::uint32_t k = centre[2] - radius; k <= centre[2] + radius; ++k) {
      for (std::uint32_t j = centre[1] - radius; j <= centre[1] + radius; ++j) {
        for (std::uint32_t i = centre[0] - radius; i <= centre[0] + radius; ++i) {
          const auto square = [](std::uint32_t a, std::uint32_t b) { return (a - b) * (a - b); };
          if (square(i, centre[0]) + square(j, centre[1]) + square(k, centre[2]) >
              radius * radius) {
            continue;
          }
          map.label[(std::size_t{k} * 512 + j) * 512 + i] = static_cast<std::uint16_t>(label);
        }
      }
    }
  }
  return map;
}

offline::Built build_whole_body() {
  Recipe recipe;
  for (const char* tissue : {"liver", "kidney", "vessel", "muscle", "bone", "fat"}) {
    recipe.groups.push_back({tissue, {}});
  }
  for (std::uint16_t label = 1; label <= 60; ++label) {
    recipe.groups[label % 6].labels.push_back(label);
  }
  offline::BuildOptions options;
  options.voxel_edge_m = 4e-3;
  return build_quietly(whole_body_map(), recipe, options);
}

TEST(LabelTimed, AWholeBodyTakesLessThanAMinuteAndThreeGibibytes) {
#ifdef STYLET_SANITIZED
  GTEST_SKIP() << "a sanitizer takes its own time and memory";
#endif
  const auto start = std::chrono::steady_clock::now();
  (void)build_whole_body();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  EXPECT_LT(use.ru_maxrss, 3L << 20U);  // KiB
}

TEST(LabelOrgan, OfAWholeBodyKeepsItsVolumes) {
#ifdef STYLET_SANITIZED
  GTEST_SKIP() << "a sanitizer takes its own time and memory";
#endif
  const offline::Built built = build_whole_body();
  for (const offline::LabelReport& each : built.report.labels) {
    EXPECT_NEAR(each.filled_volume_m3 / each.map_volume_m3, 1, 0.01) << each.tissue;
  }
}

TEST(LabelOrgan, MissingLabelsAreReported) {
  const double u = 1e-3;
  const LabelMap map = ball_map({Vec{u, 0, 0}, {0, u, 0}, {0, 0, u}}, {});
  const offline::BuildOptions options;
  const auto built = build_quietly(map, {{}, {{"gel", {1}}, {"bone", {9}}}}, options);
  EXPECT_THAT(built.report.warnings,
              testing::ElementsAre("none of the labels of bone is in the map"));
  EXPECT_THAT(refusal_of([&] {
                (void)build_quietly(map, {{}, {{"bone", {9}}}}, options);
              }),
              testing::HasSubstr("holds none of the recipe's labels"));
}

// ---- recipes ------------------------------------------------------------------------------------

TEST(Recipe, TakesNumbersAndNames) {
  const Scratch scratch;
  const Recipe recipe = offline::read_recipe(scratch.write(
      "r.toml",
      "[names]\nliver = 5\naorta = 52\n[tissues]\nvessel = [\"aorta\", 64]\nliver = [5]\n"));
  ASSERT_EQ(recipe.groups.size(), 2U);
  EXPECT_EQ(recipe.groups[0].tissue, "liver");
  EXPECT_EQ(recipe.groups[1].tissue, "vessel");
  EXPECT_THAT(recipe.groups[1].labels, testing::ElementsAre(52, 64));
  EXPECT_EQ(recipe.names.at(52), "aorta");
  EXPECT_FALSE(recipe.open_gaps);
}

TEST(Recipe, TakesNumbersFromTheLeastToTheMostInMillimetres) {
  const Scratch scratch;
  const auto with = [&](int margin_mm, int smoothing, int triangles, int wall_mm) {
    return offline::read_recipe(scratch.write(
        "r.toml", fmt::format("[tissues]\nliver = [5]\n[crop]\naround = [5]\nmargin_mm = {}\n"
                              "[surface]\nsmoothing = {}\ntriangles = {}\n"
                              "[[wall]]\ntissue = \"fat\"\nthickness_mm = {}\n",
                              margin_mm, smoothing, triangles, wall_mm)));
  };
  const Recipe least = with(0, 0, 1000, 0);
  EXPECT_EQ(std::tuple(least.crop_margin_m, least.smoothing, least.most_triangles,
                       least.wall.at(0).thickness_m),
            std::tuple(0, 0, 1000U, 0));
  const Recipe most = with(1000, 100, kMaxTriangles, 200);
  EXPECT_EQ(std::tuple(most.crop_margin_m, most.smoothing, most.most_triangles,
                       most.wall.at(0).thickness_m),
            std::tuple(1.0, 100, kMaxTriangles, 0.2));
}

TEST(Recipe, SaysWhetherGapsStayOpen) {
  const Scratch scratch;
  const auto open_gaps = [&](const std::string& gaps) {
    return offline::read_recipe(scratch.write("r.toml",
                                              "[tissues]\nliver = [1]\n[contact]\n"
                                              "touching = \"shared\"\ngaps = " +
                                                  gaps + "\n"))
        .open_gaps;
  };
  EXPECT_TRUE(open_gaps("\"open\""));
  EXPECT_FALSE(open_gaps("\"closed\""));
}

TEST(Recipe, RefusesWithFileAndLine) {
  const Scratch scratch;
  const std::pair<const char*, const char*> bad[] = {
      {"[tissues]\nliver = 5\n", "r.toml:2: liver: expected a list of labels"},
      {"[tissues]\nliver = []\n", "r.toml:2: liver: expected a list"},
      {"[tissues]\nliver = [0]\n", "r.toml:2: liver: expected a label from 1"},
      {"[tissues]\nliver = [65536]\n", "expected a label from 1 to 65535"},
      {"[tissues]\nliver = [1.5]\n", "expected a label from 1"},
      {"[tissues]\nliver = [\"aorta\"]\n", "r.toml:2: aorta: expected one of the names"},
      {"[tissues]\nbone = [5]\nliver = [5]\n", "label 5 is bone already"},
      {"[tissues]\nliver = [5, 5]\n", "label 5 is liver already"},
      {"[names]\na = 1\nb = 1\n[tissues]\nliver = [1]\n", "label 1 is a already"},
      {"[organs]\n", "organs: expected [names], [tissues]"},
      {"[crop]\nmargin_mm = 5\n[tissues]\nliver = [1]\n", "[crop]: expected around"},
      {"[crop]\naround = 5\n[tissues]\nliver = [1]\n", "r.toml:2: around: expected around = ["},
      {"[crop]\naround = [1]\nmargin_mm = -1\n", "r.toml:3: margin_mm: expected a number from 0"},
      {"[surface]\nsmoothing = 101\n", "r.toml:2: smoothing: expected a number from 0 to 100"},
      {"[surface]\nsmoothing = 1.5\n",
       "r.toml:2: smoothing: expected smoothing = or triangles = a"},
      {"[surface]\ntriangles = 10\n", "r.toml:2: triangles: expected 1000 or more"},
      {"[obstacles]\n'a/b' = [1]\n[tissues]\nliver = [5]\n", "r.toml:2: a/b: expected a name of"},
      {"[obstacles]\nrib = 1\n[tissues]\nliver = [5]\n", "r.toml:2: rib: expected a list"},
      {"[obstacles]\nrib = [5]\n[tissues]\nliver = [5]\n", "rib: label 5 is liver already"},
      {"[wall]\ntissue = \"fat\"\n[tissues]\nliver = [5]\n", "r.toml:1: [[wall]]: expected tissue"},
      {"[[wall]]\ntissue = \"fat\"\n[tissues]\nliver = [5]\n", "r.toml:1: [[wall]]: expected"},
      {"[[wall]]\ntissue = \"fat\"\nthickness_mm = -1\n", "thickness_mm: expected a number"},
      {"[contact]\ntouching = \"sliding\"\n", "r.toml:2: touching: expected \"shared\": organs"},
      {"[contact]\ngaps = true\n", "r.toml:2: gaps: expected gaps = \"open\" or \"closed\""},
      {"[contact]\nsliding = true\n", "r.toml:2: sliding: expected gaps = "},
      {"[names]\na = 1\n", "expected a table [tissues]"},
      {"[tissues]\n", "[tissues]: expected at least one"},
      {"[tissues\n", "r.toml:"},
      {"tissues = 3\n", "expected a table [tissues]"},
      {"[crop]\nmargin_mm = \"wide\"\n", "r.toml:2: margin_mm: expected a number"},
      {"[crop]\nmargin_mm = 1001\n", "r.toml:2: margin_mm: expected a number from 0 to 1000"},
      {"[crop]\nbeside = [1]\n", "r.toml:2: beside: expected around"},
      {"[surface]\ntriangles = 1e4\n", "r.toml:2: triangles: expected smoothing"},
      {"[surface]\nfaces = 10\n", "r.toml:2: faces: expected smoothing"},
      {"[obstacles]\nrib = []\n[tissues]\nliver = [5]\n", "r.toml:2: rib: expected a list"},
      {"[[wall]]\ntissue = \"fat\"\nthick_mm = 2\n", "[[wall]]: expected tissue"},
      {"[[wall]]\nlayer = \"fat\"\nthickness_mm = 2\n", "[[wall]]: expected tissue"},
      {"[[wall]]\ntissue = 3\nthickness_mm = 2\n", "[[wall]]: expected tissue"}};
  for (const auto& [text, reason] : bad) {
    const auto path = scratch.write("r.toml", text);
    EXPECT_THAT(refusal_of([&] { (void)offline::read_recipe(path); }), testing::HasSubstr(reason));
  }
}

TEST(Recipe, NamesAsManyObstaclesAsAnOrganHas) {
  const Scratch scratch;
  const auto with = [&](std::uint32_t count) {
    std::string text = "[tissues]\nliver = [5]\n[obstacles]\n";
    for (std::uint32_t i = 0; i < count; ++i) text += fmt::format("rib_{0}-a = [{1}]\n", i, i + 6);
    return scratch.write("r.toml", text);
  };
  const auto read = offline::read_recipe(with(kMaxObstacles));
  ASSERT_EQ(read.obstacles.size(), kMaxObstacles);
  std::set<std::string> names;
  for (const auto& each : read.obstacles) names.insert(each.name);
  EXPECT_EQ(names.size(), kMaxObstacles);
  EXPECT_TRUE(names.contains("rib_0-a"));
  EXPECT_THAT(refusal_of([&] { (void)offline::read_recipe(with(kMaxObstacles + 1)); }),
              testing::HasSubstr(fmt::format("[obstacles]: {} bodies: expected at most {}",
                                             kMaxObstacles + 1, kMaxObstacles)));
}

TEST(Recipe, NamesAreTheSameInAnyOrderOfWordsAndSpelling) {
  const std::pair<const char*, const char*> same[] = {{"Kidney, left", "left_kidney"},
                                                      {"left--kidney ", "  Kidney (LEFT)"},
                                                      {"Größe 2", "2 größe"},
                                                      {"", "--"}};
  for (const auto& [a, b] : same) EXPECT_TRUE(offline::is_same_name(a, b)) << a;
  const std::pair<const char*, const char*> other[] = {
      {"kidney", "left kidney"}, {"left left", "left"}, {"Gr\xc3\xb6", "Gro"}, {"a1", "a 1"}};
  for (const auto& [a, b] : other) EXPECT_FALSE(offline::is_same_name(a, b)) << a;
}

// By the names in the map's file, in any order of words; all labels with that name count.
TEST(Recipe, UsesTheNamesOfTheMap) {
  const Scratch scratch;
  const offline::FileNames names = {"seg.nrrd",
                                    {{2, "Right kidney"}, {7, "portal vein"}, {9, "Portal Vein"}}};
  const Recipe recipe = offline::read_recipe(
      scratch.write("r.toml",
                    "[names]\nliver = 5\n[tissues]\nkidney = [\"kidney_right\"]\n"
                    "liver = [\"liver\"]\nvessel = [\"Portal_vein\"]\n"
                    "[targets]\nside = [\"right kidney\"]\n"),
      names);
  EXPECT_THAT(recipe.groups.at(0).labels, testing::ElementsAre(2));
  EXPECT_THAT(recipe.groups.at(1).labels, testing::ElementsAre(5));
  EXPECT_THAT(recipe.groups.at(2).labels, testing::ElementsAre(7, 9));
  EXPECT_THAT(recipe.targets.at(0).labels, testing::ElementsAre(2));
  const auto exact = scratch.write("r.toml", "[tissues]\nvessel = [\"portal vein\"]\n");
  EXPECT_THAT(offline::read_recipe(exact, names).groups.at(0).labels, testing::ElementsAre(7));
}

TEST(Recipe, MustNotContradictTheMapsNames) {
  const Scratch scratch;
  const offline::FileNames names = {"mr.nii", {{52, "portal vein"}, {3, "liver"}}};
  const auto refused = [&](const std::string& text) {
    const auto path = scratch.write("r.toml", text);
    return refusal_of([&] { (void)offline::read_recipe(path, names); });
  };
  EXPECT_THAT(refused("[names]\naorta = 52\n[tissues]\nvessel = [\"aorta\"]\n"),
              testing::HasSubstr("aorta = 52: in mr.nii label 52 is called portal vein"));
  EXPECT_THAT(refused("[names]\naorta = 52\n[tissues]\nvessel = [52]\n"),
              testing::HasSubstr("label 52 is called portal vein"));
  EXPECT_THAT(refused("[names]\naorta = 52\n[tissues]\nx = [3]\n[obstacles]\nb = [52]\n"),
              testing::HasSubstr("label 52 is called portal vein"));
  EXPECT_THAT(refused("[names]\nliver = 5\n[tissues]\nliver = [\"liver\"]\n"),
              testing::HasSubstr("liver = 5: in mr.nii liver is label 3"));
  EXPECT_THAT(refused("[tissues]\nliver = [\"spleen\"]\n"),
              testing::HasSubstr("or of mr.nii: liver, portal vein"));
  // It is no contradiction if a label is not used, has the same name, or has no name in one of the
  // two.
  for (const char* const text : {"[names]\naorta = 52\n[tissues]\nliver = [3]\n",
                                 "[names]\nPortal_Vein = 52\n[tissues]\nvessel = [52]\n",
                                 "[names]\nspleen = 60\n[tissues]\nliver = [60]\n"}) {
    EXPECT_EQ(refused(text), "") << text;
  }
}

TEST(Recipe, OfTotalSegmentatorMakesAnAbdomen) {
  const auto path = data_folder() / "labelmaps" / "ts_example_seg_fast_force_split.nii.gz";
  SKIP_WITHOUT(path);
  const Recipe recipe = offline::read_recipe(STYLET_RECIPES "/totalsegmentator.toml");
  const LabelMap map = offline::read_label_map(path);
  const offline::Built built = build_quietly(map, recipe, {});
  EXPECT_TRUE(built.report.warnings.empty());
  std::map<std::string, double> ml;
  for (const offline::LabelReport& each : built.report.labels) {
    ml[each.tissue] = each.filled_volume_m3 * 1e6;
    EXPECT_NEAR(each.filled_volume_m3 / each.map_volume_m3, 1, 0.01) << each.tissue;
  }
  EXPECT_NEAR(ml.at("liver"), 41692 * 0.027, 12);  // voxels of 27 mm3, as the table says
  EXPECT_NEAR(ml.at("kidney"), (7134 + 5090) * 0.027, 4);
  const Organ organ = opened(built.bytes);
  const std::set<std::uint8_t> materials(organ.voxel_material.begin(), organ.voxel_material.end());
  EXPECT_EQ(materials.size(), 6U);
}

}  // namespace
}  // namespace stylet::test
