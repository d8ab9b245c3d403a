// SPDX-License-Identifier: Apache-2.0
// TOML by toml++, from text that anybody may have written.
//
// Promise: any bytes give a table or a TomlFault, in a time that follows their number and with a
// stack that does not. toml++ 3.3 sees to neither: it makes a table for each part of a dotted key,
// destroys tables within tables by recursion, and looks for each header in a list of all.
#pragma once

// The library asserts what it then reports as an error, for example with a header such as "[(]".
#define TOML_ASSERT(expression) static_cast<void>(0)
// Lists and tables within each other; with toml++'s own 256, each under a key of 256 parts, tables
// would lie 65536 deep.
#define TOML_MAX_NESTED_VALUES 32
#include <toml++/toml.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace stylet {

constexpr std::size_t kMaxKeyParts = 32;  // of a key such as hand.waypoint
// Headers and dotted keys together, each of which toml++ may compare with all before it: 2 s.
constexpr std::size_t kMaxTomlHeads = 65'536;

// Says what is wrong, without file and line.
struct TomlFault : std::runtime_error {
  TomlFault(const std::string& reason, std::size_t where)
      : std::runtime_error(reason), line(where) {}
  std::size_t line;  // from 1
};

// `file` is the name by which the table's nodes know their source.
toml::table parse_toml_text(std::string_view text, const std::string& file);

}  // namespace stylet
