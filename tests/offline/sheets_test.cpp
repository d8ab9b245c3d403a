// SPDX-License-Identifier: Apache-2.0
// Parts that do not touch get voxels of their own: parts that are separate in the input are
// separate in the kernel, connected ones stay connected, and bodies without gaps are built as
// without this option.
#include "voxels/sheets.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "base/refusal.h"
#include "gap_bodies.h"
#include "offline_support.h"
#include "organ_places.h"
#include "pipeline/label_organ.h"
#include "random_bodies.h"
#include "report/info.h"
#include "report/quality.h"
#include "voxels/sample_cell.h"
#include "voxels/sample_parts.h"

namespace stylet::test {
namespace {

using offline::Mesh;
using offline::Vec;

offline::BuildOptions split_at(double voxel_mm, bool split) {
  offline::BuildOptions options;
  options.voxel_edge_m = voxel_mm * 1e-3;
  options.split = split;
  return options;
}

// A body turned so that no face lies along the grid.
Mesh turned(Mesh mesh, double angle) {
  for (Vec& p : mesh.points) {
    const double c = std::cos(angle), s = std::sin(angle);
    p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z + 0.3 * p.x};
  }
  return mesh;
}

TEST(Sheets, BodiesWithoutGapsAreBuiltAsWithoutThem) {
  for (const double voxel_mm : {3.1, 5.0, 7.3}) {
    for (const Mesh& mesh : {ball(30, 24), turned(box_mesh({0, 0, 0}, {60, 40, 25}), 0.4),
                             box_mesh({0, 0, 0}, {50, 45, 40})}) {
      const auto plain = build_quietly({input_of(mesh, 1e-3)}, split_at(voxel_mm, false));
      const auto split = build_quietly({input_of(mesh, 1e-3)}, split_at(voxel_mm, true));
      EXPECT_EQ(plain.bytes, split.bytes) << voxel_mm;
    }
  }
}

TEST(Sheets, SlabsInOneVoxelAreApart) {
  const Mesh low = turned(box_mesh({0, 0, 0}, {60, 60, 12}), 0.3);
  const Mesh high = turned(box_mesh({0, 0, 14.5}, {60, 60, 26}), 0.3);
  const std::vector<offline::Input> inputs = {input_of(low, 1e-3, "liver"),
                                              input_of(high, 1e-3, "kidney")};
  const auto plain = build_quietly(inputs, split_at(5, false));
  const auto split = build_quietly(inputs, split_at(5, true));
  EXPECT_EQ(pieces_of(plain), 1U);
  EXPECT_EQ(pieces_of(split), 2U);
  const Organ organ = opened(split.bytes);
  EXPECT_NEAR(volume_m3(organ), volume_m3(opened(plain.bytes)), 0.005 * volume_m3(organ));
  EXPECT_GT(organ.voxel_count, opened(plain.bytes).voxel_count);
  EXPECT_FALSE(organ.parts.empty());
  EXPECT_THAT(offline::organ_text(offline::organ_facts(organ, split.bytes)),
              testing::HasSubstr("gaps          " + std::to_string(organ.parts.size()) +
                                 " voxels share cells"));
  offline::BuildOptions measured = split_at(5, true);
  measured.measured = true;
  const auto with = build_quietly(inputs, measured);
  EXPECT_EQ(with.bytes, split.bytes);
  EXPECT_EQ(with.report.closed_gaps, 0U);  // no gap was closed
}

// A needle straight through both slabs is in each for its thickness, and meets the gap between
// them, whichever voxel of a shared cell it is in.
TEST(Sheets, BothPartsOfACellAndTheGapHaveTheirThickness) {
  const double low_m = 12e-3, high_m = 11.5e-3;
  const std::vector<offline::Input> inputs = {
      input_of(turned(box_mesh({0, 0, 0}, {60, 60, 12}), 0.3), 1e-3, "liver"),
      input_of(turned(box_mesh({0, 0, 14.5}, {60, 60, 26}), 0.3), 1e-3, "kidney")};
  const auto built = build_quietly(inputs, split_at(5, true));
  const Organ organ = opened(built.bytes);
  double sum = 0;
  constexpr int kLines = 20;
  for (int i = 0; i < kLines; ++i) {
    const Vec from = {(20.03 + 0.71 * i) * 1e-3, (20.31 + 0.37 * i) * 1e-3, -0.02};
    const std::vector<double> lengths = lengths_along(organ, from, {0, 0, 1}, 0.08);
    for (const double error : {lengths[0] - low_m, lengths[1] - high_m}) {
      EXPECT_LT(std::abs(error), 1.5e-3) << i;  // 0.3 voxels
      sum += std::abs(error);
    }
  }
  EXPECT_LT(sum / (2 * kLines), 0.5e-3);
}

// The gap runs in every direction, through cells with a little of either body, of both, or only of
// their surfaces.
TEST(Sheets, ABallInAHollowOneIsApartAllAround) {
  Draw draw(3);
  for (int i = 0; i < 6; ++i) {
    const double radius = draw.between(17, 21), gap = draw.between(2.4, 4);
    const Mesh inner = test::turned(ball(radius, 24), random_frame(draw));
    const Mesh outer = test::turned(
        both(ball(radius + gap + 9, 24), inside_out(ball(radius + gap, 24))), random_frame(draw));
    const auto split = build_quietly({input_of(inner, 1e-3), input_of(outer, 1e-3, "kidney")},
                                     split_at(draw.between(3.5, 4.5), true));
    SCOPED_TRACE(testing::Message() << i << ": " << radius << " mm, gap " << gap);
    EXPECT_EQ(pieces_of(split), 2U);
    const double both_m3 = (volume(inner) + volume(outer)) * 1e-9;
    EXPECT_NEAR(volume_m3(opened(split.bytes)), both_m3, 0.005 * both_m3);
  }
}

// So does a gap of one to three voxels, where cells with nothing but surface lie between.
TEST(Sheets, AWideGapIsOpenAllAround) {
  Draw draw(4);
  for (int i = 0; i < 4; ++i) {
    const double gap = draw.between(2, 5);
    const Mesh inner = test::turned(ball(12, 24), random_frame(draw));
    const Mesh outer = test::turned(both(ball(12 + gap + 5, 24), inside_out(ball(12 + gap, 24))),
                                    random_frame(draw));
    const auto split = build_quietly({input_of(inner, 1e-3), input_of(outer, 1e-3, "kidney")},
                                     split_at(draw.between(1.6, 2), true));
    EXPECT_EQ(pieces_of(split), 2U) << gap;
  }
}

// Two organs of a map of 1 mm, `gap` voxels apart.
offline::LabelMap two_slabs(std::uint32_t gap) {
  offline::LabelMap map;
  map.size = {44, 44, 30};
  map.step_m = {Vec{1e-3, 0, 0}, Vec{0, 1e-3, 0}, Vec{0, 0, 1e-3}};
  for (std::uint32_t z = 0; z < map.size[2]; ++z) {
    for (std::uint32_t y = 0; y < map.size[1]; ++y) {
      for (std::uint32_t x = 0; x < map.size[0]; ++x) {
        const bool inside = std::min(x, y) >= 2 && std::max(x, y) < 42;
        const bool low = z >= 2 && z < 14, high = z >= 14 + gap && z < 28;
        map.label.push_back(static_cast<std::uint16_t>(!inside ? 0 : low ? 1 : high ? 2 : 0));
      }
    }
  }
  return map;
}

TEST(Sheets, OrgansOfAMapAreSeparateAcrossGapsAndConnectedWhereTheyTouch) {
  offline::Recipe recipe;
  recipe.groups = {{"kidney", {2}}, {"liver", {1}}};
  const auto pieces = [&](std::uint32_t gap, bool split) {
    return pieces_of(offline::build_labels("map.nrrd", two_slabs(gap), recipe, split_at(5, split),
                                           [](const char*, double) {}));
  };
  EXPECT_EQ(pieces(0, true), 1U);
  EXPECT_EQ(pieces(3, false), 1U);
  EXPECT_EQ(pieces(3, true), 2U);
}

TEST(Sheets, LobesAreConnectedOnlyAtTheirBase) {
  for (const double angle : {0.0, 0.3, 0.7}) {
    const Mesh mesh = turned(two_lobes(2.4), angle);
    const auto split = build_quietly({input_of(mesh, 1e-3)}, split_at(5, true));
    EXPECT_EQ(pieces_of(split), 1U) << angle;
    EXPECT_FALSE(opened(split.bytes).ties.empty()) << angle;
  }
}

// ---- drawn cells --------------------------------------------------------------------------------

constexpr std::uint64_t kAll = ~std::uint64_t{0};

offline::Lattice split_of(offline::Claims claims) {
  offline::SamplePlaces places;
  for (std::uint32_t i = 0; i < 64; ++i) places[i] = offline::sample_point(i);
  std::vector<offline::Claims> levels = {std::move(claims)};
  return offline::split_parts(levels, places, {offline::make_lattice(levels[0], {})}).front();
}

// Full cells are connected wherever they meet, even in an edge or a corner.
TEST(Sheets, FullCellsAreConnectedHoweverTheyMeet) {
  Draw draw(49);
  for (int round = 0; round < 40; ++round) {
    const auto side = [&] { return static_cast<std::uint32_t>(2 + draw.below(6)); };
    offline::Claims claims = offline::no_claims({{}, 0.005, {side(), side(), side()}});
    const std::size_t most = 2 + draw.below(4);
    for (std::uint64_t& inside : claims.inside) inside = draw.below(most) == 0 ? kAll : 0;
    const offline::Lattice split = split_of(claims);
    EXPECT_EQ(split.sheets, 1U);
    EXPECT_EQ(split.cell_of_voxel, offline::make_lattice(claims, {}).cell_of_voxel);
    EXPECT_TRUE(split.parts.empty());
    EXPECT_TRUE(split.ties.empty());
  }
}

// The particles at the corners of a cell's voxels.
std::set<std::array<std::uint32_t, 3>> particles_of(const offline::Lattice& lattice,
                                                    std::size_t cell) {
  std::set<std::array<std::uint32_t, 3>> particles;
  std::size_t voxel = 0;
  for (const OrganRun& run : lattice.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) {
      if (lattice.cell_of_voxel[voxel++] != cell) continue;
      for (std::uint32_t c = 0; c < 8; ++c) {
        std::array<std::uint32_t, 3> at{run.x + i + (c & 1U), run.y + (c >> 1U & 1U),
                                        run.z + (c >> 2U)};
        for (const OrganTie& tie : lattice.ties) {
          if (tie.x == at[0] && tie.y == at[1] && tie.z == at[2]) at[1] = tie.to_y;
        }
        particles.insert(at);
      }
    }
  }
  return particles;
}

// There are three cells along each side. The body in one cell touches the middle cell on a face;
// another body touches it at a corner on the opposite side. The middle cell contains no sample,
// only surface, which belongs to the body on the face.
TEST(Sheets, ACellOfSurfaceAloneBelongsToTheBodyOnItsFace) {
  for (std::size_t face = 0; face < 6; ++face) {
    for (unsigned across = 0; across < 4; ++across) {
      const std::size_t axis = face / 2;
      const std::size_t strides[] = {1, 3, 9};
      const std::size_t up = strides[axis], u = strides[(axis + 1) % 3],
                        v = strides[(axis + 2) % 3];
      const std::size_t middle = 13, beside = face % 2 == 0 ? middle - up : middle + up;
      const std::size_t plane = face % 2 == 0 ? middle + up : middle - up;
      const std::size_t in_row = (across & 1U) != 0 ? plane + u : plane - u;
      const std::size_t corner = (across & 2U) != 0 ? in_row + v : in_row - v;
      offline::Claims claims = offline::no_claims({{}, 0.005, {3, 3, 3}});
      claims.inside[beside] = claims.inside[corner] = kAll;
      claims.pierced[middle] = 1;
      const offline::Lattice split = split_of(claims);
      const auto of_middle = particles_of(split, middle), of_beside = particles_of(split, beside),
                 of_corner = particles_of(split, corner);
      ASSERT_EQ(of_middle.size() + of_beside.size() + of_corner.size(), 24U);
      std::vector<std::array<std::uint32_t, 3>> common;
      std::set_intersection(of_middle.begin(), of_middle.end(), of_beside.begin(), of_beside.end(),
                            std::back_inserter(common));
      EXPECT_EQ(common.size(), 4U) << face << " " << across;
      std::set_intersection(of_middle.begin(), of_middle.end(), of_corner.begin(), of_corner.end(),
                            std::back_inserter(common));
      EXPECT_EQ(common.size(), 4U) << face << " " << across;  // and no more
    }
  }
}

// Samples of a cell by their position in it, in edges.
std::uint64_t samples_where(const std::function<bool(Vec)>& is) {
  std::uint64_t inside = 0;
  for (std::uint32_t i = 0; i < 64; ++i) {
    if (is(offline::sample_point(i))) inside |= std::uint64_t{1} << i;
  }
  return inside;
}

std::multiset<std::uint64_t> parts_in(const offline::Lattice& lattice, std::size_t cell) {
  std::multiset<std::uint64_t> parts;
  for (const offline::SharedCell& each : offline::shared_in(lattice, cell))
    parts.insert(each.inside);
  return parts;
}

// Two bodies side by side in a cell, of eight samples each, and beyond a gap a speck of one sample.
// If the speck is connected to nothing, it gets no voxel of its own and belongs to the nearest
// body. If it is connected to one of the bodies around the cell, it belongs to that one, even if it
// is farther away. If it is connected to something else, it has its own voxel.
TEST(Sheets, ASpeckBelongsToTheBodyItTouchesOrToTheNearest) {
  const std::uint64_t left = samples_where([](Vec at) { return at.x < 0.25 && at.y < 0.5; });
  const std::uint64_t right = samples_where([](Vec at) { return at.x > 0.75 && at.y < 0.5; });
  ASSERT_GE(std::min(std::popcount(left), std::popcount(right)), offline::kLeastPart);
  int specks = 0;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const Vec place = offline::sample_point(i);
    if (place.y < 0.85 || (place.x > 0.35 && place.x < 0.65)) continue;
    ++specks;
    const std::uint64_t speck = std::uint64_t{1} << i;
    offline::Claims claims = offline::no_claims({{}, 0.005, {3, 3, 3}});
    const std::size_t middle = 13, behind = middle + 3;
    claims.inside[middle] = left | right | speck;
    const std::uint64_t beside = place.x < 0.5 ? left : right, across = (left | right) & ~beside;
    EXPECT_THAT(parts_in(split_of(claims), middle),
                testing::UnorderedElementsAre(beside | speck, across))
        << i;
    claims.inside[behind] = kAll;
    EXPECT_THAT(parts_in(split_of(claims), middle),
                testing::UnorderedElementsAre(left, right, speck))
        << i;
    // The left body reaches around to the speck.
    claims.inside[middle - 1] = claims.inside[behind - 1] = kAll;
    EXPECT_THAT(parts_in(split_of(claims), middle),
                testing::UnorderedElementsAre(left | speck, right))
        << i;
  }
  EXPECT_GT(specks, 4);
}

// 33 000 voxels along y need as many rows in each sheet, and with two sheets that is more than an
// organ has.
TEST(Sheets, RowsOfAllSheetsAreBounded) {
  const std::vector<offline::Input> inputs = {
      input_of(box_mesh({0, 0, 0}, {0.1, 3300, 0.13}), 1e-3),
      input_of(box_mesh({0, 0, 0.17}, {0.1, 3300, 0.3}), 1e-3)};
  try {
    (void)build_quietly(inputs, split_at(0.1, true));
    ADD_FAILURE() << "built";
  } catch (const offline::Refusal& refusal) {
    EXPECT_THAT(refusal.what(), testing::HasSubstr("--split-gaps: 2 sheets of 3300"));
  }
}

}  // namespace
}  // namespace stylet::test
