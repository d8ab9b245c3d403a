// SPDX-License-Identifier: Apache-2.0
// Skins around surfaces with holes, around loose triangles, around thin bodies and sheets: volumes
// in closed form. Sizes, places, directions and voxel edges are random.
#include <gmock/gmock.h>

#include <numbers>

#include "base/refusal.h"
#include "meshes/holes.h"
#include "offline_support.h"
#include "pipeline/wrapping.h"
#include "random_bodies.h"

namespace stylet::test {
namespace {

using offline::Mesh;
using offline::Vec;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kMm = 1e-3;
constexpr double kMostOff = 0.05;  // reported from here on, stages.md

// Rings of a ball's surface, faces outward, beginning at the angle `from` from its pole.
Mesh ball_from(double radius, double from, unsigned rings, unsigned around) {
  const double pi = std::numbers::pi;
  Mesh mesh;
  for (unsigned i = 0; i <= rings; ++i) {
    const double polar = from + (pi - from) * i / rings;
    for (unsigned j = 0; j < around; ++j) {
      const double turn = 2 * pi * j / around, r = i == rings ? 0 : radius * std::sin(polar);
      mesh.points.push_back({r * std::cos(turn), r * std::sin(turn), radius * std::cos(polar)});
    }
  }
  for (unsigned i = 0; i < rings; ++i) {
    for (unsigned j = 0; j < around; ++j) {
      const unsigned a = i * around + j, b = i * around + (j + 1) % around;
      mesh.triangles.push_back({a, a + around, b + around});
      mesh.triangles.push_back({a, b + around, b});
    }
  }
  return mesh;
}

// A ball without the part beyond a plane. Facets lie inside by less than 0.5 % of the volume.
double cut_ball_m3(double radius, double from) {
  const double height = radius * (1 - std::cos(from));
  return std::numbers::pi *
         (4 * radius * radius * radius - height * height * (3 * radius - height)) / 3;
}

// Each triangle has corners of its own, a little away from the others, and is turned at random.
Mesh loose(const Mesh& mesh, double apart, Draw& draw) {
  Mesh out;
  for (const offline::Triangle& t : mesh.triangles) {
    const double far = draw.between(0, apart);
    const Vec by = draw.direction() * far;
    const auto base = static_cast<std::uint32_t>(out.points.size());
    for (const std::uint32_t corner : t) out.points.push_back(mesh.points[corner] + by);
    const bool turns = draw.coin();
    out.triangles.push_back({base, base + (turns ? 2 : 1), base + (turns ? 1 : 2)});
  }
  return out;
}

struct Wrapped {
  double volume = 0;
  std::vector<std::string> warnings;
};

Wrapped wrapped(const Mesh& mesh, double edge_m) {
  offline::BuildOptions options;
  options.voxel_edge_m = edge_m;
  options.wrap = true;
  const offline::Built built = build_quietly({input_of(mesh, 1, "gel")}, options);
  return {volume_m3(opened(built.bytes)), built.report.warnings};
}

TEST(Wrap, HolesWiderThanAStepLeaveNoHollowShell) {
  Draw draw(11);
  for (int n = 0; n < 6; ++n) {
    const double radius = draw.between(20, 40) * kMm, edge = draw.between(3, 6) * kMm;
    const double from = draw.between(0.3, 1.6);
    const std::array<Vec, 3> frame = random_frame(draw);
    const Mesh mesh = turned(ball_from(radius, from, 20, 36), frame);
    const double exact = cut_ball_m3(radius, from), across_mm = 2e3 * radius * std::sin(from);
    const Wrapped skin = wrapped(mesh, edge);
    EXPECT_NEAR(skin.volume, exact, exact * kMostOff) << n;
    // Holes of two steps and more: CGAL's own skin goes in.
    if (across_mm < 2.5e3 * edge) continue;
    const Vec middle = frame[2] * (radius * std::cos(from) * 1e3);
    ASSERT_FALSE(skin.warnings.empty()) << n;
    std::array<double, 5> told{};
    ASSERT_EQ(std::sscanf(skin.warnings[0].c_str(),
                          "test.off: in steps of %lf mm the skin went in through holes; now flat "
                          "patches close them, the widest %lf mm across at (%lf, %lf, %lf) mm",
                          &told[0], &told[1], &told[2], &told[3], &told[4]),
              5)
        << skin.warnings[0];
    EXPECT_NEAR(told[0], edge * 1e3, edge);
    EXPECT_NEAR(told[1], across_mm, across_mm * 0.01);
    EXPECT_NEAR(length(Vec{told[2], told[3], told[4]} - middle), 0, 0.1);
  }
}

// Nothing is connected, so that no hole is known: the steps grow to half of its width. The skin of
// the second ball stays out at first, but would go in when it is made again closer to the ball.
TEST(Wrap, LooseTrianglesAroundAHoleLeaveNoHollowShell) {
  for (const unsigned seed : {12U, 101U}) {
    Draw draw(seed);
    const double radius = draw.between(25, 35) * kMm, from = draw.between(0.4, 0.8);
    const std::array<Vec, 3> frame = random_frame(draw);
    const Mesh ball = turned(ball_from(radius, from, 16, 24), frame);
    const double exact = cut_ball_m3(radius, from);
    const Wrapped skin = wrapped(loose(ball, 0.1 * kMm, draw), 5 * kMm);
    EXPECT_NEAR(skin.volume, exact, exact * kMostOff) << seed;
    ASSERT_EQ(skin.warnings.size(), 1U) << testing::PrintToString(skin.warnings);
    std::array<double, 5> told{};
    ASSERT_EQ(std::sscanf(skin.warnings[0].c_str(),
                          "test.off: in steps of %lf mm the skin went in through gaps of up to %lf "
                          "mm, as at (%lf, %lf, %lf) mm",
                          &told[0], &told[1], &told[2], &told[3], &told[4]),
              5)
        << skin.warnings[0];
    EXPECT_NE(skin.warnings[0].find("coarser everywhere"), std::string::npos) << skin.warnings[0];
    const double across_mm = 2e3 * radius * std::sin(from);
    EXPECT_NEAR(told[1], across_mm, across_mm * 0.2);
    const Vec middle = frame[2] * (radius * std::cos(from) * 1e3);
    EXPECT_LT(length(Vec{told[2], told[3], told[4]} - middle), across_mm * 0.2);
  }
}

TEST(Wrap, GapsNarrowerThanAStepAreBridgedWithoutAWarning) {
  Draw draw(13);
  const double radius = 30 * kMm;
  const Mesh ball = turned(ball_from(radius, 0, 20, 36), random_frame(draw));
  const double exact = cut_ball_m3(radius, 0);
  const Wrapped skin = wrapped(loose(ball, 0.2 * kMm, draw), 5 * kMm);
  EXPECT_NEAR(skin.volume, exact, exact * kMostOff);
  EXPECT_THAT(skin.warnings, ElementsAre());
}

// With the usual offset a plate of 4 mm would be 25 % too thick. A plate of 1 mm is 10 % too thick
// even with the smaller offset of 0.05 mm on both sides, and this is reported with the number.
TEST(Wrap, ThinBodiesKeepTheirVolumeOrAreReported) {
  Draw draw(14);
  for (const double thickness : {4.0, 1.0, 0.3}) {
    const double a = draw.between(60, 90), b = draw.between(50, 70);
    const Mesh plate = turned(box_mesh({0, 0, 0}, Vec{a, b, thickness} * kMm), random_frame(draw));
    const double exact = a * b * thickness * 1e-9;
    const Wrapped skin = wrapped(plate, 5 * kMm);
    const double more = 0.1 / thickness;
    EXPECT_NEAR(skin.volume / exact, 1 + more, 0.025 + 0.1 * more);
    const bool told = std::ranges::any_of(skin.warnings, [](const std::string& w) {
      return w.find("than the") != std::string::npos;
    });
    EXPECT_EQ(told, more > kMostOff) << testing::PrintToString(skin.warnings);
  }
}

// By Steiner's formula: volume, plus surface times the offset; the other terms are less than a
// hundredth. A tenth of a step is less than 3 % of this block, so the skin is not made again.
TEST(Wrap, ALargeBodyHasTheUsualOffset) {
  Draw draw(16);
  const double side = draw.between(90, 110) * kMm, offset = 0.4 * kMm;
  const Mesh block = turned(box_mesh({0, 0, 0}, Vec{side, side, side}), random_frame(draw));
  const Wrapped skin = wrapped(block, 10 * offset);
  EXPECT_NEAR(skin.volume / (side * side * side), 1 + 6 * offset / side, 0.005);
  EXPECT_THAT(skin.warnings, ElementsAre());
}

// The body's own volume is known exactly, although almost no point of its box lies in it.
TEST(Wrap, AVeryThinBodyIsReported) {
  Draw draw(17);
  for (const double thickness : {0.1, 0.05, 0.02}) {
    const double a = draw.between(60, 90), b = draw.between(50, 70);
    const Mesh plate = turned(box_mesh({0, 0, 0}, Vec{a, b, thickness} * kMm), random_frame(draw));
    const Wrapped skin = wrapped(plate, 5 * kMm);
    ASSERT_FALSE(skin.warnings.empty());
    std::array<double, 3> told{};
    ASSERT_EQ(std::sscanf(skin.warnings[0].c_str(),
                          "test.off: its skin holds %lf ml, %lf %% more than the %lf ml that it",
                          &told[0], &told[1], &told[2]),
              3)
        << skin.warnings[0];
    const double exact_ml = a * b * thickness * 1e-3, skin_ml = a * b * (thickness + 0.1) * 1e-3;
    EXPECT_NEAR(told[2], exact_ml, 0.006 * exact_ml);
    EXPECT_NEAR(told[0], skin_ml, 0.05 * skin_ml);  // 0.05 mm more on both sides
  }
}

// The difference of the skin is reported to three digits.
TEST(Wrap, TheDifferenceIsReportedExactly) {
  Draw draw(19);
  for (const double thickness : {0.6, 0.2, 0.05}) {
    const double a = draw.between(60, 90), b = draw.between(50, 70);
    const Mesh plate = turned(box_mesh({0, 0, 0}, Vec{a, b, thickness} * kMm), random_frame(draw));
    const offline::Solid solid = offline::repair(plate);
    const offline::Wrapped skin =
        offline::wrap(solid, offline::content_of(solid), 5 * kMm, "plate");
    const double skin_ml =
        offline::signed_volume(skin.solid.surface.points, skin.solid.boundary, {}) * 1e6;
    const double off = skin_ml / (a * b * thickness * 1e-3) - 1;
    ASSERT_EQ(skin.warnings.size(), 1U);
    double told = 0;
    ASSERT_EQ(
        std::sscanf(skin.warnings[0].c_str(), "plate: its skin holds %*f ml, %lf %% more", &told),
        1)
        << skin.warnings[0];
    EXPECT_NEAR(told, off * 100, off * 100 * 0.00501);
  }
}

// In a mesh's own volume what two boxes share counts twice.
TEST(Wrap, BodiesThatOverlapEncloseTheirUnion) {
  Draw draw(18);
  const double a = draw.between(50, 60) * kMm, from = a / 4;
  const Mesh boxes = turned(both(box_mesh({0, 0, 0}, {a, a, a}),
                                 box_mesh({from, from, from}, Vec{from + a, from + a, from + a})),
                            random_frame(draw));
  const double exact = a * a * a * (2 - 27.0 / 64);
  const Wrapped skin = wrapped(boxes, 5 * kMm);
  EXPECT_NEAR(skin.volume, exact, exact * kMostOff);
  EXPECT_THAT(skin.warnings, ElementsAre());
}

TEST(Wrap, ASheetBecomesASlabAndIsReported) {
  Draw draw(15);
  const Mesh sheet =
      turned({{{0, 0, 0}, {0.03, 0, 0}, {0, 0.03, 0}}, {{0, 1, 2}}}, random_frame(draw));
  const Wrapped skin = wrapped(sheet, 5 * kMm);
  EXPECT_THAT(skin.warnings[0],
              HasSubstr("test.off: encloses nothing; its skin, 1 mm thick, is 0.4"));
}

// Two bodies in one file that touch in a corner of both their holes: a figure of eight, walked from
// its end or from its middle.
TEST(Holes, OfAFigureOfEightAreTwo) {
  const Mesh small = box_mesh({0, 0, 0}, {1, 1, 1}), large = box_mesh({1, 1, 0}, {3, 3, 2});
  for (Mesh mesh : {both(small, large), both(large, small)}) {
    std::erase_if(mesh.triangles, [&](const offline::Triangle& t) {
      return mesh.points[t[0]].z == 0 && mesh.points[t[1]].z == 0 && mesh.points[t[2]].z == 0;
    });
    const offline::Patched patched = offline::patch_holes(offline::repair(mesh));
    ASSERT_EQ(patched.holes.size(), 2U);
    EXPECT_DOUBLE_EQ(patched.holes[0].across, 2 * std::numbers::sqrt2);
    EXPECT_DOUBLE_EQ(patched.holes[1].across, std::numbers::sqrt2);
    EXPECT_EQ(patched.holes[0].middle, (Vec{2, 2, 0}));
    const offline::Solid closed = offline::repair(patched.mesh);
    EXPECT_TRUE(closed.closed);
    EXPECT_DOUBLE_EQ(offline::signed_volume(closed.surface.points, closed.boundary, {}), 9);
  }
}

}  // namespace
}  // namespace stylet::test
