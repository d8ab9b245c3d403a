// SPDX-License-Identifier: Apache-2.0
// A file that a program is about to write: it must be a regular file and none that the program
// reads, and it appears as a whole or not at all.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace stylet::hal {

// Where a file of this name is written: links are followed (output_place.h). Throws
// std::runtime_error with one line if that is a directory, a device or another special file, or one
// of `inputs`, also by another name. An empty `path` is returned as it is.
std::string checked_output(const std::string& path, std::span<const std::string> inputs);

// What becomes of a file that has the wanted name already.
enum class Naming : std::uint32_t {
  kReplace,  // the new one takes its place
  kKeep,     // it stays; the new one gets -2, -3, ... before its ending
  kNumber,   // it stays; each new one gets -1, -2, ...
};
struct OutputName {
  std::string wanted;
  Naming naming = Naming::kReplace;
};

// The first name that is free now, or the wanted one if that replaces.
std::string free_name(const OutputName& output);

// Gives a complete file its name, in the folder it is in: `first`, or if another file has got that
// name meanwhile and is to stay, the first free one. Returns the name; empty: errno says why not.
std::string take_name(const std::string& temporary, const std::string& first,
                      const OutputName& output);

// The file gets its name when all of it is on the disk; permissions follow the umask. On failure
// throws std::runtime_error with one line and leaves no file.
void write_output(const std::string& path, std::string_view bytes);

}  // namespace stylet::hal
