// SPDX-License-Identifier: GPL-3.0-or-later
// A binary file, read number by number. For readers of meshes. No number lies behind the end of the
// file: what is asked for there is refused, so a reader that takes every number through here
// notices a file that was cut.
#pragma once

#include <concepts>
#include <utility>

#include "base/numbers.h"
#include "meshes/reader.h"

namespace stylet::offline {

struct Bytes {
  std::string_view bytes;
  std::string_view file;
  std::endian order = std::endian::little;
  std::size_t next = 0;  // at most bytes.size()
};

inline Place place_of(const Bytes& bytes) {  // the next byte
  return {bytes.file, Place::Kind::kByte, bytes.next};
}

inline std::size_t left(const Bytes& bytes) {
  return bytes.bytes.size() - bytes.next;
}

void skip_bytes(Bytes& bytes, std::size_t count, std::string_view expected);

template <typename T>
T next(Bytes& bytes, std::string_view expected) {
  const std::size_t at = bytes.next;
  skip_bytes(bytes, sizeof(T), expected);
  return number_at<T>(bytes.bytes, at, bytes.order);
}

// A whole number from `low` to `high`.
template <std::integral T>
T next_integer(Bytes& bytes, T low, T high, std::string_view expected) {
  const Place place = place_of(bytes);
  const T value = next<T>(bytes, expected);
  if (value < low || value > high) {
    refuse_at(place, fmt::format("{}", value),
              fmt::format("{} from {} to {}", expected, low, high));
  }
  return value;
}

// A count of things that take at least `bytes_each` bytes each in the rest of the file.
template <std::integral T>
std::size_t next_count(Bytes& bytes, std::size_t bytes_each, std::string_view what) {
  const Place place = place_of(bytes);
  const T value = next<T>(bytes, what);
  const std::int64_t count = std::in_range<std::int64_t>(value) ? value : -1;
  return require_room(place, fmt::format("{}", value), count, {left(bytes), bytes_each}, what);
}

}  // namespace stylet::offline
