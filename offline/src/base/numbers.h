// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as they lie in files: at any byte, in either byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>

namespace stylet::offline {

// The number that begins at byte `at`; the caller has seen that the bytes are there.
template <typename T>
T number_at(std::span<const char> bytes, std::size_t at, std::endian order) {
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes.data() + at, sizeof(T), raw.begin());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

}  // namespace stylet::offline
