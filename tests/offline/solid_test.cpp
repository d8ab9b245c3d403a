// SPDX-License-Identifier: Apache-2.0
// Repair, winding numbers and voxels, on bodies whose volume is known in closed form.
#include <bit>
#include <numbers>
#include <random>

#include "base/refusal.h"
#include "meshes/phantom.h"
#include "meshes/triangle_tree.h"
#include "meshes/wrap.h"
#include "offline_support.h"
#include "voxels/sample_cell.h"
#include "voxels/voxelize.h"

namespace stylet::test {
namespace {

using offline::BuildOptions;
using offline::Mesh;
using offline::Vec;

constexpr double kMm = 1e-3;
// The voxel edge is a float in the file, so a volume is right up to three of its roundings.
constexpr double kEdgeRounding = 3 * 6e-8;

double built_volume_ml(const Mesh& mesh_m, double voxel_mm, bool wrap = false) {
  BuildOptions options;
  options.voxel_edge_m = voxel_mm * kMm;
  options.wrap = wrap;
  const offline::Built built = build_quietly({input_of(mesh_m, 1)}, options);
  return volume_m3(opened(built.bytes)) * 1e6;
}

Mesh block_mm(double x, double y, double z) {
  return offline::block_phantom(Vec{x, y, z} * kMm, 5 * kMm);
}

void move(Mesh& mesh, Vec by) {
  for (Vec& p : mesh.points) p = p + by;
}

void append(Mesh& mesh, const Mesh& other, bool turned) {
  const auto base = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (offline::Triangle t : other.triangles) {
    if (turned) std::swap(t[1], t[2]);
    mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
}

TEST(Volume, ABlockAlignedWithTheGridIsExactAndHasNoExtraLayer) {
  for (const double voxel_mm : {5.0, 2.5, 10.0}) {
    BuildOptions options;
    options.voxel_edge_m = voxel_mm * kMm;
    const auto built = build_quietly({input_of(block_mm(60, 40, 20), 1)}, options);
    const Organ organ = opened(built.bytes);
    EXPECT_EQ(organ.voxel_count, std::lround(60 * 40 * 20 / (voxel_mm * voxel_mm * voxel_mm)));
    EXPECT_NEAR(volume_m3(organ) * 1e6, 48, 48 * kEdgeRounding) << voxel_mm;
  }
}

// 64 samples per axis: a face parallel to the grid is placed to within 1/128 of a voxel edge.
TEST(Volume, ABlockNotAlignedWithTheGridIsWithinTheSampling) {
  const double exact_ml = 61.3 * 42.1 * 23.7 * 1e-3;
  const double face_error = 5.0 / 64 * (1 / 61.3 + 1 / 42.1 + 1 / 23.7);
  EXPECT_NEAR(built_volume_ml(block_mm(61.3, 42.1, 23.7), 5), exact_ml, exact_ml * face_error);
}

// The mesher's facets lie inside the sphere by at most 0.25 % of the radius, which is 0.75 % of the
// volume.
TEST(Volume, BallIsFourThirdsPiRCubed) {
  const double exact_ml = 4.0 / 3.0 * std::numbers::pi * 27;
  EXPECT_NEAR(built_volume_ml(offline::ball_phantom(60 * kMm, 5 * kMm), 5), exact_ml,
              exact_ml * 0.0075);
}

TEST(Volume, InsideOutIsTurned) {
  Mesh mesh;
  append(mesh, block_mm(40, 40, 40), true);
  EXPECT_NEAR(built_volume_ml(mesh, 5), 64, 64 * kEdgeRounding);
}

TEST(Volume, ShuffledFacesAreTurned) {
  Mesh mesh = block_mm(40, 40, 40);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  }
  EXPECT_NEAR(built_volume_ml(mesh, 5), 64, 64 * kEdgeRounding);
}

TEST(Volume, ACavityStaysEmptyAndASecondPieceCounts) {
  Mesh mesh = block_mm(60, 60, 60);
  Mesh hollow = block_mm(20, 20, 20);
  move(hollow, Vec{20, 0, 0} * kMm);
  append(mesh, hollow, true);
  Mesh apart = block_mm(10, 10, 10);
  move(apart, Vec{80, 0, 0} * kMm);
  append(mesh, apart, true);  // inside out, but not within another body: it is turned
  EXPECT_NEAR(built_volume_ml(mesh, 5), 216 - 8 + 1, 209 * kEdgeRounding);
}

TEST(Volume, DoubledSheetsCountOnce) {
  Mesh mesh = block_mm(40, 40, 40);
  append(mesh, block_mm(40, 40, 40), false);
  EXPECT_NEAR(built_volume_ml(mesh, 5), 64, 64 * kEdgeRounding);
}

// A window of 20 x 20 mm in a wall, four voxels wide. The flood fill enters, and the winding number
// keeps the inside. A dent below the window may be lost, of about the cube of the window's size.
TEST(Volume, HoleWiderThanAVoxelIsBridged) {
  Mesh mesh = block_mm(60, 60, 60);
  std::erase_if(mesh.triangles, [&](const offline::Triangle& t) {
    const Vec c = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) * (1.0 / 3);
    return c.x < 1e-9 && std::abs(c.y) < 10 * kMm && std::abs(c.z) < 10 * kMm;
  });
  BuildOptions options;
  const auto built = build_quietly({input_of(mesh, 1)}, options);
  EXPECT_GT(built.report.inputs[0].decided_by_winding, 100U);
  EXPECT_NEAR(volume_m3(opened(built.bytes)) * 1e6, 216, 8);
}

TEST(Volume, ASurfaceWithoutVolumeIsRefusedUnlessWrapped) {
  const Mesh triangle{{{0, 0, 0}, {0.03, 0, 0}, {0, 0.03, 0}}, {{0, 1, 2}}};
  EXPECT_THROW((void)built_volume_ml(triangle, 5), offline::Refusal);
  // The skin is half a millimetre away on both sides of 4.5 cm^2 and around a rim of 10.2 cm. Its
  // facets, a voxel long, cut off the rim and its corners.
  const double slab_ml = 0.45, rim_ml = 10.2 * std::numbers::pi / 2 * 0.05 * 0.05;
  const double skin_ml = built_volume_ml(triangle, 5, true);
  EXPECT_GT(skin_ml, slab_ml * 2 / 3);
  EXPECT_LT(skin_ml, slab_ml + rim_ml);
}

TEST(Winding, IsOneInsideZeroOutside) {
  const Mesh ball = offline::ball_phantom(60 * kMm, 5 * kMm);
  const offline::TriangleTree tree = offline::triangle_tree(ball.points, ball.triangles);
  for (int i = -20; i <= 20; ++i) {
    const double x = i * 2.1 * kMm;  // at least 0.6 mm from the surface
    const double expected = std::abs(x) < 30 * kMm ? 1 : 0;
    EXPECT_NEAR(offline::winding_number(tree, {x, 0.3 * kMm, 0.2 * kMm}), expected, 0.05) << x;
    EXPECT_EQ(offline::crossings(tree, {x, 0.3 * kMm, 0.2 * kMm}, {0.1, 1, 0.2}) % 2,
              static_cast<int>(expected));
  }
}

// A box without one of its triangles, turned either way, and in it a box with its faces outward:
// tissue in tissue.
TEST(Volume, ABodyInsideAnOpenSurfaceIsInIt) {
  for (const bool inside_out : {false, true}) {
    Mesh mesh, outer = box_mesh({-0.03, -0.03, -0.03}, {0.03, 0.03, 0.03});
    outer.triangles.pop_back();
    append(mesh, outer, inside_out);
    append(mesh, box_mesh({-0.015, -0.015, -0.015}, {0.015, 0.015, 0.015}), inside_out);
    EXPECT_NEAR(built_volume_ml(mesh, 5), 216, 216 * kEdgeRounding) << inside_out;
  }
}

// Two boxes, each without one of its triangles, one of them inside out: the sides of each are found
// for itself. Just under a missing triangle the winding number is one half, and is a sum over
// clusters, so that a voxel may be lost.
TEST(Volume, OpenBodiesThatEncloseSomethingAreTurnedEachByItself) {
  for (const bool small_one : {false, true}) {
    Mesh mesh, large = box_mesh({0, 0, 0}, {0.06, 0.06, 0.06});
    Mesh small = box_mesh({0.1, 0, 0}, {0.13, 0.03, 0.03});
    large.triangles.pop_back();
    small.triangles.pop_back();
    append(mesh, large, !small_one);
    append(mesh, small, small_one);
    EXPECT_NEAR(built_volume_ml(mesh, 5), 216 + 27, 0.125) << small_one;
  }
}

// A face occurs three times, first the wrong way and then twice the right way.
TEST(Volume, OfFacesThatContradictEachOtherTheMajorityCounts) {
  Mesh mesh = block_mm(40, 40, 40);
  const offline::Triangle right = mesh.triangles.front();
  mesh.triangles.front() = {right[0], right[2], right[1]};
  mesh.triangles.push_back(right);
  mesh.triangles.push_back(right);
  EXPECT_NEAR(built_volume_ml(mesh, 5), 64, 64 * kEdgeRounding);
}

// In a closed surface every line through an inner point meets one face in each direction.
TEST(Rays, GoOneWayAndMeetNothingInEmptySpace) {
  const Mesh block = box_mesh({0, 0, 0}, {3, 2, 1});
  const offline::TriangleTree tree = offline::triangle_tree(block.points, block.triangles);
  for (int i = 0; i < 100; ++i) {
    const Vec ray{std::cos(0.9 * i), std::sin(0.9 * i), 0.31 * std::cos(2.3 * i + 1)};
    EXPECT_EQ(offline::crossings(tree, {1.1, 0.7, 0.4}, ray), 1) << i;
  }
  EXPECT_EQ(offline::crossings(offline::triangle_tree({}, {}), {0, 0, 0}, {0.1, 1, 0.2}), 0);
}

// With faces turned at random no winding number makes sense, but rays do not depend on the sides.
TEST(Rays, DecideByVoteIfFacesDisagree) {
  Mesh block = block_mm(40, 40, 40);
  for (std::size_t i = 0; i < block.triangles.size(); i += 2 + i % 3) {
    std::swap(block.triangles[i][1], block.triangles[i][2]);
  }
  const offline::TriangleTree tree = offline::triangle_tree(block.points, block.triangles);
  for (int i = -10; i < 30; ++i) {
    const Vec at = Vec{i * 2.0 + 0.7, i - 9.6, 0.4 * i - 3.3} * kMm;
    const bool inside = at.x > 0 && at.x < 0.04 && std::abs(at.y) < 0.02 && std::abs(at.z) < 0.02;
    EXPECT_EQ(offline::is_inside({tree, false}, at), inside) << i;
  }
}

// Counting crossings from sample to sample gives the same as 64 winding numbers.
TEST(SampleCell, CountingCrossingsAgreesWithWindingNumbers) {
  Mesh ball = offline::ball_phantom(60 * kMm, 5 * kMm);
  for (Vec& p : ball.points) p = p * 200;  // cells of 5 mm
  const offline::TriangleTree tree = offline::triangle_tree(ball.points, ball.triangles);
  int partly = 0;
  for (int x = -7; x < 7; ++x) {
    for (int y = -7; y < 7; ++y) {
      const Vec low{static_cast<double>(x), static_cast<double>(y), 1};
      const std::uint64_t bits = offline::sample_cell({tree, true}, low);
      EXPECT_EQ(offline::sample_cell({tree, true}, low, tree.corners), bits) << x << " " << y;
      partly += bits != 0 && std::popcount(bits) < 64 ? 1 : 0;
    }
  }
  EXPECT_GT(partly, 20);
}

// Faces that pass exactly through samples, so that a ray from sample to sample begins or ends on
// one.
TEST(SampleCell, CountingCrossingsAgreesIfSamplesLieOnFaces) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> any(0, 63);
  for (int n = 0; n < 200; ++n) {
    const auto place = [&] { return (any(random) + 0.5) / 64; };
    Vec low{place(), place(), place()}, high{place(), place(), place()};
    for (double Vec::*axis : {&Vec::x, &Vec::y, &Vec::z}) {
      if (low.*axis > high.*axis) std::swap(low.*axis, high.*axis);
      high.*axis += 0.25;
    }
    const Mesh box = box_mesh(low, high);
    const offline::TriangleTree tree = offline::triangle_tree(box.points, box.triangles);
    const std::uint64_t bits = offline::sample_cell({tree, true}, {0, 0, 0});
    EXPECT_EQ(offline::sample_cell({tree, true}, {0, 0, 0}, tree.corners), bits) << n;
  }
}

TEST(Grid, RefusesMoreThanMemoryCanHold) {
  EXPECT_THROW((void)offline::make_grid({{0, 0, 0}, {1, 1, 1}}, 1e-4), offline::Refusal);
  EXPECT_THROW((void)offline::make_grid({{0, 0, 0}, {7, 1e-4, 1e-4}}, 1e-4), offline::Refusal);
  // A thousand triangles across 160 cells along each side are at most 4 096 million visits.
  const offline::Grid grid = offline::make_grid({{0, 0, 0}, {0.16, 0.16, 0.16}}, 1e-3);
  offline::Solid solid;
  solid.surface.points = {{0, 0, 0}, {0.16, 0.16, 0}, {0, 0.16, 0.16}};
  solid.surface.triangles.assign(1000, {0, 1, 2});
  EXPECT_THROW((void)offline::voxelize(grid, solid, [](const char*, double) {}), offline::Refusal);
}

// The overlap test against its definition: a cube is pierced if one of a dense set of the
// triangle's points is inside it; and no point of the triangle lies in a cube that is not marked.
TEST(Overlap, NoPointOfATriangleIsMissed) {
  const offline::Grid grid = offline::make_grid({{0, 0, 0}, {0.05, 0.05, 0.05}}, 5 * kMm);
  std::uint32_t seed = 7;
  const auto draw = [&] {
    seed = seed * 1664525U + 1013904223U;
    return (seed >> 8U) / 16777216.0 * 0.05;
  };
  for (int round = 0; round < 200; ++round) {
    Mesh mesh{{{draw(), draw(), draw()}, {draw(), draw(), draw()}, {draw(), draw(), draw()}},
              {{0, 1, 2}}};
    if (round % 4 == 0)
      mesh.points[2] =
          mesh.points[0] + (mesh.points[1] - mesh.points[0]) * 0.5 + Vec{1e-9, 0, 0};  // a sliver
    const std::vector<std::uint8_t> touched = offline::touched_cells(grid, mesh);
    std::vector<std::uint8_t> met(touched.size(), 0);
    for (int i = 0; i <= 200; ++i) {
      for (int j = 0; i + j <= 200; ++j) {
        const Vec p = mesh.points[0] + (mesh.points[1] - mesh.points[0]) * (i / 200.0) +
                      (mesh.points[2] - mesh.points[0]) * (j / 200.0);
        const Vec at = offline::to_lattice(grid, p);
        met[offline::cell_index(grid, static_cast<std::uint32_t>(at.x),
                                static_cast<std::uint32_t>(at.y),
                                static_cast<std::uint32_t>(at.z))] = 1;
      }
    }
    for (std::size_t cell = 0; cell < met.size(); ++cell) ASSERT_LE(met[cell], touched[cell]);
  }
}

}  // namespace
}  // namespace stylet::test
