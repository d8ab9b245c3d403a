// SPDX-License-Identifier: GPL-3.0-or-later
// Reads TOML files of the user; faults are refused with `file:line: reason`.
#pragma once

#include <filesystem>
#include <string>

#include "stylet/toml_text.h"

namespace stylet::offline {

toml::table read_toml(const std::filesystem::path& path);

// "file:line" of a node of the file; of a table that was never a file, the name alone.
std::string place_of(const std::string& file, const toml::node& node);

}  // namespace stylet::offline
