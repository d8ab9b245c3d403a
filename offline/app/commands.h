// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of stylet-organ, one file each. A command adds itself to the program, owns its
// options and runs when CLI11 calls it back. A refusal is thrown as an exception
// (base/refusal.h).
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace stylet::offline {

void add_build(CLI::App& app);
void add_phantom(CLI::App& app);
void add_hull(CLI::App& app);
void add_labels(CLI::App& app);
void add_info(CLI::App& app);
void add_check(CLI::App& app);

// ---- what several commands use ------------------------------------------------------------------

// Arguments of a command that shows one file.
struct FileArguments {
  std::string file;
  bool json = false;
};

// Prints each warning on a line of standard error.
void warn(const std::vector<std::string>& warnings);
// Tells there which files of killed commands were removed.
void tell_of_leftovers(const std::vector<std::string>& names);

}  // namespace stylet::offline
