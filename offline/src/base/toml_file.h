// SPDX-License-Identifier: GPL-3.0-or-later
// TOML files of the user, refused with `file:line: reason`.
#pragma once

// The library asserts what it then reports as an error, for a header such as "[(]".
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>

#include <filesystem>
#include <string>

namespace stylet::bake {

toml::table read_toml(const std::filesystem::path& path);

// "file:line" of something in it.
std::string place_of(const std::string& file, const toml::node& node);

}  // namespace stylet::bake
