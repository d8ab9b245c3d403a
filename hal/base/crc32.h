// SPDX-License-Identifier: Apache-2.0
// CRC-32 of bytes, as in zlib, gzip and PNG (ISO 3309), lowest bit first: what most protocols of
// devices mean by it. Written here so that the loop's library needs no other one for 108 bytes.
//
// Promises: plain arithmetic, no allocation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace stylet::hal {

inline std::uint32_t crc32_of(std::span<const std::byte> bytes) {
  constexpr std::uint32_t kPolynomial = 0xedb88320;
  std::uint32_t crc = ~0U;
  for (const std::byte each : bytes) {
    crc ^= std::to_integer<std::uint32_t>(each);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? kPolynomial : 0);
  }
  return ~crc;
}

}  // namespace stylet::hal
