// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/output_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace stylet::hal {

void check_output(const std::string& path, std::span<const std::string> inputs) {
  namespace fs = std::filesystem;
  if (path.empty()) return;
  std::error_code error;
  const fs::file_status now = fs::status(path, error);
  if (fs::is_directory(now)) {
    throw std::runtime_error(fmt::format("{}: is a directory: expected the name of a file", path));
  }
  if (fs::exists(now) && !fs::is_regular_file(now)) {
    throw std::runtime_error(
        fmt::format("{}: is a device or another special file: expected the name of a file", path));
  }
  for (const std::string& input : inputs) {
    if (!input.empty() && fs::equivalent(path, input, error) && !error) {
      throw std::runtime_error(
          fmt::format("{}: is read by this command, too: expected another name", path));
    }
  }
}

}  // namespace stylet::hal
