// SPDX-License-Identifier: Apache-2.0
// Membranes in an organ: every triangle is listed wherever it is, areas are those of the surface,
// and a user is told of what no needle would find.
#include "asset/membranes.h"

#include <gmock/gmock.h>

#include <array>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <set>

#include "base/refusal.h"
#include "meshes/phantom.h"
#include "offline_support.h"
#include "pipeline/label_organ.h"
#include "pipeline/membranes.h"
#include "pipeline/settings.h"
#include "report/info.h"

namespace stylet::test {
namespace {

using offline::BuildOptions;
using offline::CellGrid;
using offline::Membrane;
using offline::MembraneLists;
using offline::Mesh;
using offline::Vec;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

Membrane membrane_of(Mesh mesh_m, const std::string& tissue = "dura") {
  Membrane membrane;
  membrane.from = "test.off";
  membrane.tissue = tissue;
  membrane.mesh_m = std::move(mesh_m);
  return membrane;
}

offline::Built build_quietly(const BuildOptions& options, const Mesh& body_m) {
  return offline::build({input_of(body_m, 1, "gel")}, options, [](const char*, double) {});
}

// Triangles of any size and slope; some reach out of the grid.
TEST(Membranes, EveryTriangleIsListedWhereverItIs) {
  std::mt19937_64 engine(71);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  for (int round = 0; round < 20; ++round) {
    CellGrid grid = {
        {between(-1, 1), between(-1, 1), between(-1, 1)}, between(1e-3, 8e-3), {9, 7, 8}};
    Mesh mesh;
    for (int i = 0; i < 60; ++i) {
      mesh.points.push_back(grid.origin_m +
                            Vec{between(-3, 12), between(-3, 10), between(-3, 11)} * grid.edge_m);
      if (i % 3 == 2) {
        const auto last = static_cast<std::uint32_t>(i);
        mesh.triangles.push_back({last - 2, last - 1, last});
      }
    }
    const MembraneLists lists = offline::list_membranes({{mesh, 5}}, grid);
    std::map<std::array<int, 3>, std::set<std::array<std::uint32_t, 3>>> listed;
    double area = 0;
    for (const OrganMembraneCell& c : lists.cells) {
      EXPECT_EQ(c.material, 5);
      area += static_cast<double>(c.area);
      for (std::uint32_t i = c.first; i < c.first + c.count; ++i) {
        const OrganTriangle& t = lists.triangles[i];
        listed[{c.x, c.y, c.z}].insert({t.a, t.b, t.c});
      }
    }
    // Places drawn on the triangles: those in the grid lie in a cell that lists their triangle,
    // and their part is the part of the area.
    double inside = 0;
    constexpr int kPlaces = 2000;
    for (const offline::Triangle& t : mesh.triangles) {
      const Vec a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
      const double part = offline::length(cross(b - a, c - a)) / 2 / kPlaces;
      for (int i = 0; i < kPlaces; ++i) {
        double u = between(0, 1), v = between(0, 1);
        if (u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        const Vec at = (a + (b - a) * u + (c - a) * v - grid.origin_m) * (1 / grid.edge_m);
        const std::array<int, 3> cell = {static_cast<int>(std::floor(at.x)),
                                         static_cast<int>(std::floor(at.y)),
                                         static_cast<int>(std::floor(at.z))};
        bool in_grid = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          in_grid = in_grid && cell[axis] >= 0 && cell[axis] < static_cast<int>(grid.size[axis]);
        }
        if (!in_grid) continue;
        inside += part;
        ASSERT_TRUE(listed[cell].contains({t[0], t[1], t[2]}));
      }
    }
    EXPECT_NEAR(area * grid.edge_m * grid.edge_m / inside, 1, 0.02);  // of 40 000 places
  }
}

TEST(Membranes, TheAreaInTheOrganIsThatOfTheSurface) {
  const double radius = 11e-3;
  Mesh ball = offline::ball_phantom(2 * radius, 2e-3);
  for (Vec& p : ball.points) p = p + Vec{30e-3, 1e-3, -2e-3};
  BuildOptions options;
  options.voxel_edge_m = 4e-3;
  options.membranes = {membrane_of(ball)};
  const offline::Built built =
      build_quietly(options, offline::block_phantom({60e-3, 50e-3, 50e-3}, 5e-3));
  EXPECT_THAT(built.report.warnings, IsEmpty());
  Organ organ;
  ASSERT_EQ(organ_open(built.bytes, organ), Status::kOk);
  EXPECT_EQ(organ.format_version, 3U);
  double squares = 0;
  for (const OrganMembraneCell& c : organ.membrane_cells) {
    EXPECT_STREQ(organ_material(organ, c.material).name, "dura");
    squares += static_cast<double>(c.area);
  }
  EXPECT_NEAR(squares * 16e-6, offline::area_m2(ball), 1e-5 * offline::area_m2(ball));
  EXPECT_THAT(
      offline::organ_text(offline::organ_facts(organ, built.bytes)),
      testing::ContainsRegex("\nmembrane      dura +[0-9]+ cells .* \\(cells of 4 mm\\)\n"));
  EXPECT_NEAR(offline::area_m2(ball), 4 * std::numbers::pi * radius * radius, 2e-5);
}

// Without membranes an organ is what it was, also its version.
TEST(Membranes, AnOrganWithoutThemHasTheVersionBefore) {
  BuildOptions options;
  const offline::Built built =
      build_quietly(options, offline::block_phantom({60e-3, 50e-3, 50e-3}, 5e-3));
  Organ organ;
  ASSERT_EQ(organ_open(built.bytes, organ), Status::kOk);
  EXPECT_EQ(organ.format_version, 2U);
  EXPECT_TRUE(organ.membrane_cells.empty());
}

TEST(Membranes, WhatNoNeedleWouldFindIsTold) {
  const Mesh body = offline::block_phantom({60e-3, 50e-3, 50e-3}, 5e-3);
  BuildOptions options;
  Mesh ball = offline::ball_phantom(30e-3, 2e-3);  // half of it lies before the block
  options.membranes = {membrane_of(ball)};
  EXPECT_THAT(build_quietly(options, body).report.warnings,
              Contains(HasSubstr("% of its 28.2 cm2 lie outside all tissue")));
  for (Vec& p : ball.points) p = p + Vec{-1, 0, 0};
  options.membranes = {membrane_of(ball)};
  EXPECT_THAT(refusal_of([&] { (void)build_quietly(options, body); }),
              HasSubstr("no part of it lies in the organ"));
}

TEST(Membranes, WhatIsNotMeantIsTold) {
  const Mesh body = offline::block_phantom({60e-3, 50e-3, 50e-3}, 5e-3);
  const auto warnings = [&](const Membrane& membrane) {
    BuildOptions options;
    options.membranes = {membrane};
    return build_quietly(options, body).report.warnings;
  };
  Mesh tiny = offline::ball_phantom(30e-6, 2e-6);  // in the wrong unit
  for (Vec& p : tiny.points) p = p + Vec{30e-3, 1e-3, -2e-3};
  EXPECT_THAT(warnings(membrane_of(tiny)), Contains(HasSubstr("check --units")));
  Mesh ball = offline::ball_phantom(20e-3, 2e-3);
  for (Vec& p : ball.points) p = p + Vec{30e-3, 1e-3, -2e-3};
  EXPECT_THAT(warnings(membrane_of(ball, "epidural_fat")),
              Contains(HasSubstr("it holds no needle")));
  // Every triangle again, turned over, with points of its own.
  Mesh twice = ball;
  for (const offline::Triangle& t : ball.triangles) {
    const auto first = static_cast<std::uint32_t>(twice.points.size());
    for (const std::uint32_t i : {t[0], t[2], t[1]}) twice.points.push_back(ball.points[i]);
    twice.triangles.push_back({first, first + 1, first + 2});
  }
  const auto triangles = [&](const Mesh& mesh) {
    BuildOptions options;
    options.membranes = {membrane_of(mesh)};
    Organ organ;
    const offline::Built built = build_quietly(options, body);
    EXPECT_EQ(organ_open(built.bytes, organ), Status::kOk);
    return organ.membrane_triangles.size();
  };
  EXPECT_EQ(triangles(twice), triangles(ball));
}

// A scan of a million triangles must not make a tick dearer than another.
TEST(Membranes, ASurfaceThatIsTooFineIsSimplified) {
  Mesh ball = offline::ball_phantom(8e-3, 0.3e-3);
  for (Vec& p : ball.points) p = p + Vec{30e-3, 1e-3, -2e-3};
  ASSERT_GT(ball.triangles.size(), 4000U);
  BuildOptions options;
  options.voxel_edge_m = 6e-3;
  options.membranes = {membrane_of(ball)};
  const offline::Built built =
      build_quietly(options, offline::block_phantom({60e-3, 50e-3, 50e-3}, 5e-3));
  Organ organ;
  ASSERT_EQ(organ_open(built.bytes, organ), Status::kOk);
  for (const OrganPoint& p : organ.membrane_points) {
    const Vec at = {static_cast<double>(p.x) - 30e-3, static_cast<double>(p.y) - 1e-3,
                    static_cast<double>(p.z) + 2e-3};
    EXPECT_NEAR(offline::length(at) * 1e3, 4, 0.1);
  }
  EXPECT_THAT(built.report.warnings, IsEmpty());
}

TEST(Membranes, TextsThatCannotBeMeantAreRefused) {
  const auto parsed = [](const std::string& text) {
    return refusal_of([&] { (void)offline::parse_membranes({text}, {1e-3}); });
  };
  for (const char* text : {"dura", "x=:dura", "x=1mm:dura", "x=nan:dura", "x=12:", ":dura"}) {
    EXPECT_THAT(parsed(text), HasSubstr("expected MESH:TISSUE, or x=MM:TISSUE")) << text;
  }
  EXPECT_THAT(parsed("no-such.stl:dura"), HasSubstr("no-such.stl"));
  const std::vector<Membrane> planes = offline::parse_membranes({"y=-2.5:dura"}, {1e-3});
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_TRUE(planes[0].is_plane);
  EXPECT_EQ(planes[0].axis, 1U);
  EXPECT_EQ(planes[0].at_m, -2.5e-3);
  offline::Settings settings;
  settings.membranes = {"x=1:no_such_tissue"};
  EXPECT_THAT(refusal_of([&] { (void)offline::common_options(settings, {1e-3}); }),
              HasSubstr("no_such_tissue"));
}

// Of a label's faces only those on other tissue, not those on nothing: there the organ ends.
TEST(Membranes, ALabelIsBorderedWhereItMeetsOtherTissue) {
  offline::LabelMap map;
  map.size = {24, 20, 20};
  map.step_m = {Vec{1e-3, 0, 0}, Vec{0, 1e-3, 0}, Vec{0, 0, 1e-3}};
  for (std::uint32_t i = 0; i < 24 * 20 * 20; ++i) {
    map.label.push_back(i % 24 < 11 ? std::uint16_t{1} : std::uint16_t{2});
  }
  offline::Recipe recipe;
  recipe.groups = {{"epidural_fat", {1}}, {"muscle", {2}}};
  recipe.membranes = {{"dura", {2}}};
  BuildOptions options;
  options.voxel_edge_m = 3e-3;
  const offline::Built built =
      offline::build_labels("map.nrrd", map, recipe, options, [](const char*, double) {});
  Organ organ;
  ASSERT_EQ(organ_open(built.bytes, organ), Status::kOk);
  double squares = 0;
  for (const OrganMembraneCell& c : organ.membrane_cells) squares += static_cast<double>(c.area);
  EXPECT_NEAR(squares * 9e-6, 20e-3 * 20e-3, 0.1 * 20e-3 * 20e-3);  // its rim is rounded
  for (const OrganPoint& p : organ.membrane_points) {
    EXPECT_NEAR(static_cast<double>(p.x), 10.5e-3, 1e-5);  // between the middles of 10 and 11
  }
}

}  // namespace
}  // namespace stylet::test
