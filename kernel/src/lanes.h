// SPDX-License-Identifier: Apache-2.0
// Registers as values: a voxel or a particle in each lane, as many lanes as the instruction set
// has.
//
// Internal linkage throughout: this header is compiled for several instruction sets, and the linker
// must not merge their copies.
#pragma once

#include <cstdint>

namespace stylet {
namespace {

// For loops over whole groups of lanes whose arrays do not overlap; they stay functions of their
// own so that the compiler sees that.
#if defined(__clang__)
#define STYLET_VECTOR _Pragma("clang loop vectorize(assume_safety)")
#else
#define STYLET_VECTOR _Pragma("GCC ivdep")
#endif
#define STYLET_KEEP_APART __attribute__((noinline))

// A group of lanes as one value, for loops over short rows: as wide as the registers are.
#if defined(__AVX512F__)
constexpr std::uint32_t kWide = 16;
#elif defined(__AVX2__)
constexpr std::uint32_t kWide = 8;
#else
constexpr std::uint32_t kWide = 4;
#endif
typedef float Wide __attribute__((vector_size(4 * kWide)));
typedef std::int32_t WideBits __attribute__((vector_size(4 * kWide)));
// The same at any address of a float.
typedef float Loose __attribute__((vector_size(4 * kWide), aligned(4), may_alias));

inline Wide load(const float* from) {
  return *reinterpret_cast<const Loose*>(from);
}
inline void store(float* to, Wide value) {
  *reinterpret_cast<Loose*>(to) = value;
}
// Lane i is set if bit i is.
inline WideBits lanes_set(std::uint32_t bits) {
  WideBits bit = {};
  for (std::uint32_t i = 0; i < kWide; ++i) bit[i] = 1 << i;
  return (bit & static_cast<std::int32_t>(bits)) != 0;
}
inline Wide zero_unless(WideBits set, Wide value) {
  return set ? value : Wide{};
}
// Within +-bound; what is not a number stays so, for the tick to see.
inline Wide no_larger(Wide value, float bound) {
  const Wide most = bound - Wide{}, least = -bound - Wide{};
  value = most < value ? most : value;
  return least > value ? least : value;
}

}  // namespace
}  // namespace stylet
