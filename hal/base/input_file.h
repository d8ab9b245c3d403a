// SPDX-License-Identifier: Apache-2.0
// Why a file cannot be read, in the same words for every kind of file, and texts from pipes.
#pragma once

#include <cstddef>
#include <string>

namespace stylet::hal {

// "no such file", "is a directory", "is a pipe", "is empty", "Permission denied" ...; empty: it can
// be read. A pipe counts as unreadable: organs and recordings are read from any position.
std::string why_unreadable(const std::string& path);

// Reads the whole of a file or of a pipe, such as a shell's <(...), up to `most` bytes; returns why
// it cannot be read, as above. A pipe's first writer has 5 s to come, and then any time to write.
std::string read_whole(const std::string& path, std::size_t most, std::string& text_out);

}  // namespace stylet::hal
