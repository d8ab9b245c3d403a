// SPDX-License-Identifier: Apache-2.0
// Tissue that moves by itself over a resting needle: friction and retraction follow the same rule
// as for a needle that moves in resting tissue.

#include <gtest/gtest.h>

#include <cmath>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr float kAmplitudeM = 8e-3F, kBreathS = 2;

TinyOrgan gel() {
  TinyOrgan tiny;
  tiny.nx = 12;
  tiny.ny = tiny.nz = 7;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  tiny.materials[0].youngs_modulus_pa = 20000;
  tiny.materials[0].puncture_force_n = 0.4F;
  return tiny;
}

Config breathing(float amplitude_m) {
  Config config;
  config.breathing = {{amplitude_m, 0, 0}, kBreathS};
  return config;
}

// Displacement by the breath at a tick, in double.
double breath(std::uint64_t tick) {
  const double t = static_cast<double>(tick) * 1e-3 / static_cast<double>(kBreathS);
  return static_cast<double>(kAmplitudeM) * std::pow(std::sin(3.14159265358979 * t), 4);
}

TEST(Breathing, MovingTissueIsFeltAsANeedleThatMovesTheOtherWay) {
  Rig moving = make_rig(gel(), breathing(kAmplitudeM)), still = make_rig(gel(), breathing(0));
  double worst = 0, largest = 0;
  for (std::uint64_t t = 1; t <= 12000; ++t) {
    const double depth = std::min(-1e-3 + 10e-6 * static_cast<double>(t), 35e-3);
    const float x = static_cast<float>(depth);
    const Output a = move_tip(moving, {x, 17e-3F, 18e-3F});
    const Output b = move_tip(still, {static_cast<float>(depth - breath(t)), 17e-3F, 18e-3F});
    worst = std::max(worst, norm_of(a.force_n - b.force_n));
    largest = std::max(largest, norm_of(a.force_n));
  }
  EXPECT_GT(largest, 0.4);
  EXPECT_LT(worst, 2e-3 * largest);
}

TEST(Breathing, ARestingNeedleFeelsFrictionBothWays) {
  Rig rig = make_rig(gel(), breathing(kAmplitudeM));
  drive(rig, {-2e-3F, 17e-3F, 18e-3F}, 35e-3F, 20e-3F);
  double pushed = 0, pulled = 0, shallow = 1, deep = 0;
  for (int i = 0; i < 4000; ++i) {
    const Output out = move_tip(rig, {35e-3F, 17e-3F, 18e-3F});
    const double force = -static_cast<double>(out.force_n.x);
    pushed = std::max(pushed, force);
    pulled = std::min(pulled, force);
    shallow = std::min(shallow, static_cast<double>(out.depth_m));
    deep = std::max(deep, static_cast<double>(out.depth_m));
  }
  // 10 N/m over the inserted length, and the tip's 0.2 N where it cuts.
  EXPECT_NEAR(pulled, -10 * shallow, 0.08);
  EXPECT_GT(pushed, 10 * shallow);
  EXPECT_LT(pushed, 10 * deep + 0.25);
  // The tissue slides past on that part of its way on which the needle does not hold it.
  EXPECT_GT(deep - shallow, 0.6 * static_cast<double>(kAmplitudeM));
  EXPECT_LT(deep - shallow, static_cast<double>(kAmplitudeM));
}

}  // namespace
}  // namespace stylet::test
