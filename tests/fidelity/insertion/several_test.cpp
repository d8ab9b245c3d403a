// SPDX-License-Identifier: Apache-2.0
// Two needles in one tissue: each has its own forces, limits and particles; they share the tissue.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "rig.h"

namespace stylet::test {
namespace {

TinyOrgan gel() {
  TinyOrgan tiny;
  tiny.nx = 10;
  tiny.ny = 7;
  tiny.nz = 16;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  tiny.materials[0].youngs_modulus_pa = 20000;
  tiny.materials[0].puncture_force_n = 0.4F;
  return tiny;
}

Config two() {
  Config config;
  config.needle_count = 2;
  return config;
}

constexpr float kNearZ = 18e-3F, kFarZ = 62e-3F;

std::array<Output, 2> move_both(Rig& rig, float x0, float x1) {
  const std::array<Input, 2> in = {along_x({x0, 17e-3F, kNearZ}, rig.length_m),
                                   along_x({x1, 18e-3F, kFarZ}, rig.length_m)};
  std::array<Output, 2> out = {};
  checked_tick(rig, in, out);
  return out;
}

TEST(TwoNeedles, FarApartEachFeelsWhatItFeelsAlone) {
  Rig both = make_rig(gel(), two()), alone = make_rig(gel(), Config{});
  double worst = 0, largest = 0;
  int apart = 0;
  for (int i = 0; i < 3600; ++i) {
    const float x = -1e-3F + 10e-6F * static_cast<float>(i);
    const auto out = move_both(both, x, x - 2e-3F);
    const Output one = move_tip(alone, {x, 17e-3F, kNearZ});
    largest = std::max(largest, norm_of(one.force_n));
    // With the second needle a puncture may come some ticks earlier, and the tissue's recoil takes
    // its time.
    apart += out[0].constraint_particles != one.constraint_particles ? 1 : 0;
    if (i > 1500 && i < 2500) continue;
    worst = std::max(worst, norm_of(out[0].force_n - one.force_n));
  }
  EXPECT_LT(apart, 60);
  EXPECT_GT(largest, 0.4);
  EXPECT_LT(worst, 0.02 * largest);
}

TEST(TwoNeedles, EachHasItsEventsAndItsPhase) {
  Rig rig = make_rig(gel(), two());
  std::array<Output, 2> out = {};
  for (int i = 0; i < 3000; ++i)
    out = move_both(rig, -20e-3F, -1e-3F + 10e-6F * static_cast<float>(i));
  EXPECT_EQ(out[0].phase, Phase::kFree);
  EXPECT_EQ(norm_of(out[0].force_n), 0);
  EXPECT_EQ(out[1].phase, Phase::kInserted);
  Event list[kMaxEvents];
  const std::uint32_t count = events(rig.kernel(), list);
  ASSERT_GE(count, 2U);
  for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(list[i].needle, 1U);
}

// One needle at rest in the tissue feels the other press close by.
TEST(TwoNeedles, ShareTheTissue) {
  Rig rig = make_rig(gel(), two());
  const auto move = [&rig](Vec3 a, Vec3 b) {
    const std::array<Input, 2> in = {along_x(a, rig.length_m), along_x(b, rig.length_m)};
    std::array<Output, 2> out = {};
    checked_tick(rig, in, out);
    return out;
  };
  const float y = 17e-3F;
  for (int i = 0; i < 3000; ++i) {
    move({-1e-3F + 10e-6F * static_cast<float>(i), y, 30e-3F}, {-5e-3F, y, 40e-3F});
  }
  const Vec3 rests = {29e-3F, y, 30e-3F};
  std::array<Output, 2> out = {};
  for (int i = 0; i < 1500; ++i) out = move(rests, {-5e-3F, y, 40e-3F});
  const Vec3 before = out[0].force_n;
  // The second needle goes in, and is then pulled towards the first.
  for (int i = 0; i < 3000; ++i)
    out = move(rests, {-5e-3F + 10e-6F * static_cast<float>(i), y, 40e-3F});
  for (int i = 0; i < 1000; ++i)
    out = move(rests, {25e-3F, y, 40e-3F - 3e-6F * static_cast<float>(i)});
  EXPECT_LT(out[0].force_n.z - before.z, -0.05F) << "pushed away by the other";
  EXPECT_GT(out[1].force_n.z, 0.1F) << "which feels the opposite";
}

TEST(TwoNeedles, AMissingInputKeepsItsNeedleAndIsCounted) {
  Rig rig = make_rig(gel(), two());
  move_both(rig, -20e-3F, -20e-3F);
  const Input only = along_x({-19.99e-3F, 17e-3F, kNearZ}, rig.length_m);
  std::array<Output, 2> out = {};
  checked_tick(rig, {&only, 1}, out);
  EXPECT_EQ(out[0].flags, 0U);
  EXPECT_EQ(out[1].flags, static_cast<std::uint32_t>(kFlagInputMissing));
  EXPECT_EQ(stats(rig.kernel()).input_missing, 1U);
}

}  // namespace
}  // namespace stylet::test
