// SPDX-License-Identifier: Apache-2.0
// Built organs with voxels of several sizes in the kernel: they rest, sink and feel as those whose
// voxels have one size.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "felt.h"
#include "meshes/phantom.h"
#include "offline_support.h"
#include "organ_levels.h"
#include "random_bodies.h"
#include "session.h"
#include "state/layout.h"
#include "voxels/attach.h"

namespace stylet::test {
namespace {

using offline::BuildOptions;
using offline::Mesh;
using offline::Vec;

TEST(Refine, ARandomBodyRests) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    Draw draw(seed);
    SCOPED_TRACE(seed);
    const auto place = [&] { return draw.between(-15, 15); };
    BuildOptions options =
        refined(6, {fmt::format("way:{},{},{}:{},{},{}:{}:2", place(), place(), place(), place(),
                                place(), place(), draw.between(1, 5)),
                    "surface"});
    options.held = offline::parse_regions({"z<30%"}, {1});
    Mesh mesh = turned(offline::ball_phantom(0.03, 4e-3), random_frame(draw));
    for (Vec& p : mesh.points) p.x *= draw.between(0.999, 1.001);
    const auto built = build_quietly({input_of(mesh, 1, "kidney")}, options);
    const Organ organ = opened(built.bytes);
    Session session = make_session(organ, Config{});
    for (int i = 0; i < 50; ++i) (void)tick(session.kernel, Input{});
    EXPECT_LT(view_of(session.kernel).state.head->max_displacement_m, 1e-7F);
  }
}

// A block of 40 mm, held below, with voxels of 5 mm.
offline::Built block(double voxel_mm, const std::vector<std::string>& where) {
  BuildOptions options = refined(voxel_mm, where);
  options.held = offline::parse_regions({"z<1"}, {1});
  return build_quietly({input_of(box_mesh({0, 0, 0}, {0.04, 0.04, 0.04}), 1, "gel")}, options);
}

std::vector<Vec3> felt_n(const offline::Built& built) {
  const Organ organ = opened(built.bytes);
  Config config;
  config.needle[0].unit_m = 2.5e-3F;
  config.substeps = 8;  // with one, fine voxels everywhere and around the way are 4 % off, each
  Session session = make_session(organ, config);
  const Script script = {{0.0153F, 0.0213F, 0.04F}, config.needle[0].length_m};
  return felt_n(session.kernel, script);
}

// Fine around its way, a needle feels what it would feel if all were fine (kernel/decisions/30).
// The script's first cycle goes in 7.4 and 3.1 mm beside its entry, tilted by 0.12.
TEST(Refine, ANeedleFeelsTheFineTissueAroundItsWay) {
  const std::vector<Vec3> fine = felt_n(block(2.5, {}));
  EXPECT_GT(off(felt_n(block(5, {})), fine), 0.05);
  EXPECT_LT(off(felt_n(block(5, {"way:7.9,18.2,40:7.9,18.2,13:11"})), fine), 0.03);
}

// How far a block sinks under a load does not depend on where it is fine.
TEST(Refine, ABlockSinksAsOneOfCoarseVoxelsDoes) {
  const auto sinks_m = [](const offline::Built& built) {
    const Organ organ = opened(built.bytes);
    Config config;
    config.gravity_m_per_s2 = {0, 0, -3};
    Session session = make_session(organ, config);
    for (int i = 0; i < 600; ++i) (void)tick(session.kernel, Input{});
    return static_cast<double>(view_of(session.kernel).state.head->max_displacement_m);
  };
  const double one_m = sinks_m(block(5, {}));
  EXPECT_GT(one_m, 1e-4);
  for (const char* where : {"surface", "box:-1,-1,20:41,17,41:2", "way:0,0,0:40,40,40:4:3"}) {
    EXPECT_NEAR(sinks_m(block(5, {where})), one_m, 0.03 * one_m) << where;
  }
}

}  // namespace
}  // namespace stylet::test
