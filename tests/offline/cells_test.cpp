// SPDX-License-Identifier: Apache-2.0
// Decisions for each cell, on random cells, against their definitions: which gaps are filled, in
// which layer a cell lies, what is cut away and which corners are held, and where tissues of a map
// meet.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <set>

#include "offline_support.h"
#include "pipeline/label_organ.h"
#include "random_bodies.h"
#include "voxels/attach.h"
#include "voxels/crop.h"
#include "voxels/gaps.h"
#include "voxels/layers.h"

namespace stylet::test {
namespace {

using offline::Claims;
using offline::Grid;
using offline::Vec;

constexpr std::uint64_t kAll = ~std::uint64_t{0};

struct At {
  int x, y, z;
};

template <typename Visit>
void each_in(At low, At behind, Visit visit) {
  for (int z = low.z; z < behind.z; ++z) {
    for (int y = low.y; y < behind.y; ++y) {
      for (int x = low.x; x < behind.x; ++x) visit(At{x, y, z});
    }
  }
}

// Visits the cells of a grid, or with `more` of 1 its corners, x fastest.
template <typename Visit>
void each_of(const Grid& grid, int more, Visit visit) {
  const auto& size = grid.size;
  each_in({0, 0, 0},
          {static_cast<int>(size[0]) + more, static_cast<int>(size[1]) + more,
           static_cast<int>(size[2]) + more},
          visit);
}

std::uint64_t inside_at(const Claims& claims, At at) {
  const auto& size = claims.grid.size;
  const auto x = static_cast<std::uint32_t>(at.x), y = static_cast<std::uint32_t>(at.y),
             z = static_cast<std::uint32_t>(at.z);
  if (x >= size[0] || y >= size[1] || z >= size[2]) return 0;  // also below 0
  return claims.inside[offline::cell_index(claims.grid, x, y, z)];
}

// By the definition of closing: a cell stays empty if some cube, one cell wider than the gap,
// contains it and no organ.
bool is_closed(const Claims& claims, At at, int gap) {
  bool closed = true;
  each_in({at.x - gap, at.y - gap, at.z - gap}, {at.x + 1, at.y + 1, at.z + 1}, [&](At low) {
    bool meets = false;
    each_in(low, {low.x + gap + 1, low.y + gap + 1, low.z + gap + 1},
            [&](At cell) { meets = meets || inside_at(claims, cell) != 0; });
    closed = closed && meets;
  });
  return closed;
}

Claims drawn_claims(Draw& draw) {
  const auto side = [&] { return static_cast<std::uint32_t>(3 + draw.below(6)); };
  Claims claims = offline::no_claims({{}, draw.between(0.001, 0.01), {side(), side(), side()}});
  const std::size_t empty = 1 + draw.below(4);
  for (std::uint64_t& inside : claims.inside) {
    if (draw.below(empty + 1) == 0) inside = draw.coin() ? kAll : 1 + draw.below(1U << 30U);
  }
  return claims;
}

TEST(Gaps, AreWhereNoWiderCubeFitsBetweenOrgans) {
  Draw draw(51);
  std::size_t filled = 0, enclosed = 0;
  for (int round = 0; round < 120; ++round) {
    const Claims before = drawn_claims(draw);
    const int gap = static_cast<int>(draw.below(4));
    // Widths count in whole cells, also one that rounding has made a little less than a cell.
    const double width = gap + (draw.coin() ? draw.between(0, 0.99) : draw.between(-1e-6, 1e-6));
    Claims claims = before;
    const std::size_t added = offline::fill_gaps(claims, width * claims.grid.edge_m, 7);
    std::size_t expected_added = 0;
    std::size_t cell = 0;
    each_of(claims.grid, 0, [&](At at) {
      const bool was_empty = inside_at(before, at) == 0;
      const bool is_filled = was_empty && is_closed(before, at, gap);
      bool is_enclosed = !was_empty;
      each_in({at.x - 1, at.y - 1, at.z - 1}, {at.x + 2, at.y + 2, at.z + 2},
              [&](At other) { is_enclosed = is_enclosed && is_closed(before, other, gap); });
      const bool is_full = is_filled || is_enclosed;
      ASSERT_EQ(inside_at(claims, at), is_full ? kAll : inside_at(before, at)) << round;
      ASSERT_EQ(claims.owner[cell], is_filled ? 7 : before.owner[cell]);
      ASSERT_EQ(claims.owner_fill[cell], is_filled ? 64 : before.owner_fill[cell]);
      ++cell;
      expected_added += is_filled ? 1 : 0;
      enclosed += is_enclosed && inside_at(before, at) != kAll ? 1 : 0;
    });
    EXPECT_EQ(added, expected_added) << round;
    filled += added;
  }
  EXPECT_GT(filled, 500U);
  EXPECT_GT(enclosed, 100U);
}

// The depth of a cell is half of itself plus everything filled before it in its row, back to where
// the row last entered the tissue that layers replace.
TEST(Layers, CountWhatIsFilledFromWhereTheRowEnters) {
  Draw draw(52);
  std::array<std::size_t, 4> seen{};
  for (int round = 0; round < 60; ++round) {
    Claims claims = drawn_claims(draw);
    for (std::size_t i = 0; i < claims.inside.size(); ++i) {
      claims.owner[i] = static_cast<std::uint16_t>(draw.below(8) == 0 ? 0 : 1);
      if (draw.coin()) claims.inside[i] = kAll;
      claims.pierced[i] = draw.below(4) == 0 ? 1 : 0;
    }
    const double edge = claims.grid.edge_m;
    offline::TissueNumbers numbers;
    numbers.is_layered = {0, 1};
    numbers.course = {draw.below(3), draw.coin(), ""};
    for (std::uint8_t i = 0; i < 3; ++i) numbers.layers.push_back({draw.between(0, 2) * edge, i});
    const std::vector<std::uint8_t> layers = offline::cell_layers(claims, numbers);
    const std::size_t axis = numbers.course.axis;
    std::size_t cell = 0;
    const auto& size = claims.grid.size;
    each_of(claims.grid, 0, [&](At at) {
      const auto is_layered = [&](std::size_t i) {
        return (claims.inside[i] != 0 || claims.pierced[i] != 0) && claims.owner[i] == 1;
      };
      const auto filled = [&](std::size_t i) { return std::popcount(claims.inside[i]) / 64.0; };
      const std::size_t steps[] = {1, size[0], std::size_t{size[0]} * size[1]};
      const int places[] = {at.x, at.y, at.z};
      const int before =
          numbers.course.backwards ? static_cast<int>(size[axis]) - 1 - places[axis] : places[axis];
      double depth = 0.5 * filled(cell);
      std::size_t other = cell;
      for (int i = 0; i < before; ++i) {
        other = numbers.course.backwards ? other + steps[axis] : other - steps[axis];
        if (!is_layered(other)) break;
        depth += filled(other);
      }
      depth *= edge;
      const double first = numbers.layers[0].thickness_m;
      const double second = first + numbers.layers[1].thickness_m;
      const int layer = depth < first ? 0 : depth < second ? 1 : 2;
      const int expected = is_layered(cell) ? layer : offline::kNotLayered;
      EXPECT_EQ(layers[cell], expected) << round;
      EXPECT_EQ(offline::voxel_layer(numbers, layers, cell, 0), offline::kNotLayered);
      EXPECT_EQ(offline::voxel_layer(numbers, layers, cell, 1), is_layered(cell) ? layer : 0);
      ++seen[is_layered(cell) ? static_cast<std::size_t>(layer) : 3];
      ++cell;
    });
  }
  for (const std::size_t count : seen) EXPECT_GT(count, 500U);
}

TEST(Layers, AreAbsentWhereNoneWereGiven) {
  Draw draw(53);
  const Claims claims = drawn_claims(draw);
  offline::TissueNumbers numbers;
  numbers.is_layered = {1};
  EXPECT_TRUE(offline::cell_layers(claims, numbers).empty());
  EXPECT_EQ(offline::voxel_layer(numbers, {}, 0, 0), offline::kNotLayered);
}

// In a layer thicker than a voxel the membrane's stiffness is part of the modulus.
TEST(Layers, CarryTheirMembraneOnceWhereTheyAreThickerThanAVoxel) {
  offline::Tissue skin;
  skin.youngs_modulus_pa = 1e5;
  skin.membrane_n_per_m = 2e3;
  for (const double thickness : {0.004, 0.005, 0.006}) {
    const offline::Tissue in_it = offline::in_layer(skin, thickness, 0.005);
    const bool spread = thickness > 0.005;
    EXPECT_EQ(in_it.membrane_n_per_m, spread ? 0 : 2e3);
    EXPECT_NEAR(in_it.youngs_modulus_pa, spread ? 1e5 + 2e3 / 0.006 : 1e5, 1e-6);
  }
}

// A region as users write it; whether it contains a point is found by comparing numbers.
struct DrawnRegion {
  std::string text;
  std::function<bool(Vec, double slack_m)> holds;
};

// Position of the border along an axis: anywhere, or through corners of the grid up to rounding.
double drawn_bound(Draw& draw, const Grid& grid, std::size_t axis) {
  const auto cells = static_cast<double>(grid.size[axis]);
  const double at = draw.coin()
                        ? draw.between(0, cells)
                        : std::floor(draw.between(0, cells + 1)) + draw.between(-1e-6, 1e-6);
  return grid.origin_m[axis] + at * grid.edge_m;
}

std::string in_mm(double metres) {
  return fmt::format("{:.17g}", metres * 1000);
}

DrawnRegion drawn_box(Draw& draw, const Grid& grid) {
  std::array<double, 3> low{}, high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = drawn_bound(draw, grid, axis);
    high[axis] = drawn_bound(draw, grid, axis);
    if (low[axis] > high[axis]) std::swap(low[axis], high[axis]);
  }
  const std::string text =
      fmt::format("box:{},{},{},{},{},{}", in_mm(low[0]), in_mm(low[1]), in_mm(low[2]),
                  in_mm(high[0]), in_mm(high[1]), in_mm(high[2]));
  return {text, [=](Vec p, double slack_m) {
            bool is_in = true;
            for (std::size_t axis = 0; axis < 3; ++axis) {
              is_in = is_in && p[axis] > low[axis] - slack_m && p[axis] < high[axis] + slack_m;
            }
            return is_in;
          }};
}

DrawnRegion drawn_region(Draw& draw, const Grid& grid, const offline::Box& extent) {
  if (draw.below(3) == 0) return drawn_box(draw, grid);
  const std::size_t axis = draw.below(3);
  const bool above = draw.coin(), in_percent = draw.coin();
  const double bound = drawn_bound(draw, grid, axis);
  const double percent = 100 * (bound - extent.low[axis]) / (extent.high[axis] - extent.low[axis]);
  const std::string number = in_percent ? fmt::format("{:.17g}%", percent) : in_mm(bound);
  return {fmt::format("{}{}{}", "xyz"[axis], above ? '>' : '<', number),
          [=](Vec p, double slack_m) {
            return above ? p[axis] > bound - slack_m : p[axis] < bound + slack_m;
          }};
}

// A grid with random regions.
struct DrawnRegions {
  Claims claims;
  offline::Box extent;
  std::vector<DrawnRegion> regions;
  std::vector<std::string> texts;
};

DrawnRegions drawn_regions(Draw& draw) {
  DrawnRegions drawn{drawn_claims(draw), {}, {}, {}};
  Grid& grid = drawn.claims.grid;
  grid.origin_m = {draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)};
  for (const double part : {draw.between(0, 0.3), draw.between(0.7, 1)}) {
    offline::grow(drawn.extent, grid.origin_m + Vec{part * grid.size[0], part * grid.size[1],
                                                    part * grid.size[2]} *
                                                    grid.edge_m);
  }
  for (std::size_t i = 1 + draw.below(3); i > 0; --i) {
    drawn.regions.push_back(drawn_region(draw, grid, drawn.extent));
    drawn.texts.push_back(drawn.regions.back().text);
  }
  return drawn;
}

Vec place_of(const Grid& grid, At at, double offset) {
  return grid.origin_m + Vec{at.x + offset, at.y + offset, at.z + offset} * grid.edge_m;
}

// Corners that touch a border up to rounding are held; with several regions, those of each of them.
TEST(Regions, HoldTheCornersInAnyOfThem) {
  Draw draw(54);
  std::array<std::size_t, 2> seen{};
  for (int round = 0; round < 100; ++round) {
    const DrawnRegions drawn = drawn_regions(draw);
    const Grid& grid = drawn.claims.grid;
    const std::vector<std::uint8_t> held =
        offline::held_corners(grid, drawn.extent, offline::parse_regions(drawn.texts, {1}));
    std::size_t corner = 0;
    each_of(grid, 1, [&](At at) {
      bool expected = false;
      for (const DrawnRegion& each : drawn.regions) {
        expected = expected || each.holds(place_of(grid, at, 0), 2e-6 * grid.edge_m);
      }
      EXPECT_EQ(held[corner++] != 0, expected) << testing::PrintToString(drawn.texts);
      ++seen[expected ? 1 : 0];
    });
    EXPECT_EQ(held.size(), corner);
  }
  EXPECT_GT(std::min(seen[0], seen[1]), 1000U);
}

// A cell is cut away if its middle lies outside one of the regions; corners of remaining cells are
// held there.
TEST(Regions, CutAwayTheCellsNotInAllOfThem) {
  Draw draw(55);
  std::array<std::size_t, 2> seen{};
  for (int round = 0; round < 100; ++round) {
    const DrawnRegions drawn = drawn_regions(draw);
    const Grid& grid = drawn.claims.grid;
    const std::vector<std::uint8_t> cut =
        offline::cut_cells(grid, drawn.extent, offline::parse_crop(drawn.texts));
    std::vector<std::uint8_t> held(
        std::size_t{grid.size[0] + 1} * (grid.size[1] + 1) * (grid.size[2] + 1), 0);
    std::vector<std::uint8_t> expected_held = held;
    offline::hold_cut(drawn.claims, cut, held);
    std::size_t cell = 0;
    each_of(grid, 0, [&](At at) {
      bool stays = true;
      for (const DrawnRegion& each : drawn.regions) {
        stays = stays && each.holds(place_of(grid, at, 0.5), 0);
      }
      EXPECT_EQ(cut[cell] != 0, !stays) << testing::PrintToString(drawn.texts);
      const bool holds = !stays && drawn.claims.inside[cell] != 0;
      each_in(at, {at.x + 2, at.y + 2, at.z + 2}, [&](At corner) {
        std::uint8_t& at_corner =
            expected_held[static_cast<std::size_t>(corner.x) +
                          (grid.size[0] + 1) *
                              (static_cast<std::size_t>(corner.y) +
                               (grid.size[1] + 1) * static_cast<std::size_t>(corner.z))];
        if (holds) at_corner = 1;
      });
      ++cell;
      ++seen[stays ? 1 : 0];
    });
    EXPECT_EQ(held, expected_held);
  }
  EXPECT_GT(std::min(seen[0], seen[1]), 1000U);
}

TEST(Regions, KeepTheTrianglesInsideTheRemainingCells) {
  Draw draw(56);
  std::size_t left = 0;
  for (int round = 0; round < 50; ++round) {
    const DrawnRegions drawn = drawn_regions(draw);
    const Grid& grid = drawn.claims.grid;
    offline::Mesh mesh;
    const auto coordinate = [&](std::size_t axis) { return draw.between(0, grid.size[axis]); };
    for (int i = 0; i < 40; ++i) {
      mesh.points.push_back(grid.origin_m +
                            Vec{coordinate(0), coordinate(1), coordinate(2)} * grid.edge_m);
    }
    const auto corner = [&] { return static_cast<std::uint32_t>(draw.below(40)); };
    for (int i = 0; i < 100; ++i) mesh.triangles.push_back({corner(), corner(), corner()});
    const std::vector<std::uint8_t> cut =
        offline::cut_cells(grid, drawn.extent, offline::parse_crop(drawn.texts));
    const offline::Mesh part = offline::crop_surface(mesh, grid, cut);
    std::set<std::uint32_t> used;
    std::size_t triangle = 0;
    for (const offline::Triangle& t : mesh.triangles) {
      const auto is_cut = [&](std::uint32_t i) {
        return cut[offline::cell_of(grid, mesh.points[i])] != 0;
      };
      if (is_cut(t[0]) || is_cut(t[1]) || is_cut(t[2])) continue;
      ASSERT_LT(triangle, part.triangles.size());
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t point = part.triangles[triangle][i];
        ASSERT_LT(point, part.points.size());
        EXPECT_EQ(offline::length(part.points[point] - mesh.points[t[i]]), 0);
        used.insert(t[i]);
      }
      ++triangle;
    }
    EXPECT_EQ(part.triangles.size(), triangle);
    EXPECT_EQ(part.points.size(), used.size());
    left += triangle;
  }
  EXPECT_GT(left, 100U);
}

// A map of two labels, with four of its voxels along each edge of a cell. If the labels meet within
// cells, the plane between their tissues lies on faces of the map's voxels.
TEST(Mixed, TissuesOfAMapMeetAtItsFaces) {
  Draw draw(57);
  constexpr double kStep = 0x1p-9;  // of the map; exact as a float, as is the edge of cells
  for (int round = 0; round < 12; ++round) {
    offline::LabelMap map;
    const auto size = [&] { return static_cast<std::uint32_t>(8 + 4 * draw.below(3)); };
    map.size = {size(), size(), size()};
    map.step_m = {Vec{kStep, 0, 0}, Vec{0, kStep, 0}, Vec{0, 0, kStep}};
    map.origin_m = Vec{0.5, 7.5, -3.5} * kStep;
    const std::size_t axis = draw.below(3);
    const auto before = static_cast<std::uint32_t>(5 + draw.below(3));  // 1 to 3 in the second cell
    for (std::uint32_t z = 0; z < map.size[2]; ++z) {
      for (std::uint32_t y = 0; y < map.size[1]; ++y) {
        for (std::uint32_t x = 0; x < map.size[0]; ++x) {
          const std::uint32_t at[] = {x, y, z};
          map.label.push_back(at[axis] < before ? 1 : 2);
        }
      }
    }
    offline::Recipe recipe;
    recipe.groups = {{"liver", {1}}, {"kidney", {2}}};
    recipe.smoothing = 0;
    offline::BuildOptions options;
    options.voxel_edge_m = 4 * kStep;
    const offline::Built built =
        offline::build_labels("map.nrrd", map, recipe, options, [](const char*, double) {});
    const Organ organ = opened(built.bytes);
    std::size_t found = 0;
    for (const OrganMixed& mixed : organ.mixed) {
      const float normal[] = {mixed.nx, mixed.ny, mixed.nz};
      EXPECT_NEAR(std::abs(normal[axis]), 1, 1e-6) << round;
      EXPECT_NEAR(normal[(axis + 1) % 3], 0, 1e-6) << round;
      EXPECT_NEAR(normal[(axis + 2) % 3], 0, 1e-6) << round;
      EXPECT_NEAR(mixed.limit * normal[axis], (before - 4) * 0.25, 1e-6) << round;
      EXPECT_EQ(organ_material(organ, mixed.material).name == std::string("kidney"),
                normal[axis] > 0);
      ++found;
    }
    EXPECT_EQ(found, map.size[(axis + 1) % 3] / 4 * (map.size[(axis + 2) % 3] / 4)) << round;
  }
}

}  // namespace
}  // namespace stylet::test
