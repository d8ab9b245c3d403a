// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/toml_file.h"

#include "base/file.h"
#include "base/refusal.h"

namespace stylet::offline {

toml::table read_toml(const std::filesystem::path& path) {
  const std::string file = path.string();
  try {
    return parse_toml_text(read_file(path), file);
  } catch (const TomlFault& fault) {
    refuse("{}:{}: {}", file, fault.line, fault.what());
  }
}

std::string place_of(const std::string& file, const toml::node& node) {
  const auto line = node.source().begin.line;
  return line == 0 ? file : fmt::format("{}:{}", file, line);
}

}  // namespace stylet::offline
