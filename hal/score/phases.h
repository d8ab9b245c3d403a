// SPDX-License-Identifier: Apache-2.0
// The phases of an insertion, read off a force curve: approach, contact, puncture, insertion, hold,
// retraction, exit.
//
// Pure function over plain data, so that a run, a plot and a test see the same phases.
// Units: SI, slopes in N/mm as in the literature. Axial force: positive where the tissue resists
// the needle's way in.
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
  float depth_m;   // needle length in the tissue
  float travel_m;  // of the tip beyond the first contact with the organ at rest
  Phase phase;
};
TrackPoint track_point(const TickRecord& record, const Course& course);

struct PhaseRow {
  Stage stage;
  std::uint64_t start_tick, end_tick;  // [start, end)
  float depth_m;                       // largest needle length in the tissue
  float travel_m;                      // at the end
  float peak_force_n;                  // axial force furthest from zero, with its sign
  float mean_force_n;
  float start_force_n;  // at the last tick before
  float end_force_n;    // at the last tick of the phase
  // Least squares of axial force over depth, where the tip moves at a steady pace that the tissue
  // has taken up and the shaft slides; NaN for phases at rest and where depth changes by less than
  // 1 mm there.
  float slope_n_per_mm;
  // Of the tip, before the shaft slides all along: until then friction takes the tissue along, and
  // its slope is the tissue's stiffness. NaN for phases at rest.
  float presliding_m;
};

// How much of the force at its start the tissue has let go of at the end of a phase, 0 to 1: a
// force that falls and stays on its side. None of one that rises, turns or was not felt to begin
// with.
std::optional<double> fallen_share(const PhaseRow& row);

// `unit_m`: sampling unit of the needle; the slope leaves out the first unit after the puncture.
std::vector<PhaseRow> find_phases(std::span<const TrackPoint> track, double period_s, float unit_m);

}  // namespace stylet::hal
