// SPDX-License-Identifier: Apache-2.0
// Names of OpenHaptics devices: which of them exist when a name cannot be opened.
#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace stylet::hal {

// The folder in which the vendor's set-up program keeps a file for each device it has named.
inline std::string names_folder() {
  const char* home = std::getenv("GTDD_HOME");
  return std::string(home != nullptr ? home : "/usr/share/3DSystems") + "/config";
}

// Empty: the name is configured, or no name was given. Else what to do.
inline std::string name_fault(const std::string& name) {
  if (name.empty()) return "";
  std::string names;
  std::error_code error;
  const std::string folder = names_folder();
  for (const auto& each : std::filesystem::directory_iterator(folder, error)) {
    if (each.path().extension() != ".config") continue;
    if (each.path().stem() == name) return "";
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", each.path().stem().string());
  }
  if (names.empty()) {
    return fmt::format(
        "no device of any name is configured in {}: expected one that the vendor's "
        "set-up program shows",
        folder);
  }
  return fmt::format("no device of this name is configured in {}: expected {}", folder, names);
}

}  // namespace stylet::hal
