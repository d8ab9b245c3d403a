// SPDX-License-Identifier: Apache-2.0
// Full pools behave as limits.h says, and are counted.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rig.h"

namespace stylet::test {
namespace {

TinyMaterial slippery() {
  TinyMaterial m;
  m.youngs_modulus_pa = 20000;
  m.puncture_force_n = 0.05F;
  m.cutting_force_n = 0.02F;
  return m;
}

TinyOrgan block() {
  TinyOrgan tiny;
  tiny.nx = 8;
  tiny.ny = tiny.nz = 5;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  tiny.materials = {slippery()};
  return tiny;
}
constexpr Vec3 kStart = {-1e-3F, 12e-3F, 13e-3F};
constexpr float kTinyUnitM = 1e-4F;

Config tiny_unit() {
  Config config;
  config.needle[0].unit_m = kTinyUnitM;
  return config;
}

TEST(Pools, FullShaftPoolIsCountedAndTheShaftBeyondItIsNotFelt) {
  Rig rig = make_rig(block(), tiny_unit());
  std::uint64_t flagged = 0;
  const Output out = drive(rig, kStart, 30e-3F, 10e-3F, [&](const Output& o) {
    flagged += (o.flags & kFlagCpPoolFull) != 0 ? 1 : 0;
    ASSERT_TRUE(std::isfinite(norm_of(o.force_n)));
  });
  const Stats s = stats(rig.kernel());
  EXPECT_EQ(s.constraint_particles.used_max, kMaxConstraintParticles);
  EXPECT_GT(flagged, 100U);
  EXPECT_EQ(s.cp_pool_full, flagged);
  EXPECT_GT(out.depth_m, 25e-3F) << "the needle advances";
  // Friction of 128 units of 0.1 mm at 10 N/m, whatever the depth.
  EXPECT_NEAR(-static_cast<double>(out.cause.friction_n.x) / (128 * 1e-4 * 10), 1, 0.02);
  drive(rig, {30e-3F, kStart.y, kStart.z}, -20e-3F, 20e-3F);
  const Output left = hold(rig, {-20e-3F, kStart.y, kStart.z}, 100);
  EXPECT_EQ(left.phase, Phase::kFree);
  EXPECT_EQ(left.constraint_particles, 0U);
}

TEST(Pools, NeedleThatJumpsGetsItsParticlesInTheNextTicks) {
  Rig rig = make_rig(block(), tiny_unit());
  drive(rig, kStart, 6e-3F, 10e-3F);
  const std::uint32_t before = rig.view().state.needle->shaft_count;
  ASSERT_GT(before, 0U);
  std::uint32_t last = before, most = 0;
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(move_tip(rig, {10e-3F, kStart.y, kStart.z}).flags & ~kFlagInputClamped, 0U);
    const std::uint32_t now = rig.view().state.needle->shaft_count;
    most = std::max(most, now - std::min(now, last));
    last = now;
  }
  EXPECT_LE(most, kMaxDropsPerTick);
  EXPECT_GE(last, before + 20) << "the rest follow";
}

// A needle jumps by more units than a CP may slip in a tick: the CP slips by the most that it may,
// and by the rest in the next ticks.
TEST(Pools, NeedleThatJumpsInPaperModeSlipsByMostUnitsATick) {
  Config config = tiny_unit();
  config.mode = Mode::kPaper;
  config.period_s = 2e-3F;  // the fastest hand moves 10 mm meanwhile
  Rig rig = make_rig(block(), config, Tissue::kFixed);
  const Vec3 rest_m = {12.5e-3F, 12.5e-3F, 12.5e-3F};
  Vec3 tip_m = hold_one_shaft_particle(rig, rest_m, 1e-3F);
  const Particle& p = rig.view().state.shaft[0];
  const auto slipped_by = [&] {
    const float before_m = p.arc_m;
    move_tip(rig, tip_m);
    return std::lround((p.arc_m - before_m) / kTinyUnitM);
  };
  tip_m.x += 9.95e-3F;  // 99.5 units
  EXPECT_EQ(slipped_by(), kMaxUnitsPerTick);
  EXPECT_EQ(slipped_by(), 99 - kMaxUnitsPerTick);
  EXPECT_EQ(slipped_by(), 0);
}

// A long thin block of small voxels. The needles run between the voxels' centres, so that every CP
// has eight of them.
TinyOrgan fine_block() {
  TinyOrgan tiny;
  tiny.nx = 250;
  tiny.ny = tiny.nz = 4;
  tiny.voxel_edge_m = 1e-3F;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  tiny.materials = {slippery()};
  tiny.materials[0].puncture_force_n = 0;
  return tiny;
}

Config long_needles(std::uint32_t count) {
  Config config;
  config.needle_count = count;
  for (NeedleConfig& needle : config.needle) {
    needle.length_m = 0.4F;
    needle.unit_m = 2e-3F;
  }
  return config;
}

// Shaft CPs with room in the pool have weights that add up to 1. Those without room have no weights
// at all, push nothing, and nothing pushes them. (Once a CP without weights had a force, which only
// the needle felt.)
int complete_particles(const View& view) {
  int complete = 0;
  for (std::uint32_t i = 0; i < view.state.needle->shaft_count; ++i) {
    const Particle& p = view.state.shaft[i];
    float sum = 0;
    for (std::uint32_t j = 0; j < p.support_count; ++j) {
      EXPECT_GT(p.support[j].weight, 0) << "particle " << i;
      sum += p.support[j].weight;
    }
    if (p.support_count == 0) {
      EXPECT_EQ(norm_of(p.force_n), 0) << "particle " << i;
      continue;
    }
    EXPECT_NEAR(sum, 1, 1e-5F) << "particle " << i;
    ++complete;
  }
  return complete;
}

int whole_particles(const View& view) {
  int whole = 0;
  for (std::uint32_t i = 0; i < view.state.needle->shaft_count; ++i) {
    whole += view.state.shaft[i].support_count == kSupportsPerParticle ? 1 : 0;
  }
  return whole;
}

TEST(Pools, FullVoxelPoolGivesTheWeightToTheOthers) {
  Rig rig = make_rig(fine_block(), long_needles(1));
  std::uint64_t flagged = 0;
  drive(rig, {-1e-3F, 2e-3F, 2e-3F}, 200e-3F, 0.2F, [&](const Output& o) {
    flagged += (o.flags & kFlagCpVoxelPoolFull) != 0 ? 1 : 0;
    ASSERT_TRUE(std::isfinite(norm_of(o.force_n)));
  });
  const Stats s = stats(rig.kernel());
  EXPECT_EQ(s.coupled_voxels.used_max, kMaxCoupledVoxels);
  EXPECT_GT(flagged, 0U);
  EXPECT_GE(s.cp_voxel_pool_full, flagged);
  EXPECT_GT(complete_particles(rig.view()), 40);
  // The tip has room of its own, and goes on as before.
  EXPECT_EQ(rig.view().state.tip->support_count, kSupportsPerParticle);
  EXPECT_GT(rig.view().state.tip->track_m, 0.195F);
}

// The first needle's CPs are served first: they take the room of the second needle's deep CPs, and
// later come to the voxels in which those were.
TEST(Pools, FullVoxelPoolServesTheFirstNeedleWhereTheSecondWas) {
  Rig rig = make_rig(fine_block(), long_needles(2));
  std::array<Vec3, 2> tip_m = {Vec3{-5e-3F, 2e-3F, 2e-3F}, {-5e-3F, 3e-3F, 2e-3F}};
  std::array<Output, 2> out = {};
  std::uint64_t flagged = 0;
  for (const std::size_t moving : {1U, 0U}) {
    for (int i = 0; i < 1000; ++i) {
      tip_m[moving].x += 0.2e-3F;
      const std::array<Input, 2> in = {along_x(tip_m[0], rig.length_m),
                                       along_x(tip_m[1], rig.length_m)};
      checked_tick(rig, in, out);
      flagged += (out[0].flags & kFlagCpVoxelPoolFull) != 0 ? 1 : 0;
      ASSERT_TRUE(std::isfinite(norm_of(out[0].force_n)) && std::isfinite(norm_of(out[1].force_n)));
    }
  }
  EXPECT_GT(flagged, 0U);
  const int first = whole_particles(rig.view()), all = complete_particles(rig.view());
  const int second = whole_particles(needle_view(rig.view(), 1));
  EXPECT_GT(first, 90);
  EXPECT_LE(all - first, 1) << "except the entry, at the edge of the tissue";
  EXPECT_LT(second, first - 20) << "the second has half of its voxels with the first";
  (void)complete_particles(needle_view(rig.view(), 1));
  // The first needle leaves, and the second holds again all that it had lost.
  for (int i = 0; i < 1300; ++i) {
    tip_m[0].x -= 0.2e-3F;
    const std::array<Input, 2> in = {along_x(tip_m[0], rig.length_m),
                                     along_x(tip_m[1], rig.length_m)};
    checked_tick(rig, in, out);
    (void)complete_particles(rig.view());
    (void)complete_particles(needle_view(rig.view(), 1));
  }
  EXPECT_EQ(out[0].phase, Phase::kFree);
  View held = needle_view(rig.view(), 1);
  EXPECT_GE(whole_particles(held), 60) << "of " << held.state.needle->shaft_count;
  EXPECT_GT(whole_particles(held), second);
}

TEST(Pools, SeventeenthTrackForgetsTheFirst) {
  TinyOrgan tiny = block();
  tiny.ny = 30;
  Rig rig = make_rig(tiny, Config{});
  const auto stab = [&rig](int hole) {
    const Vec3 at = {-1e-3F, 12e-3F + 6e-3F * static_cast<float>(hole), kStart.z};
    drive(rig, {-10e-3F, at.y, at.z}, 15e-3F, 0.1F);
    drive(rig, {15e-3F, at.y, at.z}, -10e-3F, 0.1F);
    hold(rig, {-10e-3F, at.y, at.z}, 300);
    Event list[kMaxEvents];
    const std::uint32_t count = events(rig.kernel(), list);
    for (std::uint32_t i = count; i-- > 0;) {
      if (list[i].kind == EventKind::kPuncture || list[i].kind == EventKind::kReentry) {
        return list[i].kind;
      }
    }
    return EventKind::kExit;
  };
  for (int hole = 0; hole < static_cast<int>(kMaxTracks); ++hole) {
    ASSERT_EQ(stab(hole), EventKind::kPuncture) << "hole " << hole;
  }
  EXPECT_EQ(stats(rig.kernel()).tracks.used, kMaxTracks);
  EXPECT_EQ(stab(0), EventKind::kReentry) << "still remembered";
  EXPECT_EQ(stab(16), EventKind::kPuncture);
  EXPECT_EQ(stab(1), EventKind::kReentry) << "the second is remembered";
  EXPECT_EQ(stab(0), EventKind::kPuncture) << "the oldest is forgotten";
}

}  // namespace
}  // namespace stylet::test
