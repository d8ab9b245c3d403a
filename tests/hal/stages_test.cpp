// SPDX-License-Identifier: Apache-2.0
// Curves are made by formulas, so that every number of a phase is known.
#include "hal/score/stages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace stylet::hal {
namespace {

constexpr double kPeriodS = 1e-3;
constexpr float kUnitM = 5e-3F;
constexpr int kContact = 1000, kPuncture = 1800, kLowest = 1820, kHold = 7000, kRetract = 10000,
              kOut = 16000, kEnd = 17000;

// 10 mm/s in, from 10 mm outside; a puncture 8 mm deep at 0.8 N; then 0.01 N/mm; 3 s of rest; and
// back.
TrackPoint point(int tick) {
  const double travel_mm =
      tick < kRetract ? std::min((tick - kContact) * 0.01, 60.0) : 60 - (tick - kRetract) * 0.01;
  const bool in = tick >= kPuncture && tick < kOut;
  const double depth_mm = in ? travel_mm : 0;
  double force = 0;
  Phase phase = Phase::kFree;
  if (tick >= kContact && tick < kPuncture) {
    force = 0.1 * travel_mm;
    phase = Phase::kContact;
  } else if (in && tick < kHold) {
    const double fall = tick < kLowest ? 0.4 * (kLowest - tick) / 20.0 : 0;
    force = 0.2 + 0.01 * depth_mm + fall;
    phase = Phase::kInserted;
  } else if (in && tick <= kRetract) {
    force = 0.8 - 0.2 * (1 - std::exp(-(tick - kHold) * 1e-3 / 0.5));
    phase = Phase::kInserted;
  } else if (in) {
    force = -0.01 * depth_mm;
    phase = Phase::kRetracting;
  }
  return {static_cast<std::uint64_t>(tick) + 1, static_cast<float>(force),
          static_cast<float>(depth_mm * 1e-3), static_cast<float>(travel_mm * 1e-3), phase};
}

std::vector<TrackPoint> curve(int begin = 0, int end = kEnd) {
  std::vector<TrackPoint> track;
  for (int tick = begin; tick < end; ++tick) track.push_back(point(tick));
  return track;
}

std::vector<Stage> stages(const std::vector<StageRow>& rows) {
  std::vector<Stage> list;
  for (const StageRow& row : rows) list.push_back(row.stage);
  return list;
}

TEST(Phases, AllSevenInOrderWithoutGaps) {
  const auto rows = find_stages(curve(), kPeriodS, kUnitM);
  ASSERT_THAT(stages(rows), testing::ElementsAre(Stage::kApproach, Stage::kContact,
                                                 Stage::kPuncture, Stage::kInsertion, Stage::kHold,
                                                 Stage::kRetraction, Stage::kExit));
  EXPECT_EQ(rows.front().start_tick, 1U);
  EXPECT_EQ(rows.back().end_tick, static_cast<std::uint64_t>(kEnd) + 1);
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_EQ(rows[i].start_tick, rows[i - 1].end_tick);
}

TEST(Phases, BoundariesAreWhereTheCurveChanges) {
  const auto rows = find_stages(curve(), kPeriodS, kUnitM);
  ASSERT_EQ(rows.size(), 7U);
  const auto start = [&rows](int i) {
    return static_cast<double>(rows[static_cast<std::size_t>(i)].start_tick) - 1;
  };
  EXPECT_EQ(start(1), kContact);
  EXPECT_EQ(start(2), kPuncture);
  EXPECT_NEAR(start(3), kLowest, 1);
  EXPECT_NEAR(start(4), kHold, 3);
  EXPECT_NEAR(start(5), kRetract, 3);
  EXPECT_EQ(start(6), kOut);
}

TEST(Phases, NumbersAreThoseOfTheFormula) {
  const auto rows = find_stages(curve(), kPeriodS, kUnitM);
  ASSERT_EQ(rows.size(), 7U);
  const StageRow &contact = rows[1], &puncture = rows[2], &insertion = rows[3], &hold = rows[4],
                 &retraction = rows[5];
  EXPECT_NEAR(static_cast<double>(contact.peak_force_n), 0.8, 0.002);
  EXPECT_NEAR(static_cast<double>(contact.mean_force_n), 0.4, 0.002);
  EXPECT_NEAR(static_cast<double>(contact.travel_m), 8e-3, 2e-5);
  EXPECT_NEAR(static_cast<double>(puncture.start_force_n), 0.8, 0.002);
  EXPECT_NEAR(static_cast<double>(puncture.end_force_n), 0.282, 0.002);
  EXPECT_NEAR(static_cast<double>(insertion.slope_n_per_mm), 0.01, 1e-4);
  EXPECT_NEAR(static_cast<double>(insertion.depth_m), 60e-3, 1e-4);
  EXPECT_NEAR(static_cast<double>(hold.end_force_n), 0.6, 0.002);
  EXPECT_NEAR(static_cast<double>(retraction.slope_n_per_mm), -0.01, 1e-4);
  EXPECT_NEAR(static_cast<double>(retraction.peak_force_n), -0.6, 0.01);
  EXPECT_TRUE(std::isnan(hold.slope_n_per_mm));
}

// The hand slows down over half a second, friction depends on its speed, and the tissue springs
// back for a moment after the puncture: the slope is that of the steady part in between.
TEST(Phases, SlopeIsThatOfTheSteadyPart) {
  constexpr double kSlow = 6500, kTicksToSlow = 150;
  std::vector<TrackPoint> track = curve(0, kRetract);
  for (TrackPoint& p : track) {
    const double tick = static_cast<double>(p.tick) - 1;
    if (tick < kLowest) continue;
    const double slowing = std::max(0.0, tick - kSlow) / kTicksToSlow;
    const double fraction_of_speed = std::exp(-slowing);
    const double travel_mm =
        (std::min(tick, kSlow) - kContact + kTicksToSlow * (1 - fraction_of_speed)) * 0.01;
    const double recoil = 0.2 * std::exp(-(tick - kLowest) / 100);
    p.travel_m = p.depth_m = static_cast<float>(travel_mm * 1e-3);
    p.axial_n = static_cast<float>(0.2 + recoil + (0.007 + 0.003 * fraction_of_speed) * travel_mm);
  }
  const auto rows = find_stages(track, kPeriodS, kUnitM);
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[3].stage, Stage::kInsertion);
  EXPECT_NEAR(static_cast<double>(rows[3].slope_n_per_mm), 0.01, 1e-4);
}

TEST(Phases, AQuickInsertionHasASlope) {
  std::vector<TrackPoint> track;
  for (int tick = kLowest; tick < kLowest + 150; ++tick) {
    track.push_back(point(tick));
    track.back().travel_m = track.back().depth_m = static_cast<float>(tick - kLowest) * 4e-4F;
    track.back().axial_n = track.back().depth_m * 10;
  }
  const auto rows = find_stages(track, kPeriodS, kUnitM);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_NEAR(static_cast<double>(rows[0].slope_n_per_mm), 0.01, 1e-5);
}

// As above, but from 10 s on the hand pulls at a spring, and friction lets the tip go bit by bit:
// 1.5 mm in 0.7 s.
TEST(Phases, HoldEndsWhereTheHandTurns) {
  std::vector<TrackPoint> track = curve();
  for (int tick = kRetract; tick < kOut; ++tick) {
    TrackPoint& p = track[static_cast<std::size_t>(tick)];
    const double since_s = (tick - kRetract) * 1e-3, share = std::min(since_s / 0.7, 1.0);
    p.travel_m = since_s < 0.7 ? static_cast<float>(0.06 - 1.5e-3 * std::pow(share, 3))
                               : static_cast<float>(0.0585 * (1 - (since_s - 0.7) / 5.3));
    p.axial_n = static_cast<float>(0.6 - 1.2 * share);
  }
  const auto rows = find_stages(track, kPeriodS, kUnitM);
  ASSERT_EQ(rows[4].stage, Stage::kHold);
  EXPECT_EQ(rows[5].stage, Stage::kRetraction);
  // The hold ends when the tip has crept by 0.7 um: the window at 0.03 mm/s.
  EXPECT_NEAR(static_cast<double>(rows[4].end_tick) - 1, kRetract, 80);
  EXPECT_GT(rows[4].end_force_n, 0.45F);
}

TEST(Phases, ShortPausesAreNoHold) {
  std::vector<TrackPoint> track = curve();
  for (int i = 4000; i < 4060; ++i) {
    track[static_cast<std::size_t>(i)].travel_m = track[4000].travel_m;
  }
  EXPECT_EQ(find_stages(track, kPeriodS, kUnitM).size(), 7U);
}

TEST(Phases, AfterContactIsLostItIsApproachAgain) {
  std::vector<TrackPoint> track = curve(900, 1700);
  for (std::size_t i = 600; i < track.size(); ++i) track[i].phase = Phase::kFree;
  EXPECT_THAT(stages(find_stages(track, kPeriodS, kUnitM)),
              testing::ElementsAre(Stage::kApproach, Stage::kContact, Stage::kApproach));
}

TEST(Phases, GrazingTheSurfaceOnTheWayOutIsExit) {
  std::vector<TrackPoint> track = curve();
  for (std::size_t i = kOut + 4; i < kOut + 40; ++i) track[i].phase = Phase::kContact;
  EXPECT_EQ(find_stages(track, kPeriodS, kUnitM).size(), 7U);
}

TEST(Phases, AnyPieceOfACurveIsAccepted) {
  EXPECT_TRUE(find_stages({}, kPeriodS, kUnitM).empty());
  for (int begin = 0; begin < kEnd; begin += 613) {
    for (const int length : {1, 2, 30, 700}) {
      const auto track = curve(begin, std::min(begin + length, kEnd));
      const auto rows = find_stages(track, kPeriodS, kUnitM);
      ASSERT_FALSE(rows.empty());
      EXPECT_EQ(rows.front().start_tick, track.front().tick);
      EXPECT_EQ(rows.back().end_tick, track.back().tick + 1);
    }
  }
}

TEST(TrackPoint, ResistanceIsPositiveAndTravelCountsFromTheEntry) {
  TickRecord record{};
  record.output.tick = 7;
  record.output.force_n = {0, 0.5F, 0};
  record.output.tip_m = {1, 1.96F, 1};
  const TrackPoint p = track_point(record, {{1, 2, 1}, {0, -1, 0}});
  EXPECT_EQ(p.tick, 7U);
  EXPECT_EQ(p.axial_n, 0.5F);
  EXPECT_NEAR(static_cast<double>(p.travel_m), 0.04, 1e-6);
}

// ---- how much a force has fallen

StageRow from_to(float start_n, float end_n) {
  StageRow row = {};
  row.start_force_n = start_n;
  row.end_force_n = end_n;
  return row;
}

TEST(Phases, OnlyAForceThatFallsHasAFraction) {
  EXPECT_NEAR(fallen_fraction(from_to(0.8F, 0.6F)).value_or(-1), 0.25, 1e-6);
  EXPECT_NEAR(fallen_fraction(from_to(-2, -0.5F)).value_or(-1), 0.75, 1e-6);
  EXPECT_EQ(fallen_fraction(from_to(1, 0)), 1);
  EXPECT_EQ(fallen_fraction(from_to(1, 1)), 0);
  EXPECT_EQ(fallen_fraction(from_to(0.2F, 2.886F)), std::nullopt);  // no relaxation of -1343 %
  EXPECT_EQ(fallen_fraction(from_to(1, -0.1F)), std::nullopt);
  EXPECT_EQ(fallen_fraction(from_to(0.001F, 0.0005F)), std::nullopt);
  EXPECT_EQ(fallen_fraction(from_to(NAN, 1)), std::nullopt);
  EXPECT_EQ(fallen_fraction(from_to(1, NAN)), std::nullopt);
}

// Recordings of hands that do anything have rows without gaps, and no fraction outside 0 to 1.
TEST(Phases, RandomRecordingsHaveWholeRowsAndFractionsWithinTheirBounds) {
  std::mt19937 random(31);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 10'001) * 1e-4;
  };
  int shares = 0;
  for (int run = 0; run < 200; ++run) {
    std::vector<TrackPoint> track;
    double travel_m = -0.01, force_n = 0;
    auto phase = Phase::kFree;
    while (track.size() < 2000) {
      const double pace = random() % 3 == 0 ? 0 : between(-2e-4, 3e-4);
      const double push = between(-5e-3, 5e-3);
      if (random() % 3 == 0) phase = static_cast<Phase>(random() % 4);
      for (auto n = random() % 400; n > 0 && track.size() < 2000; --n) {
        travel_m += pace;
        force_n += push;
        track.push_back({track.size() + 1, static_cast<float>(force_n),
                         static_cast<float>(std::max(travel_m, 0.0)), static_cast<float>(travel_m),
                         phase});
      }
    }
    std::uint64_t next = 1;
    for (const StageRow& row : find_stages(track, kPeriodS, kUnitM)) {
      EXPECT_EQ(row.start_tick, next);
      next = row.end_tick;
      const std::optional<double> share = fallen_fraction(row);
      if (!share) continue;
      ++shares;
      EXPECT_GE(*share, 0);
      EXPECT_LE(*share, 1);
    }
    EXPECT_EQ(next, 2001U);
  }
  EXPECT_GT(shares, 100);
}

}  // namespace
}  // namespace stylet::hal
