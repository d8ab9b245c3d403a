// SPDX-License-Identifier: GPL-3.0-or-later
// How fine an organ may be if a tick is to meet its period, and how much mass the step then adds.
//
// Cost of a tick: start + (sweep + pass x passes) x voxels x substeps, with the needle in the
// tissue. Voxels are those that the kernel sweeps (voxels/sweep.h), passes are those of the filter
// with true mass. The cost is fitted to results of stylet-bench on a machine (tests/bench/results)
// or measured here on two blocks. Mass: what the kernel reports that its bound for a stable step
// adds to each material.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "base/progress.h"
#include "stylet/kernel.h"

namespace stylet::offline {

struct Machine {
  std::string name;
  double start_us = 0;
  double us_per_voxel_substep = 0;  // without passes
  double us_per_voxel_pass = 0;
  bool is_here = false;  // it is this machine, on which an organ can be timed
};

// How a scene steps an organ: its loop.period_us, loop.substeps and loop.inertia.
struct Stepping {
  double period_s = 1e-3;
  std::uint32_t substeps = Config{}.substeps;
  Inertia inertia = Config{}.inertia;
};

// Fraction of the period that the kernel may use; the rest is for the device and for slow ticks.
constexpr double kShareOfPeriod = 0.5;

Machine read_machine(const std::filesystem::path& bench_csv);
Machine measure_machine(const Progress& progress);

// Median time of a tick on this machine, in us, with an elastic needle about 40 mm deep, along z
// through the middle; no value if that needle would miss the organ.
std::optional<double> time_tick(const Organ& organ, const Stepping& stepping);

// Passes of the filter that the organ's stiffest tissue needs.
std::uint32_t passes_of(const Organ& organ, const Stepping& stepping);
double tick_us(const Machine& machine, double voxels, std::uint32_t substeps, std::uint32_t passes);
// Assumes the highest number of passes: before the organ is built, nobody knows how many it needs.
// Organs with several levels may need more. Refuses a period too short for any voxel.
std::uint32_t most_voxels(const Machine& machine, const Stepping& stepping,
                          bool has_levels = false);

// Period in seconds of "1kHz", "500 Hz"; refuses rates at which the kernel does not run.
double period_of(const std::string& rate);

// "period_us", "substeps", "inertia", and "resonance" of the organ as it is stepped. Takes some
// seconds for 70 000 voxels; the time is proportional to their number.
nlohmann::ordered_json inertia_facts(const Organ& organ, const Stepping& stepping);
// The same, and a row for 1, 2, 4, ... substeps with true mass and with added mass: passes, the
// factor by which each material's mass grows, and, if a machine is given, the time of a tick, which
// is timed on the organ itself if it is this machine.
nlohmann::ordered_json speed_facts(const Organ& organ, const Stepping& stepping,
                                   const Machine* machine);
// "1 substep of true mass".
std::string stepping_text(const nlohmann::ordered_json& facts);
// One line: what a hand feels of the step's inertia, and from which frequency on. No line for an
// organ that nothing holds.
std::string inertia_text(const nlohmann::ordered_json& facts);
std::string speed_text(const nlohmann::ordered_json& facts);

}  // namespace stylet::offline
