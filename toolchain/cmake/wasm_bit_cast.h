// SPDX-License-Identifier: Apache-2.0
// Included before every source that is compiled for WebAssembly: the standard library of Debian's
// emscripten has no std::bit_cast yet, its compiler has.
#pragma once
#ifdef __cplusplus
#include <bit>
#ifndef __cpp_lib_bit_cast
namespace std {
template <typename To, typename From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
}  // namespace std
#endif
#endif
