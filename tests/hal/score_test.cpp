// SPDX-License-Identifier: Apache-2.0
// Attempts are made by formulas, and the expected scores were computed by hand.
#include "hal/score/score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hal/scene/scene.h"

namespace stylet::hal {
namespace {

constexpr double kPeriodS = 1e-3;
constexpr Course kCourse = {{0.1F, 0, 0}, {1, 0, 0}};  // the surface is at x = 100 mm

// The tip of one needle, in mm from the surface; beyond the surface it is in tissue.
struct DrawnAttempt {
  explicit DrawnAttempt(std::vector<Target> targets = {})
      : scorer(targets, std::vector<Course>{kCourse, kCourse}, kPeriodS) {}

  void at(double x_mm, double y_mm = 0, Vec3 force_n = {}, std::uint32_t needle = 0) {
    TickRecord record = {};
    record.output.tick = ++tick;
    record.output.tip_m = {static_cast<float>(0.1 + x_mm * 1e-3), static_cast<float>(y_mm * 1e-3),
                           0};
    record.output.depth_m = static_cast<float>(x_mm > 0 ? x_mm * 1e-3 : 0);
    record.output.force_n = force_n;
    record.needle = needle;
    record.fault = fault;
    scorer.add(record);
  }
  // In `steps` equal steps, both ends included.
  void go(double from_mm, double to_mm, int steps, double y_mm = 0) {
    for (int i = 0; i <= steps; ++i) at(from_mm + (to_mm - from_mm) * i / steps, y_mm);
  }

  Scorer scorer;
  std::uint64_t tick = 0;
  Fault fault = Fault::kNone;
};

TEST(Score, WayInAirAndInTissue) {
  DrawnAttempt attempt;
  attempt.go(-10, 20, 60);  // half a millimetre a tick
  attempt.go(20, -5, 50);
  const Score score = attempt.scorer.score();
  EXPECT_NEAR(score.path_m, 55e-3, 1e-6);
  // A step across the surface counts on the side on which it ends: 20 in, 19.5 out.
  EXPECT_NEAR(score.depth_path_m, 39.5e-3, 1e-6);
  EXPECT_DOUBLE_EQ(score.duration_s, 0.112);
  EXPECT_EQ(score.withdrawals, 1U);
}

TEST(Score, AWayInStepsBelowTheRulerIsEquallyLong) {
  DrawnAttempt attempt;
  attempt.go(0, 20, 20000);
  EXPECT_NEAR(attempt.scorer.score().path_m, 20e-3, 1e-6);
  attempt.go(20, 0, 20000);  // a turn loses at most two rulers
  EXPECT_NEAR(attempt.scorer.score().path_m, 40e-3, 2 * kRulerM);
}

TEST(Score, NoiseBelowTheRulerAddsNoWay) {
  DrawnAttempt attempt;
  for (int i = 0; i < 10000; ++i) attempt.at(5, i % 2 == 0 ? 0.02 : -0.02);
  EXPECT_LT(attempt.scorer.score().path_m, 0.05e-3);
}

TEST(Score, TheLastPieceOfTheWayCounts) {
  DrawnAttempt attempt;
  attempt.go(1, 1.05, 1);
  EXPECT_NEAR(attempt.scorer.score().path_m, 0.05e-3, 1e-7);
  EXPECT_NEAR(attempt.scorer.score().depth_path_m, 0.05e-3, 1e-7);
}

TEST(Score, WithdrawalsAreTurnsOfAMillimetreInTissue) {
  DrawnAttempt attempt;
  attempt.go(-20, -5, 10);
  attempt.go(-5, -15, 10);  // back in air
  attempt.go(-15, 20, 100);
  attempt.go(20, 19.1, 9);  // too little
  attempt.go(19.1, 30, 50);
  attempt.go(30, 28.9, 11);  // the first
  attempt.go(28.9, 29.5, 6);
  attempt.go(29.5, 20, 50);  // still the first: it had gone in by only 0.6
  attempt.go(20, 22, 20);
  attempt.go(22, -10, 100);  // the second
  EXPECT_EQ(attempt.scorer.score().withdrawals, 2U);
}

TEST(Score, ClosestToTargets) {
  const Vec3 along = {0.120F, 0.003F, 0}, aside = {0.110F, 0.010F, 0};
  DrawnAttempt attempt({{"tumour", along, 0.0035F, false},
                        {"missed", along, 0.0029F, false},
                        {"vessel", aside, 0.005F, true}});
  // 25 mm a tick: in no tick is the tip nearer than 5 mm to x = 20, but its way passes at 3 mm.
  attempt.go(-10, 40, 2);
  const Score score = attempt.scorer.score();
  EXPECT_NEAR(score.targets[0].closest_m, 3e-3F, 1e-7F);
  EXPECT_TRUE(score.targets[0].reached);
  EXPECT_FALSE(score.targets[1].reached);
  EXPECT_NEAR(score.targets[2].closest_m, 10e-3F, 1e-7F);
  EXPECT_FALSE(score.targets[2].reached);
  attempt.go(10, 10, 1, 6);
  EXPECT_TRUE(attempt.scorer.score().targets[2].reached);
  EXPECT_NEAR(attempt.scorer.score().targets[2].closest_m, 4e-3F, 1e-7F);
}

// The tip goes past a zone on which the shaft then leans, and stops short of a target beside it.
TEST(Score, TheShaftTouchesAZoneButReachesNoTarget) {
  const Vec3 beside = {0.105F, 0.004F, 0};
  DrawnAttempt attempt({{"vessel", beside, 0.003F, true}, {"tumour", beside, 0.003F, false}});
  attempt.go(-10, 40, 500);
  EXPECT_FALSE(attempt.scorer.score().targets[0].reached);
  attempt.at(40, 4);  // from the hand at 0: the shaft rises by 3 mm on the way to x = 105
  const Score score = attempt.scorer.score();
  EXPECT_NEAR(score.targets[0].closest_m, 1e-3F, 1e-5F);
  EXPECT_TRUE(score.targets[0].reached);
  EXPECT_NEAR(score.targets[1].closest_m, 4e-3F, 1e-7F);
  EXPECT_FALSE(score.targets[1].reached);
}

TEST(Score, TheTargetNearestToEitherNeedleCounts) {
  DrawnAttempt attempt({{"tumour", {0.1F, 0.02F, 0}, 0.001F, false}});
  attempt.at(0, 0, {}, 0);
  attempt.at(0, 17, {}, 1);
  EXPECT_NEAR(attempt.scorer.score().targets[0].closest_m, 3e-3F, 1e-7F);
  EXPECT_DOUBLE_EQ(attempt.scorer.score().duration_s, 1e-3);  // one tick, two needles
}

TEST(Score, Forces) {
  DrawnAttempt attempt;
  attempt.at(-1, 0, {0, 0, 4});  // in air: it counts as a peak, but not in the mean
  attempt.at(1, 0, {-3, 4, 0});  // 5 N, 4 of them across
  attempt.at(2, 0, {-1, 0, 0});
  attempt.at(3, 0, {-7, 0, 0});
  const Score score = attempt.scorer.score();
  EXPECT_FLOAT_EQ(score.peak_force_n, 7);
  EXPECT_FLOAT_EQ(score.peak_lateral_n, 4);
  EXPECT_DOUBLE_EQ(score.mean_force_n, 13.0 / 3);
}

TEST(Score, FaultsAreCountedWhenTheyLatch) {
  DrawnAttempt attempt;
  attempt.at(0);
  attempt.fault = Fault::kTooFast;
  attempt.go(0, 1, 5);
  attempt.fault = Fault::kNone;  // rearmed
  attempt.at(1);
  attempt.fault = Fault::kBuzz;
  attempt.go(1, 2, 5);
  EXPECT_EQ(attempt.scorer.score().faults, 2U);
}

TEST(Score, PuncturesAreKeptUpToALimitAndCounted) {
  DrawnAttempt attempt;
  attempt.scorer.add(Event{5, EventKind::kLayer, 1, 0, 0, 0, 0});
  attempt.scorer.add(Event{7, EventKind::kPuncture, 2, 0.01F, 1.5F, 1, 0});
  Score score = attempt.scorer.score();
  ASSERT_EQ(score.punctures.size(), 1U);
  EXPECT_EQ(score.punctures[0].tick, 7U);
  EXPECT_EQ(score.punctures[0].layer, 2U);
  EXPECT_EQ(score.punctures[0].needle, 1U);
  EXPECT_EQ(score.punctures[0].force_n, 1.5F);
  for (int i = 0; i < 1000; ++i) attempt.scorer.add(Event{8, EventKind::kPuncture, 0, 0, 0, 0, 0});
  score = attempt.scorer.score();
  EXPECT_EQ(score.punctures.size(), kMaxScoredPunctures);
  EXPECT_EQ(score.puncture_count, 1001U);
}

TEST(Score, OfNoTicksIsZero) {
  const Score score = DrawnAttempt({{"tumour", {}, 1, false}}).scorer.score();
  EXPECT_EQ(score.duration_s, 0);
  EXPECT_EQ(score.mean_force_n, 0);
  EXPECT_EQ(score.targets[0].closest_m, std::numeric_limits<float>::infinity());
  EXPECT_FALSE(score.targets[0].reached);
}

// Why a scene with this text is refused; empty: it is accepted.
std::string refusal(const std::string& text) {
  try {
    (void)parse_targets(text, "s.toml");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(Targets, AreReadInMillimetres) {
  const auto targets = parse_targets(
      "[[targets]]\nname = \"tumour\"\nat_mm = [1, 2, 3]\nradius_mm = 4\n"
      "[[targets]]\nname = \"aorta\"\nat_mm = [0, 0, 0]\nradius_mm = 9\nforbidden = true\n",
      "s.toml");
  ASSERT_EQ(targets.size(), 2U);
  EXPECT_EQ(targets[0].name, "tumour");
  EXPECT_EQ(targets[0].position_m.z, 0.003F);
  EXPECT_EQ(targets[0].radius_m, 0.004F);
  EXPECT_FALSE(targets[0].forbidden);
  EXPECT_TRUE(targets[1].forbidden);
}

TEST(Targets, MistakesNameTheirLine) {
  const std::string good = "[[targets]]\nname = \"a\"\nat_mm = [0, 0, 0]\nradius_mm = 1\n";
  EXPECT_EQ(refusal(good), "");
  EXPECT_EQ(refusal(good + good),
            "s.toml:6: targets.name: 'a': expected a name that no target before it has");
  EXPECT_EQ(refusal("[[targets]]\nname = \"a\"\nradius_mm = 1\n"),
            "s.toml:1: targets.at_mm: missing: expected a list of 3 numbers: where its middle is");
  EXPECT_EQ(refusal("[[targets]]\nname = \"a\"\nat_mm = [0, 0, 0]\n"),
            "s.toml:1: targets.radius_mm: missing: expected a number from 0.1 to 1000");
  EXPECT_EQ(refusal("[[targets]]\nname = \"\"\nat_mm = [0, 0, 0]\nradius_mm = 1\n"),
            "s.toml:2: targets.name: '': expected a text of 1 to 40 bytes in one line");
  EXPECT_EQ(
      refusal(good + "colour = \"red\"\n"),
      "s.toml:5: targets.colour: 'red': expected one of the known keys at_mm, forbidden, name, "
      "radius_mm");
  EXPECT_EQ(refusal(good + "forbidden = 1\n"),
            "s.toml:5: targets.forbidden: 1: expected true or false");
  std::string many;
  for (std::size_t i = 0; i <= kMaxTargets; ++i) {
    many += "[[targets]]\nname = \"" + std::to_string(i) + "\"\nat_mm = [0, 0, 0]\nradius_mm = 1\n";
  }
  EXPECT_EQ(refusal(many), "s.toml:130: targets.name: '32': expected at most 32 targets");
}

}  // namespace
}  // namespace stylet::hal
