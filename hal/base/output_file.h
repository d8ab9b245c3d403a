// SPDX-License-Identifier: Apache-2.0
// A file that a program is about to write: it must not be one that it reads, nor anything but a
// file, and it is there as a whole or not at all.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace stylet::hal {

// Throws std::runtime_error with one line where `path` is a directory, a device or another special
// file, or one of `inputs`, also by another name or through a link. Empty: nothing is written.
void check_output(const std::string& path, std::span<const std::string> inputs);

// `path` if nothing has that name, else with -2, -3, ... before its ending: the first that is free.
std::string kept_name(const std::string& path);

// Under its name when all of it is on the disk; permissions follow the umask. Throws
// std::runtime_error with one line, and then leaves nothing.
void write_output(const std::string& path, std::string_view bytes);

}  // namespace stylet::hal
