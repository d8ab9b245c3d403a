// SPDX-License-Identifier: Apache-2.0
// Tissues that slide, with voxels of several sizes: points and grounds are those of the surfaces at
// every level, and parts press and feel as in fine voxels throughout.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>

#include "felt.h"
#include "meshes/phantom.h"
#include "offline_support.h"
#include "organ_levels.h"
#include "pipeline/slides.h"
#include "random_bodies.h"
#include "report/quality.h"
#include "session.h"
#include "state/layout.h"

namespace stylet::test {
namespace {

using offline::BuildOptions;
using offline::Mesh;
using offline::Vec;
using testing::IsEmpty;

BuildOptions sliding(double voxel_mm, const std::vector<std::string>& where,
                     const std::string& text) {
  BuildOptions options = refined(voxel_mm, where);
  options.slides = offline::parse_slides({text});
  return options;
}

// A way through a place in any direction, so many levels finer.
std::string drawn_way(Draw& draw, double reach_mm, int levels) {
  const auto place = [&] { return draw.between(-reach_mm, reach_mm); };
  return fmt::format("way:{},{},{}:{},{},{}:{}:{}", place(), place(), place(), place(), place(),
                     place(), draw.between(1, 8), levels);
}

std::string material_of(const Organ& organ, std::uint32_t voxel) {
  return organ_material(organ, organ.voxel_material[voxel]).name;
}

// Of all points: their area; and how far the farthest lies off, as `distance` says. In mm.
struct Points {
  double area_mm2 = 0, off_mm = 0;
  std::array<std::size_t, kMaxLevels> at_level{};
};
template <typename Distance>
Points points_of(const Organ& organ, const std::vector<Cube>& cubes, Distance distance) {
  Points points;
  for (const OrganSlidePoint& p : organ.slide_points) {
    const Cube& cube = cubes[p.voxel];
    const double h = edge_m(organ, cube) * 1e3;
    const Vec at = low_m(organ, cube) * 1e3 + Vec{1.0 * p.fx, 1.0 * p.fy, 1.0 * p.fz} * (h / 65535);
    points.area_mm2 += static_cast<double>(p.area) * h * h;
    points.off_mm = std::max(points.off_mm, std::abs(distance(at)));
    ++points.at_level[cube.level];
  }
  return points;
}

// How far the distances at the grounds' corners are off, mm.
template <typename Distance>
double grounds_off_mm(const Organ& organ, const std::vector<Cube>& cubes, Distance distance) {
  double off_mm = 0;
  for (const OrganSlideGround& g : organ.slide_grounds) {
    const Cube& cube = cubes[g.voxel];
    const double h = edge_m(organ, cube) * 1e3;
    for (unsigned i = 0; i < 8; ++i) {
      const Vec at =
          low_m(organ, cube) * 1e3 + Vec{1.0 * (i & 1U), 1.0 * (i >> 1U & 1U), 1.0 * (i >> 2U)} * h;
      off_mm = std::max(off_mm, std::abs(static_cast<double>(g.distance[i]) * h - distance(at)));
    }
  }
  return off_mm;
}

void expect_at_rest(const Organ& organ) {
  Session session = make_session(organ, Config{});
  for (int i = 0; i < 50; ++i) (void)tick(session.kernel, Input{});
  EXPECT_LT(view_of(session.kernel).state.head->max_displacement_m, 1e-7F);
}

// Two blocks with a plane between them in any direction, finer around any ways.
TEST(RefineSlides, PlanesInAnyDirection) {
  Draw draw(51);
  for (int round = 0; round < 8; ++round) {
    const double voxel_mm = draw.between(4, 7), half = 24, level = draw.between(-4, 4);
    const double gap = round % 3 == 2 ? 0.4 : 0;
    const auto frame = round == 0 ? std::array<Vec, 3>{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}
                                  : random_frame(draw);
    const Mesh low = turned(box_mesh({-half, -half, -20}, {half, half, level}), frame);
    const Mesh high = turned(box_mesh({-half, -half, level + gap}, {half, half, 20}), frame);
    const auto built = build_quietly(
        {input_of(low, 1e-3, "kidney"), input_of(high, 1e-3, "muscle")},
        sliding(voxel_mm, {drawn_way(draw, 20, 1), drawn_way(draw, 10, 1 + round % 2)},
                "muscle:kidney:0.2"));
    SCOPED_TRACE(testing::Message() << "round " << round << " edge " << voxel_mm);
    EXPECT_THAT(built.report.warnings, IsEmpty());
    const Organ organ = opened(built.bytes);
    EXPECT_EQ(organ.format_version, 6U);
    EXPECT_GT(organ.levels, 1);
    EXPECT_EQ(offline::lattice_pieces(organ).size(), 2U);
    EXPECT_EQ(organ.slide_bodies.size(), organ.slide_grounds.size());
    const std::vector<Cube> cubes = cubes_of(organ);
    const auto above = [&](Vec at) { return dot(at, frame[2]) - level; };
    const Points points = points_of(organ, cubes, [&](Vec at) { return above(at) - gap; });
    EXPECT_NEAR(points.area_mm2, 48 * 48, 0.02 * 48 * 48);
    EXPECT_LT(points.off_mm, 0.3 * voxel_mm);  // points are moved to voxels with samples
    EXPECT_GT(points.at_level[0], 0U);
    EXPECT_GT(points.at_level[1], 0U);
    EXPECT_LT(grounds_off_mm(organ, cubes, above), 1e-4);
    for (const OrganSlidePoint& p : organ.slide_points) {
      ASSERT_EQ(material_of(organ, p.voxel), "muscle");
      ASSERT_EQ(material_of(organ, organ.slide_grounds[p.ground].voxel), "kidney");
    }
    expect_at_rest(organ);
  }
}

// A ball in a shell, finer where a way goes through both.
TEST(RefineSlides, BallsInShells) {
  Draw draw(53);
  for (int round = 0; round < 4; ++round) {
    const double radius_mm = draw.between(16, 24), shell_mm = draw.between(4, 8);
    const auto ball = [&](double r) {
      Mesh mesh = offline::ball_phantom(2 * r * 1e-3, 2.5e-3);
      for (Vec& p : mesh.points) p = p * 1e3;
      return mesh;
    };
    Mesh shell = ball(radius_mm + shell_mm), hollow = ball(radius_mm);
    for (offline::Triangle& t : hollow.triangles) std::swap(t[1], t[2]);
    append(shell, hollow);
    const auto built = build_quietly(
        {input_of(shell, 1e-3, "muscle"), input_of(ball(radius_mm), 1e-3, "kidney")},
        sliding(draw.between(4, 6), {fmt::format("way:0,0,-40:0,3,40:{}", draw.between(3, 8))},
                "kidney:muscle"));
    SCOPED_TRACE(round);
    const Organ organ = opened(built.bytes);
    EXPECT_EQ(organ.levels, 2);
    EXPECT_EQ(offline::lattice_pieces(organ).size(), 2U);
    const std::vector<Cube> cubes = cubes_of(organ);
    const auto out = [&](Vec at) { return radius_mm - length(at); };
    const double area_mm2 = 4 * std::numbers::pi * radius_mm * radius_mm;
    EXPECT_NEAR(points_of(organ, cubes, out).area_mm2, area_mm2, 0.03 * area_mm2);
    // Hanging corners have what lies between those of the coarser voxel: an edge h bends away from
    // the ball by h^2 / 8 r, less than 0.3 mm.
    EXPECT_LT(grounds_off_mm(organ, cubes, out), 0.15 + 0.3);
    expect_at_rest(organ);
  }
}

// A lid on a floor under its weight, and a needle through both: with fine voxels around the way as
// with fine ones throughout.
struct Scene {
  offline::Built built;
  Organ organ;
};
Scene lid_on_floor(double voxel_mm, const std::vector<std::string>& where) {
  BuildOptions options = sliding(voxel_mm, where, "muscle:kidney:0.3");
  options.held = offline::parse_regions({"z<1"}, {1e-3});
  Scene scene = {build_quietly({input_of(box_mesh({0, 0, 0}, {50, 50, 22.3}), 1e-3, "kidney"),
                                input_of(box_mesh({0, 0, 22.3}, {50, 50, 40}), 1e-3, "muscle")},
                               options),
                 {}};
  scene.organ = opened(scene.built.bytes);
  return scene;
}

// The force of the contacts along z, and their mean depth.
TEST(RefineSlides, AFloorCarriesTheWeight) {
  for (const char* where : {"way:25,25,60:25,25,0:8", "box:-1,-1,-1:51,51,22:1", "surface"}) {
    const Scene scene = lid_on_floor(5, {where});
    Config config;
    config.gravity_m_per_s2 = {0, 0, -9.81F};
    Session session = make_session(scene.organ, config);
    for (int i = 0; i < 3000; ++i) (void)tick(session.kernel, Input{});
    const View view = view_of(session.kernel);
    double force_n = 0, weight_n = 0;
    for (std::uint32_t i = 0; i < view.model.head->counts.slide_points; ++i) {
      const SlideContact& c = view.scratch.slide_contact[i];
      const SlideState& own = view.state.slide[i];
      if (!(c.depth_m > 0)) continue;
      force_n += static_cast<double>(own.stiffness_n_per_m) *
                 static_cast<double>(c.depth_m * c.slope.z - own.stretch_m.z);
    }
    const std::vector<Cube> cubes = cubes_of(scene.organ);
    for (std::uint32_t v = 0; v < cubes.size(); ++v) {
      const Material material = organ_material(scene.organ, scene.organ.voxel_material[v]);
      if (std::string(material.name) != "muscle") continue;
      weight_n += 9.81 * static_cast<double>(material.density_kg_per_m3) *
                  scene.organ.voxel_fill[v] / 255 * std::pow(edge_m(scene.organ, cubes[v]), 3);
    }
    EXPECT_NEAR(force_n, weight_n, 0.01 * weight_n) << where;
  }
}

std::vector<Vec3> felt_n(const Scene& scene) {
  Config config;
  config.needle[0].unit_m = 2.5e-3F;
  config.substeps = 8;  // as in refine_kernel_test.cpp
  Session session = make_session(scene.organ, config);
  const Script script = {{0.0253F, 0.0263F, 0.04F}, config.needle[0].length_m};
  return felt_n(session.kernel, script);
}

TEST(RefineSlides, ANeedleCrossesBothParts) {
  const std::vector<Vec3> fine = felt_n(lid_on_floor(2.5, {}));
  EXPECT_GT(off(felt_n(lid_on_floor(5, {})), fine), 0.05);
  EXPECT_LT(off(felt_n(lid_on_floor(5, {"way:18,23.2,45:18,23.2,5:11"})), fine), 0.05);
}

}  // namespace
}  // namespace stylet::test
