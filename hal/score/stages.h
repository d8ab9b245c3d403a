// SPDX-License-Identifier: Apache-2.0
// The stages of an insertion, found from a force curve: approach, contact, puncture, insertion,
// hold, retraction, exit.
//
// Pure function over plain data, so that a run, a plot and a test find the same stages.
// Units: SI, slopes in N/mm as in the literature. Axial force is positive where the tissue resists
// the needle on its way in.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hal/loop/record.h"
#include "stylet/kernel.h"

namespace stylet::hal {

enum class Stage : std::uint32_t {
  kApproach,
  kContact,
  kPuncture,
  kInsertion,
  kHold,
  kRetraction,
  kExit
};
const char* stage_name(Stage stage);

// One tick of a curve.
struct TrackPoint {
  std::uint64_t tick;
  float axial_n;
  float depth_m;   // length of the needle in the tissue
  float travel_m;  // of the tip, beyond the first contact with the organ at rest
  Phase phase;
};
TrackPoint track_point(const TickRecord& record, const Course& course);

struct StageRow {
  Stage stage;
  std::uint64_t start_tick, end_tick;  // [start, end)
  float depth_m;                       // greatest length of the needle in the tissue
  float travel_m;                      // at the end
  float peak_force_n;                  // axial force farthest from zero, with its sign
  float mean_force_n;
  float start_force_n;  // in the last tick before the stage
  float end_force_n;    // in the last tick of the stage
  // Least squares of axial force over depth, taken where the tip moves at a steady pace that the
  // tissue has taken up and the shaft slides; NaN for stages at rest and if depth changes by less
  // than 1 mm there.
  float slope_n_per_mm;
  // The tip's path before the whole shaft slides: until then friction carries the tissue along and
  // the slope is that of the tissue's stiffness. NaN for stages at rest.
  float presliding_m;
};

// The fraction of its starting force that the tissue has released at the end of a stage, 0 to 1, if
// the force falls without changing sign. nullopt if it rises, changes sign or was too small to be
// felt at the start.
std::optional<double> fallen_fraction(const StageRow& row);

// `unit_m`: needle unit; the slope leaves out the first needle unit after the puncture.
std::vector<StageRow> find_stages(std::span<const TrackPoint> track, double period_s, float unit_m);

}  // namespace stylet::hal
