// SPDX-License-Identifier: Apache-2.0
#include "hal/app/own_program.h"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

namespace stylet::app {

std::filesystem::path own_program() {
  constexpr const char* kLink = "/proc/self/exe";
  std::error_code error;
  std::filesystem::path program = std::filesystem::read_symlink(kLink, error);
  if (error) {
    throw std::runtime_error(fmt::format(
        "{}: {}: expected /proc to be mounted (mount -t proc proc /proc)", kLink, error.message()));
  }
  return program;
}

}  // namespace stylet::app
