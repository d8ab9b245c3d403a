// SPDX-License-Identifier: Apache-2.0
#include "hal/score/stages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/base/vector.h"

namespace stylet::hal {
namespace {

constexpr double kSpeedWindowS = 0.025;    // over which the tip's speed is averaged
constexpr double kSlowFraction = 0.1;      // of the fastest: below it the hand has stopped
constexpr double kRestingFraction = 0.03;  // of the fastest: below it the hand has not started
constexpr double kCreepFraction = 0.003;   // of the fastest: below it the hand does not move
constexpr double kPunctureWindowS = 0.05;  // in which the force falls after the puncture
constexpr double kShortestStageS = 0.1;    // of stages told apart by speed
constexpr double kSlopeRangeM = 1e-3;      // a smaller change of depth gives no slope
constexpr double kSteadyFraction = 0.9;    // of the median speed: above it the tip keeps its pace
constexpr double kSettleS = 0.3;           // in which the tissue takes up a new pace
// For a sliding shaft: the tip's motion through the tissue over its own motion, taken over this
// length, which is a voxel or more because depth is uneven within one. In soft tissue a change of
// direction carries tissue along for many mm, because the shaft begins to slide part after part.
constexpr float kSlideWindowM = 5e-3F;
constexpr double kSlideFraction = 0.9;  // of what the stage reaches
constexpr double kLeastSlide = 0.75;    // below it nothing slides: tissue is still carried along
constexpr double kMostSlide = 1.5;      // above it tissue comes back, as after a puncture
constexpr double kFeltN = 0.02;         // less is not felt (GUARD.md), nor is a fraction of it

bool inside(Phase phase) {
  return phase == Phase::kInserted || phase == Phase::kRetracting;
}

bool by_speed(Stage stage) {
  return stage == Stage::kInsertion || stage == Stage::kHold || stage == Stage::kRetraction;
}

double speed(std::span<const TrackPoint> track, std::size_t from, std::size_t to, double period_s) {
  const double way =
      static_cast<double>(track[to].travel_m) - static_cast<double>(track[from].travel_m);
  return to > from ? way / (static_cast<double>(to - from) * period_s) : 0.0;
}

// Motion of the tip over a window of ticks.
struct Motion {
  std::span<const TrackPoint> track;
  std::size_t window;
  double period_s;
  double fastest_m_per_s = 0;
};

Motion motion_of(std::span<const TrackPoint> track, double period_s) {
  Motion motion{track, static_cast<std::size_t>(kSpeedWindowS / period_s) + 1, period_s};
  for (std::size_t i = motion.window; i < track.size(); ++i) {
    motion.fastest_m_per_s =
        std::max(motion.fastest_m_per_s, std::fabs(speed(track, i - motion.window, i, period_s)));
  }
  return motion;
}

// Still if the tip will be slow a moment later, or was almost at rest a moment before. So a hold
// begins where the hand stops, though the tip creeps while the force relaxes, and ends at the last
// tick at rest: no force of retraction counts as hold.
Stage stage_inside(const Motion& motion, std::size_t i) {
  const std::size_t low = i > motion.window ? i - motion.window : 0;
  const std::size_t high = std::min(i + motion.window, motion.track.size() - 1);
  const double before = speed(motion.track, low, i, motion.period_s);
  const double after = speed(motion.track, i, high, motion.period_s);
  const bool slow = high > i && std::fabs(after) <= kSlowFraction * motion.fastest_m_per_s;
  const bool resting = i > low && std::fabs(before) <= kRestingFraction * motion.fastest_m_per_s;
  if (slow || resting) return Stage::kHold;
  return (high > i ? after : before) > 0 ? Stage::kInsertion : Stage::kRetraction;
}

// The stage of each tick by itself; the puncture is where the force falls after the entry.
std::vector<Stage> classify(std::span<const TrackPoint> track, double period_s) {
  std::vector<Stage> stages(track.size(), Stage::kApproach);
  const Motion motion = motion_of(track, period_s);
  const auto fall_ticks = static_cast<std::size_t>(kPunctureWindowS / period_s) + 1;
  bool was_inside = false;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const Phase phase = track[i].phase;
    if (inside(phase)) {
      const bool entered = i == 0 || !inside(track[i - 1].phase);
      was_inside = true;
      if (entered && i > 0 && track[i - 1].phase == Phase::kContact) {
        std::size_t end = i, lowest = i;
        for (; end < track.size() && end < i + fall_ticks && inside(track[end].phase); ++end) {
          if (track[end].axial_n < track[lowest].axial_n) lowest = end;
        }
        for (; i < lowest; ++i) stages[i] = Stage::kPuncture;
        stages[i] = Stage::kPuncture;
        continue;
      }
      stages[i] = stage_inside(motion, i);
    } else if (phase == Phase::kContact) {
      // a tip that grazes the surface on its way out is leaving, not arriving
      const bool leaving = was_inside && stage_inside(motion, i) == Stage::kRetraction;
      stages[i] = leaving ? Stage::kExit : Stage::kContact;
    } else {
      stages[i] = was_inside ? Stage::kExit : Stage::kApproach;
    }
  }
  return stages;
}

bool opposite(Stage a, Stage b) {
  return (a == Stage::kInsertion && b == Stage::kRetraction) ||
         (a == Stage::kRetraction && b == Stage::kInsertion);
}

// A hand behind a soft spring pulls at the tip long before friction lets it go. So a hold between
// two motions ends where the tip begins to creep along the second one, not where it becomes fast.
void end_holds_at_the_turn(std::span<const TrackPoint> track, double period_s,
                           std::vector<Stage>& stages) {
  const Motion motion = motion_of(track, period_s);
  Stage before = Stage::kApproach;
  for (std::size_t begin = 0, end = 0; begin < stages.size(); begin = end) {
    while (end < stages.size() && stages[end] == stages[begin]) ++end;
    const bool turns = stages[begin] == Stage::kHold && end < stages.size() &&
                       opposite(before, stages[end]) && begin > motion.window;
    before = stages[begin];
    if (!turns) continue;
    const double way = stages[end] == Stage::kInsertion ? 1 : -1;
    for (std::size_t i = end; i-- > begin;) {
      const double pace = way * speed(track, i - motion.window, i, period_s);
      if (pace <= kCreepFraction * motion.fastest_m_per_s) break;
      stages[i] = stages[end];
    }
  }
}

// A stage found by speed that is too short for a person to call it one joins the one before it.
void merge_short(std::vector<Stage>& stages, double period_s) {
  const auto shortest = static_cast<std::size_t>(kShortestStageS / period_s);
  std::size_t begin = 0;
  while (begin < stages.size()) {
    std::size_t end = begin;
    while (end < stages.size() && stages[end] == stages[begin]) ++end;
    const bool follows = begin > 0 && by_speed(stages[begin - 1]);
    if (by_speed(stages[begin]) && follows && end - begin < shortest) {
      std::fill(stages.begin() + static_cast<std::ptrdiff_t>(begin),
                stages.begin() + static_cast<std::ptrdiff_t>(end), stages[begin - 1]);
    }
    begin = end;
  }
}

// The part in which force depends on depth alone: the tip keeps its pace and the tissue has taken
// it up. Other parts would tilt the line by percents: the recoil after the puncture, the reversal
// of friction when a retraction starts and the slowing hand at the end.
std::span<const TrackPoint> steady_part(std::span<const TrackPoint> part, double period_s) {
  const auto half = static_cast<std::size_t>(0.5 * kSpeedWindowS / period_s) + 1;
  if (part.size() <= 2 * half) return {};
  std::vector<double> pace;
  for (std::size_t i = half; i + half < part.size(); ++i) {
    pace.push_back(std::fabs(speed(part, i - half, i + half, period_s)));
  }
  std::vector<double> sorted = pace;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const auto keeps = [least = kSteadyFraction * *middle](double v) { return v >= least; };
  const auto first = std::find_if(pace.begin(), pace.end(), keeps);
  const auto last = std::find_if(pace.rbegin(), pace.rend(), keeps).base();
  const auto length = static_cast<std::size_t>(last - first);
  const std::size_t settle = std::min(static_cast<std::size_t>(kSettleS / period_s), length / 3);
  return part.subspan(half + static_cast<std::size_t>(first - pace.begin()) + settle,
                      length - settle);
}

// The first point from which the shaft slides to the end; the size of the part if there is none.
std::size_t sliding_from(std::span<const TrackPoint> part) {
  struct Window {
    std::size_t end;
    double share;  // of the tip's own way
  };
  std::vector<Window> windows;
  std::vector<double> shares;
  for (std::size_t begin = 0, end = 0; begin < part.size(); ++begin) {
    const auto way = [&] { return std::fabs(part[end].travel_m - part[begin].travel_m); };
    while (end < part.size() && way() < kSlideWindowM) ++end;
    if (end == part.size()) break;
    const float deeper_m = std::fabs(part[end].depth_m - part[begin].depth_m);
    windows.push_back({end, static_cast<double>(deeper_m / way())});
    shares.push_back(windows.back().share);
  }
  if (windows.empty()) return 0;
  const auto high = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() * 9 / 10);
  std::nth_element(shares.begin(), high, shares.end());
  const double least = std::max(kLeastSlide, kSlideFraction * std::min(1.0, *high));
  const auto slides = [least](double share) { return share >= least && share <= kMostSlide; };
  std::size_t from = 0;
  for (const Window& each : windows) {
    if (!slides(each.share)) from = each.end;
  }
  return slides(windows.back().share) ? from : part.size();
}

float slope(std::span<const TrackPoint> part, float skip_below_m) {
  double n = 0, sum_x = 0, sum_y = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto used = [&](const TrackPoint& p) { return p.depth_m > 0 && p.depth_m >= skip_below_m; };
  for (const TrackPoint& p : part) {
    if (!used(p)) continue;
    const double x = static_cast<double>(p.depth_m) * 1e3;
    n += 1;
    sum_x += x;
    sum_y += static_cast<double>(p.axial_n);
    low = std::min(low, x);
    high = std::max(high, x);
  }
  if (n < 3 || high - low < kSlopeRangeM * 1e3) return std::numeric_limits<float>::quiet_NaN();
  double xx = 0, xy = 0;
  for (const TrackPoint& p : part) {
    if (!used(p)) continue;
    const double x = static_cast<double>(p.depth_m) * 1e3 - sum_x / n;
    xx += x * x;
    xy += x * (static_cast<double>(p.axial_n) - sum_y / n);
  }
  return static_cast<float>(xy / xx);
}

StageRow row_of(Stage stage, std::span<const TrackPoint> part, double period_s, float unit_m) {
  StageRow row{};
  row.stage = stage;
  row.start_tick = part.front().tick;
  row.end_tick = part.back().tick + 1;
  double sum = 0;
  for (const TrackPoint& p : part) {
    row.depth_m = std::max(row.depth_m, p.depth_m);
    if (std::fabs(p.axial_n) > std::fabs(row.peak_force_n)) row.peak_force_n = p.axial_n;
    sum += static_cast<double>(p.axial_n);
  }
  row.travel_m = part.back().travel_m;
  row.mean_force_n = static_cast<float>(sum / static_cast<double>(part.size()));
  row.end_force_n = part.back().axial_n;
  const bool moving = stage == Stage::kInsertion || stage == Stage::kRetraction;
  row.slope_n_per_mm = row.presliding_m = std::numeric_limits<float>::quiet_NaN();
  if (!moving) return row;
  const std::size_t slides = sliding_from(part);
  row.presliding_m =
      std::fabs(part[std::min(slides, part.size() - 1)].travel_m - part.front().travel_m);
  row.slope_n_per_mm =
      slope(steady_part(part.subspan(slides), period_s), stage == Stage::kInsertion ? unit_m : 0);
  return row;
}

}  // namespace

const char* stage_name(Stage stage) {
  switch (stage) {
    case Stage::kApproach:
      return "approach";
    case Stage::kContact:
      return "contact";
    case Stage::kPuncture:
      return "puncture";
    case Stage::kInsertion:
      return "insertion";
    case Stage::kHold:
      return "hold";
    case Stage::kRetraction:
      return "retraction";
    case Stage::kExit:
      return "exit";
  }
  return "unknown";
}

TrackPoint track_point(const TickRecord& record, const Course& course) {
  const Output& out = record.output;
  const Vec3 d = course.direction;
  return {out.tick, -dot(out.force_n, d), out.depth_m, dot(out.tip_m - course.entry_m, d),
          out.phase};
}

std::optional<double> fallen_fraction(const StageRow& row) {
  const auto start = static_cast<double>(row.start_force_n);
  const auto end = static_cast<double>(row.end_force_n);
  if (!(std::fabs(start) >= kFeltN)) return std::nullopt;
  const double left = end / start;
  if (!(left >= 0 && left <= 1)) return std::nullopt;
  return 1 - left;
}

std::vector<StageRow> find_stages(std::span<const TrackPoint> track, double period_s,
                                  float unit_m) {
  std::vector<Stage> stages = classify(track, period_s);
  merge_short(stages, period_s);
  end_holds_at_the_turn(track, period_s, stages);
  std::vector<StageRow> rows;
  for (std::size_t begin = 0; begin < track.size();) {
    std::size_t end = begin;
    while (end < track.size() && stages[end] == stages[begin]) ++end;
    rows.push_back(row_of(stages[begin], track.subspan(begin, end - begin), period_s, unit_m));
    rows.back().start_force_n = track[begin > 0 ? begin - 1 : 0].axial_n;
    begin = end;
  }
  return rows;
}

}  // namespace stylet::hal
