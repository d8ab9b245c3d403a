// SPDX-License-Identifier: Apache-2.0
// What an attempt came to: how long, which way, how deep into what, how near to the targets, with
// what force. Of all needles together.
//
// Targets are places in the organ at rest: they are no physics, never reach the kernel and do not
// move with the tissue. Promises: add() allocates nothing and takes bounded time; the same records
// and events in any order of needles give the same score. Units: SI. Frame: world.
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

constexpr std::size_t kMaxTargets = 32;          // of a scene; more: it is refused
constexpr std::size_t kMaxScoredPunctures = 64;  // kept of an attempt; more are only counted
// Ruler that the tip's way is measured with: noise of a device below it is no way. A sharp turn
// loses at most two of it.
constexpr double kRulerM = 1e-4;
// Way back that makes a withdrawal, and way in again before the next one counts.
constexpr double kWithdrawalM = 1e-3;

struct Target {
  std::string name;
  Vec3 position_m = {};
  float radius_m = 0;
  bool forbidden = false;  // a zone to keep out of
};

struct PunctureScore {
  std::uint64_t tick;
  std::uint32_t needle;
  std::uint32_t layer;  // material of the organ
  float force_n;        // along the shaft
};

struct TargetScore {
  // Of a tip to its centre, ever; to a forbidden zone's also of the shaft, straight from the hand
  // to the tip: a bent needle's is its chord.
  float closest_m = std::numeric_limits<float>::infinity();
  bool reached = false;  // a tip was inside; of a forbidden zone, that it was touched
};

struct Score {
  double duration_s = 0;
  double path_m = 0;        // way of the tips
  double depth_path_m = 0;  // the part of it in tissue
  std::uint64_t puncture_count = 0;
  std::vector<PunctureScore> punctures;  // the first kMaxScoredPunctures
  std::uint32_t withdrawals = 0;         // turns from in to out along the course, in tissue
  std::vector<TargetScore> targets;      // as in the scene
  float peak_force_n = 0;                // on the hand
  float peak_lateral_n = 0;              // the part of it across the course
  double mean_force_n = 0;               // while in tissue
  std::uint32_t faults = 0;              // latched by a guard
};

class Scorer {
 public:
  // `courses`: of each needle.
  Scorer(std::span<const Target> targets, std::span<const Course> courses, double period_s);
  void add(const TickRecord& record);
  void add(const Event& event);
  Score score() const;

 private:
  // A needle's tip on its way.
  struct Tip {
    Course course = {};
    bool seen = false;
    Vec3 last_m = {};
    Vec3 ruler_m = {};  // its last whole place
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
  Score score_;  // without what only the end tells
  std::uint64_t ticks_ = 0, tissue_ticks_ = 0;
  double tissue_force_n_ = 0;  // sum
};

}  // namespace stylet::hal
