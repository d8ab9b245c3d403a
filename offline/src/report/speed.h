// SPDX-License-Identifier: GPL-3.0-or-later
// How fine an organ may be for a tick to meet its period, and what the step then does to its mass.
//
// Cost of a tick: start + (sweep + pass x passes) x voxels x substeps, with the needle in the
// tissue, over the voxels that the kernel sweeps (voxels/sweep.h); passes are those of the filter,
// with true mass. Fitted to what stylet-bench wrote on a machine (tests/bench/results), or measured
// here on two blocks. Mass: the kernel's own report of what its bound for a stable step adds to
// each material.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "base/progress.h"
#include "stylet/kernel.h"

namespace stylet::bake {

struct Machine {
  std::string name;
  double start_us = 0;
  double us_per_voxel_substep = 0;  // without passes
  double us_per_voxel_pass = 0;
  bool is_here = false;  // so that an organ can be timed on it
};

// How a scene steps an organ: loop.period_us, loop.substeps, loop.inertia.
struct Stepping {
  double period_s = 1e-3;
  std::uint32_t substeps = Config{}.substeps;
  Inertia inertia = Config{}.inertia;
};

// Part of the period that the kernel may take; the rest is for the device and for slow ticks.
constexpr double kShareOfPeriod = 0.5;

Machine read_machine(const std::filesystem::path& bench_csv);
Machine measure_machine(const Progress& progress);

// Median of a tick, here, in us, with an elastic needle about 40 mm deep that comes along z through
// the middle; none where it would miss the organ.
std::optional<double> time_tick(const Organ& organ, const Stepping& stepping);

// Passes of the filter that the organ's stiffest tissue needs.
std::uint32_t passes_of(const Organ& organ, const Stepping& stepping);
double tick_us(const Machine& machine, double voxels, std::uint32_t substeps, std::uint32_t passes);
// With as many passes as there may be, for an organ has not been built that says how many it needs.
// Refuses a period that leaves no room for any.
std::uint32_t most_voxels(const Machine& machine, const Stepping& stepping);

// "1kHz", "500 Hz" to seconds; refuses what the kernel does not run at.
double period_of(const std::string& rate);

// "period_us", "substeps", "inertia", and "resonance" of the organ as it is stepped. Takes some
// seconds for 70 000 voxels, and goes with their number.
nlohmann::ordered_json inertia_facts(const Organ& organ, const Stepping& stepping);
// These, and a row for 1, 2, 4, ... substeps with true mass and with added mass: passes, the factor
// by which each material's mass grows, and with a machine the time of a tick, timed on the organ
// itself if it is this machine.
nlohmann::ordered_json speed_facts(const Organ& organ, const Stepping& stepping,
                                   const Machine* machine);
// "1 substep of true mass".
std::string stepping_text(const nlohmann::ordered_json& facts);
// What a hand feels of the step's inertia, and from which frequency on; a line, none for an organ
// that nothing holds.
std::string inertia_text(const nlohmann::ordered_json& facts);
std::string speed_text(const nlohmann::ordered_json& facts);

}  // namespace stylet::bake
