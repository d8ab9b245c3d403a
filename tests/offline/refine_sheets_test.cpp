// SPDX-License-Identifier: Apache-2.0
// Gaps that are kept open where voxels have several sizes: parts that are separate in the input are
// separate in the kernel, connected ones stay connected, also where a gap goes from fine voxels
// into coarse ones; and bodies without gaps are built as without the option.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "felt.h"
#include "gap_bodies.h"
#include "lattice/hanging.h"
#include "lattice/voxel.h"
#include "offline_support.h"
#include "organ_levels.h"
#include "random_bodies.h"
#include "session.h"
#include "set_speed.h"
#include "state/layout.h"

namespace stylet::test {
namespace {

using offline::BuildOptions;
using offline::Mesh;
using offline::Vec;

BuildOptions split_at(double voxel_mm, const std::vector<std::string>& where, bool split = true) {
  BuildOptions options = refined(voxel_mm, where);
  options.split = split;
  return options;
}

std::string way_through(Draw& draw, double size_mm) {
  const auto place = [&] {
    return fmt::format("{},{},{}", draw.between(-size_mm, size_mm), draw.between(-size_mm, size_mm),
                       draw.between(-size_mm, size_mm));
  };
  return fmt::format("way:{}:{}:{}:{}", place(), place(), draw.between(1, 8), 1 + draw.below(2));
}

// In mm, around the origin.
Mesh plate(double low, double high, const std::array<Vec, 3>& frame) {
  return turned(box_mesh({-30, -30, low}, {30, 30, high}), frame);
}

TEST(RefineSheets, BodiesWithoutGapsAreBuiltAsWithoutIt) {
  Draw draw(91);
  for (int i = 0; i < 12; ++i) {
    const std::string where = i % 4 == 0 ? "surface" : way_through(draw, 25);
    SCOPED_TRACE(where);
    Mesh body = ball(20, 24);
    for (Vec& each : body.points) each.x *= draw.between(1.3, 1.3001);
    body = turned(body, random_frame(draw));
    const double voxel_mm = draw.between(4, 8);
    const auto plain = build_quietly({input_of(body, 1e-3)}, split_at(voxel_mm, {where}, false));
    const auto split = build_quietly({input_of(body, 1e-3)}, split_at(voxel_mm, {where}));
    EXPECT_GE(opened(plain.bytes).levels, 2U);
    EXPECT_EQ(plain.bytes, split.bytes);
  }
}

// Two plates in any direction, half a coarse voxel apart.
TEST(RefineSheets, PlatesAreApart) {
  Draw draw(92);
  int two = 0;
  for (int i = 0; i < 12; ++i) {
    const std::string where = way_through(draw, 15);
    SCOPED_TRACE(where);
    const std::array<Vec, 3> frame = random_frame(draw);
    const double voxel_mm = draw.between(4, 6);
    const std::vector<offline::Input> inputs = {
        input_of(plate(-12, -0.25 * voxel_mm, frame), 1e-3, "liver"),
        input_of(plate(0.25 * voxel_mm, 12, frame), 1e-3, "kidney")};
    const auto split = build_quietly(inputs, split_at(voxel_mm, {where}));
    // (At their rims, one in some ten pairs is joined in voxels of one size, too.)
    EXPECT_EQ(pieces_of(split), pieces_of(build_quietly(inputs, split_at(voxel_mm, {}))));
    two += pieces_of(split) == 2 ? 1 : 0;
    EXPECT_EQ(pieces_of(build_quietly(inputs, split_at(voxel_mm, {where}, false))), 1U);
    const double wanted_m3 = 60 * 60 * (24 - 0.5 * voxel_mm) * 1e-9;
    EXPECT_NEAR(filled_m3(opened(split.bytes)) / wanted_m3, 1, 0.02);
  }
  EXPECT_GE(two, 9);
}

// One plate is thrown; the other one stays at rest to the last bit.
TEST(RefineSheets, NoPlateMovesWithTheOther) {
  Draw draw(93);
  for (int i = 0; i < 6; ++i) {
    const std::string where = way_through(draw, 15);
    SCOPED_TRACE(where);
    const std::array<Vec, 3> frame = random_frame(draw);
    const auto built = build_quietly({input_of(plate(-12, -1.3, frame), 1e-3, "liver"),
                                      input_of(plate(1.3, 12, frame), 1e-3, "kidney")},
                                     split_at(5, {where}));
    const Organ organ = opened(built.bytes);
    Session session = make_session(organ, Config{});
    const View view = view_of(session.kernel);
    std::vector<std::uint32_t> of[2];  // particles that are deep in a plate
    const std::vector<Cube> cubes = cubes_of(organ);
    for (std::uint32_t voxel = 0; voxel < organ.voxel_count; ++voxel) {
      const double half_m = 0.5 * edge_m(organ, cubes[voxel]);
      const Vec middle = low_m(organ, cubes[voxel]) + Vec{half_m, half_m, half_m};
      const double height_m = dot(middle, frame[2]);
      if (std::abs(height_m) < 6e-3) continue;
      const Row& row = view.model.row[view.model.voxel_row[voxel]];
      for (std::uint32_t c = 0; c < 8; ++c) {
        const std::uint32_t node =
            row.node[c >> 1U] + view.model.voxel_slot[voxel] - row.slot + (c & 1U);
        of[height_m < 0 ? 0 : 1].push_back(particle_of(view.model, node));
      }
    }
    for (const std::uint32_t p : of[0]) {
      if (hangs(view.model, p) || !(view.model.step_per_mass[p] > 0)) continue;
      set_speed(view, p, {0.1F * static_cast<float>(draw.between(-1, 1)), 0.05F, -0.03F});
    }
    for (int k = 0; k < 60; ++k) (void)tick(session.kernel, Input{});
    const auto moved = [&](const std::vector<std::uint32_t>& particles) {
      float most = 0;
      for (const std::uint32_t p : particles) {
        most = std::max(most, norm(Vec3{view.state.ux[p], view.state.uy[p], view.state.uz[p]}));
      }
      return most;
    };
    EXPECT_GT(moved(of[0]), 1e-4F);
    EXPECT_EQ(moved(of[1]), 0.0F);
  }
}

// A gap that ends within the body, and goes through voxels of all sizes: the lobes hang together at
// their base, and bend under a load as among fine voxels alone.
TEST(RefineSheets, LobesBendAsAmongFineVoxels) {
  const auto sinks_m = [](const offline::Built& built) {
    const Organ organ = opened(built.bytes);
    Config config;
    config.gravity_m_per_s2 = {2, 0.5F, 0};
    Session session = make_session(organ, config);
    for (int i = 0; i < 1500; ++i) (void)tick(session.kernel, Input{});
    return static_cast<double>(view_of(session.kernel).state.head->max_displacement_m);
  };
  const auto built = [](double voxel_mm, const std::vector<std::string>& where, bool split) {
    BuildOptions options = split_at(voxel_mm, where, split);
    options.held = offline::parse_regions({"z<0.5"}, {1e-3});
    return build_quietly({input_of(two_lobes(3), 1e-3)}, options);
  };
  const double one_m = sinks_m(built(2.5, {}, true));
  EXPECT_GT(one_m, 1e-4);
  EXPECT_LT(sinks_m(built(2.5, {}, false)), 0.9 * one_m) << "the closed gap holds them";
  for (const char* where : {"box:10,-1,-1:30,21,41", "box:-1,-1,20:50,41,50",
                            "way:0,10,0:40,10,45:8", "way:19,0,30:19,40,5:5", "surface"}) {
    SCOPED_TRACE(where);
    const auto some = built(5, {where}, true);
    EXPECT_EQ(pieces_of(some), 1U);
    EXPECT_GT(opened(some.bytes).ties.size(), 0U);
    EXPECT_NEAR(sinks_m(some), one_m, 0.05 * one_m);
  }
}

// Fine around its way through two slabs and the gap between them, a needle feels what it would feel
// if all were fine.
TEST(RefineSheets, ANeedleFeelsTheFineTissueAroundItsWay) {
  const auto felt = [](double voxel_mm, const std::vector<std::string>& where) {
    BuildOptions options = split_at(voxel_mm, where);
    options.held = offline::parse_regions({"z<1", "x<0.1", "x>39.9", "y<0.1", "y>39.9"}, {1e-3});
    const auto built =
        build_quietly({input_of(box_mesh({0, 0, 0}, {0.04, 0.04, 0.026}), 1, "gel"),
                       input_of(box_mesh({0, 0, 0.0285}, {0.04, 0.04, 0.04}), 1, "gel")},
                      options);
    const Organ organ = opened(built.bytes);
    Config config;
    config.needle[0].unit_m = 2.5e-3F;
    config.substeps = 8;
    Session session = make_session(organ, config);
    const Script script = {{0.0153F, 0.0213F, 0.04F}, config.needle[0].length_m};
    return felt_n(session.kernel, script);
  };
  const std::vector<Vec3> fine = felt(2.5, {});
  EXPECT_GT(off(felt(5, {}), fine), 0.05);
  EXPECT_LT(off(felt(5, {"way:7.9,18.2,40:7.9,18.2,13:11"}), fine), 0.05);
}

// A ball in a hollow one touches it nowhere.
TEST(RefineSheets, ABallInAHollowOneIsApartAllAround) {
  Draw draw(94);
  for (int i = 0; i < 6; ++i) {
    const std::string where = i == 0 ? "surface" : way_through(draw, 20);
    SCOPED_TRACE(where);
    const double radius = draw.between(17, 21), gap = draw.between(2.4, 4);
    const Mesh inner = turned(ball(radius, 24), random_frame(draw));
    const Mesh outer = turned(both(ball(radius + gap + 9, 24), inside_out(ball(radius + gap, 24))),
                              random_frame(draw));
    const auto split = build_quietly({input_of(inner, 1e-3), input_of(outer, 1e-3, "kidney")},
                                     split_at(draw.between(3.5, 4.5), {where}));
    EXPECT_EQ(pieces_of(split), 2U);
    const double both_m3 = (volume(inner) + volume(outer)) * 1e-9;
    EXPECT_NEAR(filled_m3(opened(split.bytes)), both_m3, 0.005 * both_m3);
  }
}

}  // namespace
}  // namespace stylet::test
