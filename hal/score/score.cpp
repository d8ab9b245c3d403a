// SPDX-License-Identifier: Apache-2.0
#include "hal/score/score.h"

#include <algorithm>

#include "hal/base/wide.h"

namespace stylet::hal {
namespace {

double distance(Vec3 a, Vec3 b) {
  return length(wide(a) - wide(b));
}

// Distance of a point to the way between two ticks: so a fast tip cannot skip a small target.
double distance_to_way(Vec3 point, Vec3 from, Vec3 to) {
  const Eigen::Vector3d way = wide(to) - wide(from), off = wide(point) - wide(from);
  const double length2 = dot(way, way);
  const double share = length2 > 0 ? std::clamp(dot(off, way) / length2, 0.0, 1.0) : 0;
  return length(off - share * way);
}

}  // namespace

Scorer::Scorer(std::span<const Target> targets, std::span<const Course> courses, double period_s)
    : targets_(targets.begin(), targets.end()), period_s_(period_s) {
  for (std::size_t i = 0; i < std::min(courses.size(), tips_.size()); ++i) {
    tips_[i].course = courses[i];
  }
  score_.targets.resize(targets_.size());
  score_.punctures.reserve(kMaxScoredPunctures);
}

void Scorer::add(const TickRecord& record) {
  if (record.needle >= tips_.size()) return;
  Tip& tip = tips_[record.needle];
  const Output& out = record.output;
  const bool in_tissue = out.depth_m > 0;
  const double travel_m =
      dot(wide(out.tip_m) - wide(tip.course.entry_m), wide(tip.course.direction));
  if (!tip.seen) {
    tip.last_m = tip.ruler_m = out.tip_m;
    tip.furthest_m = tip.nearest_m = travel_m;
    tip.in_tissue = in_tissue;
    tip.seen = true;
  }
  measure(tip, out.tip_m, in_tissue);
  watch_turns(tip, travel_m, in_tissue);
  approach_targets(record.input.handle.position_m, tip.last_m, out.tip_m);
  weigh(tip, out);
  if (record.fault != tip.fault && record.fault != Fault::kNone) ++score_.faults;
  tip.fault = record.fault;
  tip.last_m = out.tip_m;
  if (record.needle == 0) ++ticks_;
}

void Scorer::add(const Event& event) {
  if (event.kind != EventKind::kPuncture) return;
  ++score_.puncture_count;
  if (score_.punctures.size() == kMaxScoredPunctures) return;
  score_.punctures.push_back({event.tick, event.needle, event.layer, event.force_n});
}

Score Scorer::score() const {
  Score result = score_;
  for (const Tip& tip : tips_) {
    const double rest_m = distance(tip.ruler_m, tip.last_m);
    result.path_m += rest_m;
    if (tip.in_tissue) result.depth_path_m += rest_m;
  }
  result.duration_s = static_cast<double>(ticks_) * period_s_;
  if (tissue_ticks_ > 0) result.mean_force_n = tissue_force_n_ / static_cast<double>(tissue_ticks_);
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    result.targets[i].reached = result.targets[i].closest_m <= targets_[i].radius_m;
  }
  return result;
}

void Scorer::measure(Tip& tip, Vec3 tip_m, bool in_tissue) {
  if (in_tissue != tip.in_tissue) {  // what began on the other side ends at the surface
    const double rest_m = distance(tip.ruler_m, tip.last_m);
    score_.path_m += rest_m;
    if (tip.in_tissue) score_.depth_path_m += rest_m;
    tip.ruler_m = tip.last_m;
    tip.in_tissue = in_tissue;
  }
  const double way_m = distance(tip.ruler_m, tip_m);
  if (way_m < kRulerM) return;
  score_.path_m += way_m;
  if (in_tissue) score_.depth_path_m += way_m;
  tip.ruler_m = tip_m;
}

void Scorer::watch_turns(Tip& tip, double travel_m, bool in_tissue) {
  tip.furthest_m = std::max(tip.furthest_m, travel_m);
  tip.nearest_m = std::min(tip.nearest_m, travel_m);
  if (!in_tissue) tip.furthest_m = travel_m;  // a way back outside is not a withdrawal
  if (!tip.withdrawn && travel_m <= tip.furthest_m - kWithdrawalM) {
    ++score_.withdrawals;
    tip.withdrawn = true;
    tip.nearest_m = travel_m;
  } else if (tip.withdrawn && travel_m >= tip.nearest_m + kWithdrawalM) {
    tip.withdrawn = false;
    tip.furthest_m = travel_m;
  }
}

void Scorer::approach_targets(Vec3 hand_m, Vec3 from_m, Vec3 to_m) {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Vec3 centre_m = targets_[i].position_m;
    double near_m = distance_to_way(centre_m, from_m, to_m);
    if (targets_[i].forbidden) near_m = std::min(near_m, distance_to_way(centre_m, hand_m, to_m));
    float& closest_m = score_.targets[i].closest_m;
    closest_m = std::min(closest_m, static_cast<float>(near_m));
  }
}

void Scorer::weigh(const Tip& tip, const Output& output) {
  const Eigen::Vector3d force = wide(output.force_n), course = wide(tip.course.direction);
  const double along_n = dot(force, course), force_n = length(force);
  const double lateral_n = length(force - along_n * course);
  score_.peak_force_n = std::max(score_.peak_force_n, static_cast<float>(force_n));
  score_.peak_lateral_n = std::max(score_.peak_lateral_n, static_cast<float>(lateral_n));
  if (!(output.depth_m > 0)) return;
  ++tissue_ticks_;
  tissue_force_n_ += force_n;
}

}  // namespace stylet::hal
