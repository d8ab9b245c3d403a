// SPDX-License-Identifier: Apache-2.0
// A file that a program is about to write: it must not be one that it reads, nor anything but a
// file.
#pragma once

#include <span>
#include <string>

namespace stylet::hal {

// Throws std::runtime_error with one line where `path` is a directory, a device or another special
// file, or one of `inputs`, also by another name or through a link. Empty: nothing is written.
void check_output(const std::string& path, std::span<const std::string> inputs);

}  // namespace stylet::hal
