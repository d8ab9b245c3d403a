// SPDX-License-Identifier: Apache-2.0
// A bend that moves a tip in contact within a tick (PHYSICS 6.4): moved along the needle, the tip
// goes on pressing the tissue it holds; thrown aside by more than it was displaced before, it takes
// hold of the tissue it comes to, without force; thrown out of the tissue, it touches nothing.

#include <gtest/gtest.h>

#include <cstring>

#include "coupling/bend.h"
#include "draw.h"
#include "rig.h"

namespace stylet::test {
namespace {

constexpr std::uint16_t kVoxels = 12;
constexpr float kEdgeM = 5e-3F;
constexpr float kMiddleM = 0.5F * kEdgeM * kVoxels;

Rig block() {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = kVoxels;
  tiny.voxel_edge_m = kEdgeM;
  tiny.materials[0].puncture_force_n = 1000;
  Config config;
  config.surround_drag_per_s = 20;
  return make_rig(tiny, config, Tissue::kFixed);
}

// A needle pressed `depth_m` into the face; then a bend moves the tip by `moved_m`.
struct Thrown {
  Rig rig = block();
  Particle before;
  Vec3 tip_m;

  Thrown(float depth_m, Vec3 moved_m) {
    tip_m = Vec3{depth_m, kMiddleM, kMiddleM};
    drive(rig, {-1e-3F, kMiddleM, kMiddleM}, depth_m, 0.05F);
    hold(rig, tip_m, 100);
    View view = rig.view();
    tip_m = tip_m + moved_m;
    view.state.tip->position_m = view.state.tip->position_m + moved_m;
    before = *view.state.tip;
    Needle needle = needle_of(view.model, view.state);
    needle.tip_m = needle.tip_m + moved_m;
    needle.tip_direction = {1, 0, 0};
    needle.off_m = depth_m;
    throw_aside(view.model, view.state, view.scratch, needle, moved_m);
  }
  const Particle& tip() const { return *rig.view().state.tip; }
  Phase phase() const { return rig.view().state.needle->phase; }
};

// The bounds are those of a spring's chord: 10 um and a tenth of the tip's displacement (PHYSICS
// 12.6).
float bound_of(float depth_m) {
  return 1e-5F + 0.1F * depth_m;
}

TEST(Aside, ABendAlongTheNeedleGoesOnPressing) {
  Draw draw(11);
  for (int i = 0; i < 16; ++i) {
    const float depth_m = draw.between(0.5e-3, 3e-3), bound_m = bound_of(depth_m);
    const float along_m = bound_m * draw.between(2, 8), aside_m = bound_m * draw.between(0, 0.9);
    const Thrown thrown(depth_m, {along_m, aside_m, 0});
    ASSERT_EQ(thrown.phase(), Phase::kContact);
    EXPECT_EQ(std::memcmp(&thrown.tip(), &thrown.before, sizeof(Particle)), 0)
        << depth_m << " m deep, " << along_m << " m along, " << aside_m << " m aside";
  }
}

TEST(Aside, AThrownTipHoldsWhatItComesToWithoutForce) {
  Draw draw(12);
  for (int i = 0; i < 16; ++i) {
    const float depth_m = draw.between(0.5e-3, 3e-3);
    const float aside_m = depth_m + kEdgeM * draw.between(0.5, 3);
    const Thrown thrown(depth_m, {0, aside_m, 0});
    ASSERT_EQ(thrown.phase(), Phase::kContact);
    ASSERT_GT(thrown.tip().support_count, 0U);
    EXPECT_GT(norm_of(residual(thrown.before)), 0.9 * static_cast<double>(aside_m));
    EXPECT_LT(norm_of(residual(thrown.tip())), 1e-6);
    EXPECT_LT(norm_of(thrown.tip().position_m - thrown.tip_m), 1e-6);
    // The tip holds the tissue where it is now, except for how far the attached tissue gives way,
    // and for the deformation gradient over that way.
    const Vec3 held_m = thrown.before.position_m - residual(thrown.before);
    const double gives_m = norm_of(held_m - unloaded_place(thrown.rig.view().model, thrown.before));
    const double edges = static_cast<double>(aside_m) / static_cast<double>(kEdgeM);
    EXPECT_LT(norm_of(thrown.tip().rest_m - thrown.tip_m), gives_m * (1 + edges) + 1e-6)
        << aside_m << " m aside";
    EXPECT_LT(gives_m, 0.02 * static_cast<double>(aside_m));
  }
}

TEST(Aside, AThrowOutOfTheTissueEndsTheContact) {
  Draw draw(13);
  for (int i = 0; i < 16; ++i) {
    const float depth_m = draw.between(0.5e-3, 3e-3);
    const float away_m = kMiddleM + kEdgeM * draw.between(2, 20);
    const bool up = (draw.bits() & 1U) != 0;
    const Thrown thrown(depth_m, {0, up ? away_m : 0, up ? 0 : -away_m});
    EXPECT_EQ(thrown.phase(), Phase::kFree) << away_m << " m away";
    EXPECT_EQ(thrown.rig.view().state.needle->tip_alive, 0U);
    Event last = {};
    ASSERT_EQ(events(thrown.rig.session.kernel, {&last, 1}), 1U);
    EXPECT_EQ(last.kind, EventKind::kRelease);
  }
}

}  // namespace
}  // namespace stylet::test
