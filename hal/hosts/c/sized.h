// SPDX-License-Identifier: Apache-2.0
// Structs that may grow: each begins with the size its caller knew (stylet.h). Here an older
// caller's struct is filled up with defaults, a newer one's is cut where we know no more.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "hal/hosts/c/fields.h"
#include "stylet/stylet.h"

namespace stylet::c {

// A struct smaller than this holds nothing but its size.
constexpr std::uint32_t kLeastStruct = 8;
// None will ever be larger; a size beyond was not set, and to believe it would be to write there.
constexpr std::uint32_t kMostStruct = 65'536;

// Whether a caller can have been compiled with a struct of this size.
inline bool is_size_of(std::span<const Span> fields, std::size_t bytes) {
  return bytes >= kLeastStruct && bytes <= kMostStruct && bytes % alignof(std::uint32_t) == 0 &&
         !cuts_a_field(fields, bytes);
}

// How far apart the elements of an array are: the size its caller knew, which its first element
// says. 0: it does not say.
template <typename T>
std::uint32_t stride_of(const T* array) {
  const std::uint32_t bytes = array->struct_bytes;
  return is_size_of(known_fields<T>(), bytes) ? bytes : 0;
}

template <typename T>
const T* element(const T* array, std::uint32_t stride, std::size_t index) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(array);
  return reinterpret_cast<const T*>(bytes + index * stride);
}
template <typename T>
T* element(T* array, std::uint32_t stride, std::size_t index) {
  return const_cast<T*>(element(static_cast<const T*>(array), stride, index));
}

// Whether a struct has something where we know no field.
inline bool has_unknown(const void* from, std::size_t bytes, std::size_t known) {
  const auto* const all = static_cast<const unsigned char*>(from);
  return std::any_of(all + std::min(bytes, known), all + bytes,
                     [](unsigned char byte) { return byte != 0; });
}
template <typename T>
bool has_unknown(const T* from, std::uint32_t bytes) {
  return has_unknown(from, bytes, sizeof(T));
}

// Takes what the caller's struct holds; `value` has defaults for the rest. False: it did not say
// its size, or holds something where we know no field.
template <typename T>
bool take(const T* from, std::uint32_t bytes, T& value) {
  if (bytes == 0 || has_unknown(from, bytes)) return false;
  std::memcpy(&value, from, std::min<std::size_t>(bytes, sizeof(T)));
  value.struct_bytes = sizeof(T);
  return true;
}
template <typename T>
bool take(const T* from, T& value) {
  return take(from, stride_of(from), value);
}

// Gives the caller what its struct has room for; what we do not know is zero.
inline bool give(const void* value, std::size_t known, void* to, std::uint32_t bytes) {
  if (bytes == 0) return false;
  std::memcpy(to, value, std::min<std::size_t>(bytes, known));
  std::memcpy(to, &bytes, sizeof bytes);  // in an array of such a size it need not be aligned
  auto* const all = static_cast<unsigned char*>(to);
  if (bytes > known) std::memset(all + known, 0, bytes - known);
  return true;
}
template <typename T>
bool give(const T& value, T* to, std::uint32_t bytes) {
  return give(&value, sizeof(T), to, bytes);
}
template <typename T>
bool give(const T& value, T* to) {
  return give(value, to, stride_of(to));
}

// The end of a call that fills a struct.
template <typename T>
stylet_status answer(const T& value, T* to) {
  return give(value, to) ? stylet_status{STYLET_OK} : stylet_status{STYLET_STRUCT_SIZE_UNKNOWN};
}

// The same of one that could not.
template <typename T>
stylet_status nothing(stylet_status why, T* to) {
  if (to != nullptr) (void)give(T{}, to);
  return why;
}

template <typename T>
stylet_status missing(T* to) {
  return nothing(STYLET_ARGUMENT_MISSING, to);
}

// For structs that are given their defaults: the size stands beside the struct.
template <typename T>
stylet_status init(const T& value, T* to, std::size_t bytes) {
  if (to == nullptr) return STYLET_ARGUMENT_MISSING;
  if (!is_size_of(known_fields<T>(), bytes)) return STYLET_STRUCT_SIZE_UNKNOWN;
  (void)give(value, to, static_cast<std::uint32_t>(bytes));
  return STYLET_OK;
}

}  // namespace stylet::c
