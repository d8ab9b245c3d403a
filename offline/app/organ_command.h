// SPDX-License-Identifier: GPL-3.0-or-later
// What the commands build and phantom share: common options, the choice of a capsule, and their
// last step, which builds the organ, writes all files together and reports.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "base/outputs.h"
#include "base/progress.h"
#include "pipeline/build.h"
#include "stylet/kernel.h"

namespace stylet::offline {

constexpr const char* kToolVersion = "stylet-organ " STYLET_VERSION;

struct CommonArguments {
  std::string output;
  std::string name;
  double voxel_mm = 5;
  std::uint32_t voxels_across = 0;
  std::string capsule = "auto";
  std::vector<std::string> fix = kDefaultFix;
  std::vector<std::string> crop;
  std::string materials;
  std::string fit;  // rate
  std::string machine;
  std::uint32_t substeps = 0;  // 0: the usual number for the inertia
  Inertia inertia = Config{}.inertia;
  std::string report;  // folder
  bool sum = false;
  std::uint64_t memory_limit_bytes = 0;
  bool json = false;
};

void add_common(CLI::App& command, CommonArguments& a);

// Also sets the memory limit. `metres_per_unit` is for the meshes that hold the organ in place.
BuildOptions common_options(const CommonArguments& a, double metres_per_unit);

// Each text is TISSUE:MM. `option` is the option that refusals name.
std::vector<Layer> parse_layers(const std::vector<std::string>& texts, const char* option);

// The texts with a space between them.
std::string joined(const std::vector<std::string>& texts);

// Builds, writes and reports. The progress bar is wiped before the report is printed.
void finish(const std::function<Built(const BuildOptions&, const Progress&)>& make,
            BuildOptions options, const CommonArguments& a, Outputs& outputs);

// A needle would enter a liver without capsule at a quarter of the force, over three times the
// distance: so a user who says only "liver" gets the organ with its natural capsule.
template <typename HaveTissue>  // inputs, or groups of labels
void choose_capsule(const std::string& wanted, const std::vector<HaveTissue>& sources,
                    BuildOptions& options) {
  const bool all_layers = !options.layers.empty() && options.layer_course.of.empty();
  const bool any_liver = std::any_of(sources.begin(), sources.end(), [](const HaveTissue& source) {
    return source.tissue == "liver";
  });
  if (wanted == "auto") {
    options.capsule = any_liver && !all_layers ? "liver_capsule" : "";
    options.capsule_of = "liver";
  } else {
    options.capsule = wanted == "none" ? "" : wanted;
  }
  options.options_text += " --capsule " + (options.capsule.empty() ? "none" : options.capsule);
}

}  // namespace stylet::offline
