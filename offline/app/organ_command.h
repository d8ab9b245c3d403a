// SPDX-License-Identifier: GPL-3.0-or-later
// What the commands build and phantom share: common options, and their last step, which builds the
// organ, writes all files together and reports.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "base/outputs.h"
#include "base/progress.h"
#include "pipeline/build.h"
#include "pipeline/settings.h"
#include "stylet/kernel.h"

namespace stylet::offline {

struct CommonArguments : Settings {
  std::string output;
  std::string machine;
  std::uint32_t substeps = 0;  // 0: the usual number for the inertia
  Inertia inertia = Config{}.inertia;
  std::string report;  // folder
  bool sum = false;
  std::uint64_t memory_limit_bytes = 0;
  bool json = false;
};

void add_common(CLI::App& command, CommonArguments& a);

// common_options, which also sets the memory limit and what a report asks for.
BuildOptions limited_options(const CommonArguments& a, const MeshUnits& units);

// Builds, writes and reports. The progress bar is wiped before the report is printed.
void finish(const std::function<Built(const BuildOptions&, const Progress&)>& make,
            BuildOptions options, const CommonArguments& a, Outputs& outputs);

}  // namespace stylet::offline
