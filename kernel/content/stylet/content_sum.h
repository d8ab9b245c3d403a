// SPDX-License-Identifier: Apache-2.0
// The SHA-256 that an organ file holds of its own bytes (organ.fbs): a library of its own,
// stylet_content_sum, for those who write and load files; the kernel needs none of it.
//
// Promises: no allocation but libcrypto's. `organ` is what organ_open found in `file`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stylet/organ.h"

namespace stylet {

// Of all bytes but those of Organ::content_sha256, if there are any. Throws where libcrypto has no
// SHA-256.
std::array<std::uint8_t, 32> content_sha256(std::span<const std::byte> file, const Organ& organ);

// Whether no byte was changed since; true for files of format version 1 that hold no sum.
bool has_its_bytes(std::span<const std::byte> file, const Organ& organ);

}  // namespace stylet
