// SPDX-License-Identifier: Apache-2.0
// The SHA-256 that an organ file holds of its own bytes (organ.fbs). It is a separate library,
// stylet_content_sum, for programs that write and load files; the kernel does not need it.
//
// Promise: no allocation of its own (Windows' sum may). `organ` is what organ_open found in `file`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stylet/organ.h"

namespace stylet {

// SHA-256 of all bytes except those of Organ::content_sha256, if there are any.
std::array<std::uint8_t, 32> content_sha256(std::span<const std::byte> file, const Organ& organ);

// Whether the bytes match the file's sum; true for files of format version 1 that hold no sum.
bool has_its_bytes(std::span<const std::byte> file, const Organ& organ);

}  // namespace stylet
