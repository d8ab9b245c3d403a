// SPDX-License-Identifier: Apache-2.0
// Scores an attempt, over all needles together: how long it took, the way, how deep into what, how
// near to the targets, and with what force.
//
// Targets are positions in the organ at rest: they are not physics, never reach the kernel and do
// not move with the tissue. Promises: add() allocates nothing and takes bounded time; the same
// records and events, in any order of needles, give the same score. Units: SI. Frame: world.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "hal/loop/record.h"
#include "stylet/kernel.h"

namespace stylet::hal {

constexpr std::size_t kMaxTargets = 32;          // in a scene; more are refused
constexpr std::size_t kMaxScoredPunctures = 64;  // kept of an attempt; more are only counted
// Step in which the tip's path is measured: smaller motions count as noise of the device. A sharp
// turn loses at most two of these steps.
constexpr double kRulerM = 1e-4;
// Way back that counts as a withdrawal, and way in again that must come before the next one.
constexpr double kWithdrawalM = 1e-3;

struct Target {
  std::string name;
  Vec3 position_m = {};
  float radius_m = 0;
  bool forbidden = false;  // a zone that must not be entered
};

struct PunctureScore {
  std::uint64_t tick;
  std::uint32_t needle;
  std::uint32_t layer;  // index of the organ's material
  float force_n;        // along the shaft
};

struct TargetScore {
  // Least distance ever between a tip and its centre. For a forbidden zone also of the shaft, taken
  // as straight from hand to tip: for a bent needle this is its chord.
  float closest_m = std::numeric_limits<float>::infinity();
  bool reached = false;  // a tip was inside; for a forbidden zone: it was touched
};

struct Score {
  double duration_s = 0;
  double path_m = 0;        // length of the tips' paths
  double depth_path_m = 0;  // the part of it that was in tissue
  std::uint64_t puncture_count = 0;
  std::vector<PunctureScore> punctures;  // the first kMaxScoredPunctures
  std::uint32_t withdrawals = 0;         // turns from in to out, along the course, in tissue
  std::vector<TargetScore> targets;      // in the order of the scene
  float peak_force_n = 0;                // on the hand
  float peak_lateral_n = 0;              // the part of the force across the course
  double mean_force_n = 0;               // while in tissue
  std::uint32_t faults = 0;              // latched by a guard
};

class Scorer {
 public:
  // `courses`: one for each needle.
  Scorer(std::span<const Target> targets, std::span<const Course> courses, double period_s);
  void add(const TickRecord& record);
  void add(const Event& event);
  Score score() const;

 private:
  // Follows the motion of one needle's tip.
  struct Tip {
    Course course = {};
    bool seen = false;
    Vec3 last_m = {};
    Vec3 ruler_m = {};  // where the last whole step ended
    bool in_tissue = false;
    double furthest_m = 0, nearest_m = 0;  // along the course, since the last turn
    bool withdrawn = false;
    Fault fault = Fault::kNone;
  };

  void measure(Tip& tip, Vec3 tip_m, bool in_tissue);
  void watch_turns(Tip& tip, double travel_m, bool in_tissue);
  void approach_targets(Vec3 hand_m, Vec3 from_m, Vec3 to_m);
  void weigh(const Tip& tip, const Output& output);

  std::vector<Target> targets_;
  std::array<Tip, kMaxNeedles> tips_;
  double period_s_;
  Score score_;  // without what is known only at the end
  std::uint64_t ticks_ = 0, tissue_ticks_ = 0;
  double tissue_force_n_ = 0;  // a sum
};

}  // namespace stylet::hal
