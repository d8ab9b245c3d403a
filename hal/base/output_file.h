// SPDX-License-Identifier: Apache-2.0
// A file that a program is about to write: it must be a regular file and none that the program
// reads, and it appears as a whole or not at all.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace stylet::hal {

// Throws std::runtime_error with one line if `path` is a directory, a device or another special
// file, or one of `inputs`, also by another name or through a link. Empty `path`: nothing to check.
void check_output(const std::string& path, std::span<const std::string> inputs);

// `path` if that name is free, else the first free name with -2, -3, ... before its ending.
std::string kept_name(const std::string& path);

// The file gets its name when all of it is on the disk; permissions follow the umask. On failure
// throws std::runtime_error with one line and leaves no file.
void write_output(const std::string& path, std::string_view bytes);

}  // namespace stylet::hal
