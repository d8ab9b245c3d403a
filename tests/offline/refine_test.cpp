// SPDX-License-Identifier: Apache-2.0
// Voxels of several sizes: random bodies and label maps, refined in random places. What an organ
// has is read from its file by code of this test's own, and compared with the geometry.
#include "pipeline/refine.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "asset/materials.h"
#include "base/refinement.h"
#include "maps/recipe_table.h"
#include "meshes/phantom.h"
#include "offline_support.h"
#include "organ_levels.h"
#include "pipeline/label_organ.h"
#include "pipeline/settings.h"
#include "random_bodies.h"
#include "report/info.h"
#include "report/quality.h"
#include "voxels/crop.h"

namespace stylet::test {
namespace {

using offline::BuildOptions;
using offline::LabelMap;
using offline::Mesh;
using offline::Recipe;
using offline::Refinement;
using offline::Vec;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

// ---- what every organ with levels must be -------------------------------------------------------

// Cells around a cell of the finest level, itself included.
std::array<std::array<int, 3>, 27> around(const std::array<int, 3>& at) {
  std::array<std::array<int, 3>, 27> cells;
  for (int n = 0; n < 27; ++n) {
    cells[static_cast<std::size_t>(n)] = {at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1,
                                          at[2] + n / 9 - 1};
  }
  return cells;
}

void expect_balanced(const std::vector<Cube>& cubes, const CellsOf& cells) {
  for (const auto& [at, voxel] : cells) {
    for (const auto& beside : around(at)) {
      const auto other = cells.find(beside);
      if (other == cells.end()) continue;
      ASSERT_LE(cubes[other->second].level, cubes[voxel].level + 1) << at[0] << " " << at[1];
    }
  }
}

// The coarsest level with a voxel whose closed cube holds a point.
std::uint32_t coarsest_at(const std::vector<Cube>& cubes, const CellsOf& cells,
                          const std::array<int, 3>& point) {
  std::uint32_t level = 99;
  for (int n = 0; n < 8; ++n) {
    const auto found =
        cells.find({point[0] - (n & 1), point[1] - (n >> 1 & 1), point[2] - (n >> 2)});
    if (found != cells.end()) level = std::min(level, cubes[found->second].level);
  }
  return level;
}

// A node hangs if and only if a coarser voxel has it on its surface; then on one of the coarsest.
void expect_hanging(const Organ& organ, const std::vector<Cube>& cubes, const CellsOf& cells) {
  using Node = std::array<std::uint32_t, 3>;
  std::map<Node, OrganHanging> hanging;
  for (const OrganHanging& h : organ.hanging) hanging[{h.x, h.y, h.z}] = h;
  std::map<Node, const Cube*> voxels;
  for (const Cube& cube : cubes) voxels[cube.place] = &cube;
  std::set<Node> seen;
  for (const Cube& cube : cubes) {
    for (unsigned c = 0; c < 8; ++c) {
      const std::array<unsigned, 3> d = {c & 1U, c >> 1U & 1U, c >> 2U};
      Node node{};
      std::array<int, 3> point{};
      for (std::size_t a = 0; a < 3; ++a) {
        node[a] = cube.place[a] + d[a];
        point[a] = cube.low[a] + static_cast<int>(d[a]) * cube.size;
      }
      if (!seen.insert(node).second) continue;
      const std::uint32_t coarsest = coarsest_at(cubes, cells, point);
      const auto found = hanging.find(node);
      ASSERT_EQ(found != hanging.end(), coarsest < cube.level);
      if (found == hanging.end()) continue;
      const OrganHanging& h = found->second;
      const Cube& on = *voxels.at({h.voxel_x, h.voxel_y, h.voxel_z});
      EXPECT_EQ(on.level, coarsest);
      for (std::size_t a = 0; a < 3; ++a) {
        ASSERT_GE(point[a], on.low[a]);
        ASSERT_LE(point[a], on.low[a] + on.size);
      }
    }
  }
  EXPECT_TRUE(std::ranges::all_of(hanging, [&](const auto& h) { return seen.contains(h.first); }));
}

// The same surface as that of an organ of one level, to the quantum of both.
void expect_same_surface(const Organ& organ, const std::vector<Cube>& cubes, const Organ& one) {
  const std::vector<Cube> of_one = cubes_of(one);
  ASSERT_EQ(organ.vertices.size(), one.vertices.size());
  ASSERT_EQ(organ.triangles.size(), one.triangles.size());
  const double quantum_m = static_cast<double>(one.voxel_edge_m) / 65535;
  for (std::size_t i = 0; i < one.vertices.size(); ++i) {
    const Vec off =
        vertex_m(organ, cubes, organ.vertices[i]) - vertex_m(one, of_one, one.vertices[i]);
    ASSERT_LE(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}), 1.01 * quantum_m);
  }
}

void expect_sound(const Organ& organ) {
  const std::vector<Cube> cubes = cubes_of(organ);
  ASSERT_EQ(cubes.size(), organ.voxel_count);
  const CellsOf cells = finest_cells(cubes);
  expect_balanced(cubes, cells);
  expect_hanging(organ, cubes, cells);
}

// ---- random bodies ------------------------------------------------------------------------------

Mesh ellipsoid(Draw& draw, double facet_m = 4e-3) {
  Mesh mesh = offline::ball_phantom(0.03, facet_m);
  const Vec by = {draw.between(0.5, 1.4), draw.between(0.5, 1.4), draw.between(0.5, 1.4)};
  for (Vec& p : mesh.points) p = {p.x * by.x, p.y * by.y, p.z * by.z};
  mesh = turned(mesh, random_frame(draw));
  const Vec to = {draw.between(-0.01, 0.01), draw.between(-0.01, 0.01), draw.between(-0.01, 0.01)};
  for (Vec& p : mesh.points) p = p + to;
  return mesh;
}

std::string shown(Vec mm) {
  return fmt::format("{:.3f},{:.3f},{:.3f}", mm.x, mm.y, mm.z);
}

Vec drawn_place(Draw& draw) {  // mm, also outside the bodies
  return {draw.between(-22, 22), draw.between(-22, 22), draw.between(-22, 22)};
}

std::string drawn_refinement(Draw& draw) {
  const std::size_t levels = 1 + draw.below(3);
  if (draw.coin()) {
    const Vec from = drawn_place(draw), to = drawn_place(draw);
    return fmt::format("way:{}:{}:{:.2f}:{}", shown(from), shown(to), draw.between(0.1, 6), levels);
  }
  const Vec low = drawn_place(draw);
  const Vec size = {draw.between(1, 20), draw.between(1, 20), draw.between(1, 20)};
  return fmt::format("box:{}:{}:{}", shown(low), shown(low + size), levels);
}

// How near, in mm, a cube comes to a way or box; by dense places of both. 0: it meets it.
double distance_mm(const Refinement& r, Vec low_mm, double edge_mm) {
  const auto to_cube = [&](Vec at) {
    double sum = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      sum += std::pow(at[a] - std::clamp(at[a], low_mm[a], low_mm[a] + edge_mm), 2);
    }
    return std::sqrt(sum);
  };
  if (r.kind == Refinement::Kind::kBox) {
    double most = 0;  // of the gaps along the axes
    for (std::size_t a = 0; a < 3; ++a) {
      most = std::max({most, r.from_mm[a] - low_mm[a] - edge_mm, low_mm[a] - r.to_mm[a]});
    }
    return most;
  }
  double least = 1e9;
  for (int i = 0; i <= 400; ++i) {
    least = std::min(least, to_cube(r.from_mm + (r.to_mm - r.from_mm) * (i / 400.0)));
  }
  return std::max(0.0, least - r.radius_mm);
}

// Where it is asked for, voxels are as fine as that or finer; and a voxel is finer than the
// coarsest only if its place was asked for, or if it lies beside one that is finer by one more.
void expect_where_asked(const Organ& organ, const std::vector<Refinement>& asked) {
  const std::vector<Cube> cubes = cubes_of(organ);
  const CellsOf cells = finest_cells(cubes);
  constexpr double kNearMm = 0.02;  // of the dense places
  for (const Cube& cube : cubes) {
    const double edge_mm = edge_m(organ, cube) * 1e3;
    Cube whole = cube;  // the cell that was split for this voxel
    whole.size *= 2;
    for (int& each : whole.low) each -= each % whole.size;
    bool wanted = cube.level == 0;
    for (const Refinement& r : asked) {
      if (cube.level < r.levels) {
        EXPECT_GT(distance_mm(r, low_m(organ, cube) * 1e3, edge_mm), -1e-9);
        EXPECT_GT(distance_mm(r, low_m(organ, cube) * 1e3, edge_mm) + kNearMm, kNearMm / 2);
      } else {
        wanted = wanted || distance_mm(r, low_m(organ, whole) * 1e3, 2 * edge_mm) < kNearMm;
      }
    }
    const int reach = cube.size;
    for (int x = -reach; x < whole.size + reach && !wanted; ++x) {
      for (int y = -reach; y < whole.size + reach && !wanted; ++y) {
        for (int z = -reach; z < whole.size + reach && !wanted; ++z) {
          const auto at = cells.find({whole.low[0] + x, whole.low[1] + y, whole.low[2] + z});
          wanted = at != cells.end() && cubes[at->second].level > cube.level;
        }
      }
    }
    ASSERT_TRUE(wanted) << "level " << cube.level << " for nothing";
  }
}

TEST(Refine, RandomBodiesInRandomPlaces) {
  int graded = 0;
  for (unsigned seed = 1; seed <= 24; ++seed) {
    Draw draw(seed);
    SCOPED_TRACE(seed);
    const Mesh body =
        draw.coin() ? ellipsoid(draw) : box_mesh({-0.013, -0.011, -0.02}, {0.0121, 0.019, 0.009});
    std::vector<offline::Input> inputs = {input_of(body, 1, "kidney")};
    if (draw.coin()) inputs.push_back(input_of(ellipsoid(draw), 1, "fat", -1));
    std::vector<std::string> where = {drawn_refinement(draw)};
    if (draw.coin()) where.push_back(drawn_refinement(draw));
    BuildOptions options = refined(draw.between(4, 8), where);
    if (draw.coin()) options.held = offline::parse_regions({"z<20%"}, {1});
    if (draw.below(4) == 0) options.crop = offline::parse_crop({"x<4"});
    const auto built = build_quietly(inputs, options);
    const Organ organ = opened(built.bytes);
    EXPECT_EQ(organ.format_version, organ.levels > 1 ? 5U : 2U);
    graded += organ.levels > 1 ? 1 : 0;
    expect_sound(organ);
    expect_where_asked(organ, options.refinements);
    options.refinements.clear();
    const auto plain = build_quietly(inputs, options);
    const Organ one = opened(plain.bytes);
    expect_same_surface(organ, cubes_of(organ), one);
    // Each sample of the surface's cells stands for a 64th of a cell.
    EXPECT_NEAR(filled_m3(organ), volume_m3(one), 0.02 * volume_m3(one));
    if (organ.levels == 1) {
      EXPECT_THAT(built.report.warnings, Contains(HasSubstr("no voxel is finer for it")));
    }
  }
  EXPECT_GT(graded, 18);
}

TEST(Refine, TheOuterSurfaceIsFineAndTheRestIsCoarse) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Draw draw(seed);
    SCOPED_TRACE(seed);
    const auto levels = static_cast<std::uint32_t>(1 + draw.below(3));
    const auto built = build_quietly({input_of(ellipsoid(draw), 1, "kidney")},
                                     refined(6, {fmt::format("surface:{}", levels)}));
    const Organ organ = opened(built.bytes);
    ASSERT_EQ(organ.levels, levels + 1);
    expect_sound(organ);
    const std::vector<Cube> cubes = cubes_of(organ);
    for (const OrganVertex& v : organ.vertices) EXPECT_EQ(cubes[v.voxel].level, levels);
    for (std::size_t i = 0; i < cubes.size(); ++i) {
      EXPECT_TRUE(cubes[i].level == levels || organ.voxel_fill[i] == 255);
    }
    EXPECT_NEAR(filled_m3(organ), built.report.inputs[0].mesh_volume_m3,
                0.003 * built.report.inputs[0].mesh_volume_m3);
  }
}

// ---- label maps ---------------------------------------------------------------------------------

struct DrawnMap {
  LabelMap map;
  Recipe recipe;
};

// Balls of tissues in one another, voxels of about 1 mm, in an odd frame.
DrawnMap drawn_map(Draw& draw, std::size_t tissues) {
  static const char* const kNames[] = {"kidney", "tumour", "vessel"};
  DrawnMap drawn;
  LabelMap& map = drawn.map;
  for (std::uint32_t& each : map.size) each = static_cast<std::uint32_t>(23 + draw.below(9));
  map.step_m = {Vec{draw.between(0.9e-3, 1.3e-3), 0, 0}, Vec{0, draw.between(0.9e-3, 1.3e-3), 0},
                Vec{0, 0, draw.between(0.9e-3, 1.3e-3)}};
  map.origin_m = {draw.between(-0.1, 0.1), draw.between(-0.1, 0.1), draw.between(-0.1, 0.1)};
  map.label.assign(std::size_t{map.size[0]} * map.size[1] * map.size[2], 0);
  for (std::uint16_t label = 1; label <= tissues; ++label) {
    const double radius = label == 1 ? 10 : draw.between(1.5, 3);
    const Vec middle = {draw.between(8, 14), draw.between(8, 14), draw.between(8, 14)};
    std::size_t i = 0;
    for (std::uint32_t z = 0; z < map.size[2]; ++z) {
      for (std::uint32_t y = 0; y < map.size[1]; ++y) {
        for (std::uint32_t x = 0; x < map.size[0]; ++x, ++i) {
          const Vec at = {1.0 * x, 1.0 * y, 1.0 * z};
          if (length(at - middle) < radius) map.label[i] = label;
        }
      }
    }
    drawn.recipe.groups.push_back({kNames[label - 1], {label}});
  }
  return drawn;
}

offline::Built built_of(const DrawnMap& drawn, const BuildOptions& options) {
  return offline::build_labels("map.nrrd", drawn.map, drawn.recipe, options,
                               [](const char*, double) {});
}

// Each of the map's voxels with a label lies in a voxel of this level, and voxels of its tissue
// have about its volume.
void expect_fine_tissue(const Organ& organ, const DrawnMap& drawn, std::size_t label,
                        std::uint32_t level) {
  const LabelMap& map = drawn.map;
  const std::vector<Cube> cubes = cubes_of(organ);
  const CellsOf cells = finest_cells(cubes);
  const Vec origin_m = low_m(organ, {0, {0, 0, 0}, 1, {}});
  double label_m3 = 0, tissue_m3 = 0;
  for (std::size_t i = 0; i < map.label.size(); ++i) {
    if (map.label[i] != label) continue;
    label_m3 += offline::voxel_volume_m3(map);
    const Vec at_m = map.origin_m + map.step_m[0] * static_cast<double>(i % map.size[0]) +
                     map.step_m[1] * static_cast<double>(i / map.size[0] % map.size[1]) +
                     map.step_m[2] * static_cast<double>(i / map.size[0] / map.size[1]);
    const Vec at = (at_m - origin_m) * (1 / finest_m(organ));
    const auto found =
        cells.find({static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)),
                    static_cast<int>(std::floor(at.z))});
    ASSERT_NE(found, cells.end());
    EXPECT_GE(cubes[found->second].level, level);
  }
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const std::string tissue = organ_material(organ, organ.voxel_material[i]).name;
    if (tissue != drawn.recipe.groups[label - 1].tissue) continue;
    EXPECT_GE(cubes[i].level, level);
    tissue_m3 += organ.voxel_fill[i] / 255.0 * std::pow(edge_m(organ, cubes[i]), 3);
  }
  EXPECT_NEAR(tissue_m3, label_m3, 0.3 * label_m3);
}

TEST(Refine, TissuesOfLabelMapsAreFine) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Draw draw(seed);
    SCOPED_TRACE(seed);
    const std::size_t tissues = 2 + draw.below(2), label = 2 + draw.below(tissues - 1);
    const DrawnMap drawn = drawn_map(draw, tissues);
    const auto levels = static_cast<std::uint32_t>(2 + draw.below(2));
    const double voxel_mm = draw.between(4, 5);
    const std::string& name = drawn.recipe.groups[label - 1].tissue;
    const auto built =
        built_of(drawn, refined(voxel_mm, {fmt::format("labels:{}:{}", name, levels)}));
    const Organ organ = opened(built.bytes);
    ASSERT_EQ(organ.levels, levels + 1);
    expect_sound(organ);
    expect_fine_tissue(organ, drawn, label, levels);
    const auto plain = built_of(drawn, refined(voxel_mm, {}));
    const Organ one = opened(plain.bytes);
    expect_same_surface(organ, cubes_of(organ), one);
    EXPECT_NEAR(filled_m3(organ), volume_m3(one), 0.02 * volume_m3(one));
  }
}

double voxels_m3(const Organ& organ, const std::string& tissue) {
  double sum = 0;
  const std::vector<Cube> cubes = cubes_of(organ);
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    if (organ_material(organ, organ.voxel_material[i]).name != tissue) continue;
    sum += organ.voxel_fill[i] / 255.0 * std::pow(edge_m(organ, cubes[i]), 3);
  }
  return sum;
}

// A cube of 30 mm, in it a ball of 3 mm.
DrawnMap map_with_tumour() {
  DrawnMap drawn;
  LabelMap& map = drawn.map;
  map.size = {60, 60, 60};
  map.step_m = {Vec{0.5e-3, 0, 0}, Vec{0, 0.5e-3, 0}, Vec{0, 0, 0.5e-3}};
  const Vec middle = {31, 29, 30};
  for (int i = 0; i < 60 * 60 * 60; ++i) {
    const Vec at = {1.0 * (i % 60), 1.0 * (i / 60 % 60), 1.0 * (i / 3600)};
    map.label.push_back(length(at - middle) < 3 ? 2 : 1);
  }
  drawn.recipe.groups = {{"muscle", {1}}, {"tumour", {2}}};
  return drawn;
}

// A tumour of 3 mm has no voxel of 5 mm, a layer of 1 mm next to none. With finer ones, where they
// are, both have as much as if all of the organ were so fine, and no warning says that they vanish.
TEST(Refine, ATumourAndALayerThatVanishHaveVoxels) {
  const auto built = [](double voxel_mm, const std::vector<std::string>& where) {
    BuildOptions options = refined(voxel_mm, where);
    options.layers = offline::parse_layers({"skin:1", "fat:3", "muscle:100"}, "--layer");
    options.layer_course = {2, true, "muscle"};
    return built_of(map_with_tumour(), options);
  };
  const auto coarse = built(5, {}), some = built(5, {"labels:tumour,skin:3"});
  const auto fine = built(0.625, {});
  const Organ of_coarse = opened(coarse.bytes), organ = opened(some.bytes);
  const Organ of_fine = opened(fine.bytes);
  expect_sound(organ);
  EXPECT_LT(organ.voxel_count, of_fine.voxel_count / 2);
  EXPECT_EQ(voxels_m3(of_coarse, "tumour"), 0);
  EXPECT_THAT(coarse.report.warnings, Contains(HasSubstr("voxels hold 0 ml (-100 %)")));
  const double skin_m3 = 0.9e-6;  // 1 mm of 30 x 30 mm
  EXPECT_LT(voxels_m3(of_coarse, "skin"), 0.3 * skin_m3);
  for (const char* tissue : {"tumour", "skin"}) {
    const double wanted_m3 = voxels_m3(of_fine, tissue);
    EXPECT_NEAR(voxels_m3(organ, tissue), wanted_m3, 0.1 * wanted_m3) << tissue;
    EXPECT_GT(wanted_m3, 0.7 * (std::string(tissue) == "skin" ? skin_m3 : 11.6e-9));
  }
  EXPECT_THAT(some.report.warnings, testing::Not(Contains(HasSubstr("-100 %"))));
}

// ---- reports ------------------------------------------------------------------------------------

TEST(Refine, ReportsCountEachLevel) {
  Draw draw(5);
  BuildOptions options = refined(6, {"way:-20,0,0:20,0,0:3:2"});
  options.held = offline::parse_regions({"z<20%"}, {1});
  options.measured = true;
  const auto built = build_quietly({input_of(ellipsoid(draw), 1, "kidney")}, options);
  const Organ organ = opened(built.bytes);
  const auto facts = offline::organ_facts(organ, built.bytes);
  std::array<std::size_t, 4> voxels{};
  std::array<double, 4> ml{};
  const std::vector<Cube> cubes = cubes_of(organ);
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    ++voxels[cubes[i].level];
    ml[cubes[i].level] += organ.voxel_fill[i] / 255.0 * std::pow(edge_m(organ, cubes[i]) * 1e2, 3);
  }
  ASSERT_EQ(facts["levels"].size(), 3U);
  for (std::size_t level = 0; level < 3; ++level) {
    const auto& told = facts["levels"][level];
    EXPECT_NEAR(told["voxel_edge_mm"].get<double>(), 6.0 / (1 << level), 1e-6);
    EXPECT_EQ(told["voxels"].get<std::size_t>(), voxels[level]);
    EXPECT_NEAR(told["volume_ml"].get<double>(), ml[level], 1e-6);
  }
  EXPECT_NEAR(facts["volume_ml"].get<double>(), filled_m3(organ) * 1e6, 1e-6);
  EXPECT_NEAR(facts["materials"][0]["volume_ml"].get<double>(), filled_m3(organ) * 1e6, 1e-6);
  EXPECT_THAT(offline::organ_text(facts), HasSubstr("level 2"));
  const auto pieces = offline::lattice_pieces(organ);
  ASSERT_EQ(pieces.size(), 1U);  // hanging nodes join the levels
  EXPECT_NEAR(pieces[0].volume_m3, filled_m3(organ), 1e-12);
  const auto quality = offline::measure_quality(organ, built.input_m, [](const char*, double) {});
  EXPECT_LT(quality.surface_to_input.most_m, 1e-6);
  EXPECT_LT(quality.faces_to_input.most_m, 6e-3 * std::sqrt(3));
}

}  // namespace
}  // namespace stylet::test
