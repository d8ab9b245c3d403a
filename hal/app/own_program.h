// SPDX-License-Identifier: Apache-2.0
// Where this program lies: scenes, benchmarks and the maker of organs are found from there.
#pragma once

#include <filesystem>

namespace stylet::app {

// Throws std::runtime_error where /proc is not mounted, as in a bare chroot.
std::filesystem::path own_program();

}  // namespace stylet::app
