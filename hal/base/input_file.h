// SPDX-License-Identifier: Apache-2.0
// Why a file cannot be read, in the same words for every kind of file.
#pragma once

#include <string>

namespace stylet::hal {

// "no such file", "is a directory", "is empty", "Permission denied" ...; empty: it can be read.
// Pipes can be read.
std::string why_unreadable(const std::string& path);

}  // namespace stylet::hal
