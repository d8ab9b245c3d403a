// SPDX-License-Identifier: Apache-2.0
// SHA-256 of pieces one after another, by a library of the system.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stylet {

std::array<std::uint8_t, 32> sha256(std::span<const std::span<const std::byte>> pieces);

}  // namespace stylet
