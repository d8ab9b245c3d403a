// SPDX-License-Identifier: Apache-2.0
// --fit counts the voxels that a tick sweeps, with random bodies.
#include "voxels/sweep.h"

#include <gmock/gmock.h>

#include "base/refusal.h"
#include "offline_support.h"
#include "random_bodies.h"
#include "report/speed.h"
#include "voxels/crop.h"

namespace stylet::test {
namespace {

using offline::Mesh;

// A plate with teeth at random: rows with holes along x.
Mesh comb(Draw& draw) {
  Mesh mesh = box_mesh({0, 0, 0}, {120, 60, 12});
  for (double x = 1; x < 110; x += draw.between(14, 30)) {
    mesh = both(mesh, box_mesh({x, 1, 18}, {x + draw.between(4, 8), 59, draw.between(40, 70)}));
  }
  return mesh;
}

TEST(Fit, SweepsNoMoreThanAllowed) {
  Draw draw(3);
  const Mesh teeth = comb(draw);
  for (const int kind : {0, 1, 2}) {
    offline::BuildOptions options;
    options.most_voxels = 6000;
    options.split = kind == 1;
    options.gap_tissue = kind == 2 ? "fat" : "";
    options.gap_m = 0.025;
    const auto bytes = build_quietly({input_of(teeth, 1e-3)}, options).bytes;
    const double swept = offline::swept_voxels(opened(bytes));
    EXPECT_LE(swept, 6000) << kind;
    EXPECT_GT(swept, 4000) << kind;  // the next step of 0.05 mm sweeps more
  }
}

TEST(Fit, SaysWhyItRefuses) {
  offline::BuildOptions options;
  options.most_voxels = 5000;
  options.crop = offline::parse_crop({"x>500"});
  try {
    (void)build_quietly({input_of(box_mesh({0, 0, 0}, {40, 40, 40}), 1e-3)}, options);
    ADD_FAILURE() << "accepted";
  } catch (const offline::Refusal& refusal) {
    EXPECT_THAT(refusal.what(), testing::HasSubstr("--crop: no voxel lies in all"));
  }
}

// The thread's own clock times an organ with holes, against the line through full blocks. (Before
// swept voxels were counted, the time was twice that of the line.) Other work of the machine only
// adds time: so the shortest of several times is taken, of blocks and organ in turn.
TEST(FitTimed, KnowsTheCostOfAnOrganWithHoles) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Draw draw(seed);
    offline::BuildOptions options;
    options.voxel_edge_m = draw.between(2.2, 3) * 1e-3;
    const auto bytes = build_quietly({input_of(comb(draw), 1e-3, "gel")}, options).bytes;
    const Organ organ = opened(bytes);
    const offline::Stepping stepping[] = {{1e-3, 2, Inertia::kAddedMass}, {}};
    double said[2] = {1e9, 1e9}, timed[2] = {1e9, 1e9};
    std::uint32_t passes[2] = {};
    for (int i = 0; i < 5; ++i) {
      const offline::Machine here = offline::measure_machine([](const char*, double) {});
      for (const int k : {0, 1}) {
        passes[k] = offline::passes_of(organ, stepping[k]);
        said[k] = std::min(said[k], offline::tick_us(here, offline::swept_voxels(organ),
                                                     stepping[k].substeps, passes[k]));
        const auto now = offline::time_tick(organ, stepping[k]);
        ASSERT_TRUE(now.has_value());
        timed[k] = std::min(timed[k], *now);
      }
    }
    for (const int k : {0, 1}) {
      std::printf("%u voxels, %.0f swept, %u passes: %.0f us said, %.0f timed\n", organ.voxel_count,
                  offline::swept_voxels(organ), passes[k], said[k], timed[k]);
      EXPECT_LT(std::max(timed[k] / said[k], said[k] / timed[k]), 1.5);
    }
  }
}

}  // namespace
}  // namespace stylet::test
