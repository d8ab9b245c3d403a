// SPDX-License-Identifier: Apache-2.0
// Registers as values: one voxel or particle per lane, as many lanes as the instruction set
// has.
//
// Internal linkage throughout: this header is compiled for several instruction sets, and the linker
// must not merge their copies.
#pragma once

#include <cstdint>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace stylet {
namespace {

// For loops over whole groups of lanes whose arrays do not overlap. They stay separate functions so
// that the compiler sees that.
#if defined(__clang__)
#define STYLET_VECTOR _Pragma("clang loop vectorize(assume_safety)")
#else
#define STYLET_VECTOR _Pragma("GCC ivdep")
#endif
// For short loops of a sweep that is compiled without unrolling, to be small (in a page), where the
// time goes: arrays of a few groups of lanes stay in registers. GCC unrolls them anyway.
#if defined(__clang__)
#define STYLET_UNROLL _Pragma("clang loop unroll(full)")
#else
#define STYLET_UNROLL
#endif
#define STYLET_KEEP_APART __attribute__((noinline))

// A group of lanes as one value, for loops over short rows: as wide as a register.
#if defined(__AVX512F__)
constexpr std::uint32_t kWide = 16;
#elif defined(__AVX2__)
constexpr std::uint32_t kWide = 8;
#else
constexpr std::uint32_t kWide = 4;
#endif
typedef float Wide __attribute__((vector_size(4 * kWide)));
typedef std::int32_t WideBits __attribute__((vector_size(4 * kWide)));
// The same at the address of any float.
typedef float Loose __attribute__((vector_size(4 * kWide), aligned(4), may_alias));

inline Wide load(const float* from) {
  return *reinterpret_cast<const Loose*>(from);
}
inline void store(float* to, Wide value) {
  *reinterpret_cast<Loose*>(to) = value;
}
// Sets all bits of lane i if bit i of `bits` is set.
inline WideBits lanes_set(std::uint32_t bits) {
  WideBits bit = {};
  STYLET_UNROLL
  for (std::uint32_t i = 0; i < kWide; ++i) bit[i] = 1 << i;
  return (bit & static_cast<std::int32_t>(bits)) != 0;
}
template <typename Bits, typename Value>
inline Value zero_unless(Bits set, Value value) {
  return set ? value : Value{};
}
// The lanes one place earlier: the last of `before`, then all but the last of `now`.
inline Wide lanes_behind(Wide before, Wide now) {
#if defined(__AVX512F__)
  // Spelt out: GCC turns a shuffle into a permutation and copies its register of indices each time.
  const __m512i shifted = _mm512_maskz_alignr_epi32(0xFFFF, __builtin_bit_cast(__m512i, now),
                                                    __builtin_bit_cast(__m512i, before), 15);
  return __builtin_bit_cast(Wide, shifted);
#elif defined(__AVX2__)
  return __builtin_shufflevector(before, now, 7, 8, 9, 10, 11, 12, 13, 14);
#else
  return __builtin_shufflevector(before, now, 3, 4, 5, 6);
#endif
}
// The lanes one place later: all but the first of `now`, then the first of `behind`.
inline Wide lanes_ahead(Wide now, Wide behind) {
#if defined(__AVX512F__)
  const __m512i shifted = _mm512_maskz_alignr_epi32(0xFFFF, __builtin_bit_cast(__m512i, behind),
                                                    __builtin_bit_cast(__m512i, now), 1);
  return __builtin_bit_cast(Wide, shifted);
#elif defined(__AVX2__)
  return __builtin_shufflevector(now, behind, 1, 2, 3, 4, 5, 6, 7, 8);
#else
  return __builtin_shufflevector(now, behind, 1, 2, 3, 4);
#endif
}
// The same with at most 8 lanes, for arrays in groups of 8 whatever the instruction set.
constexpr std::uint32_t kNarrow = kWide < 8 ? kWide : 8;
typedef float Narrow __attribute__((vector_size(4 * kNarrow)));
typedef std::int32_t NarrowBits __attribute__((vector_size(4 * kNarrow)));
typedef float LooseNarrow __attribute__((vector_size(4 * kNarrow), aligned(4), may_alias));

inline Narrow load_narrow(const float* from) {
  return *reinterpret_cast<const LooseNarrow*>(from);
}
inline void store_narrow(float* to, Narrow value) {
  *reinterpret_cast<LooseNarrow*>(to) = value;
}
inline NarrowBits narrow_set(std::uint32_t bits) {
  NarrowBits bit = {};
  STYLET_UNROLL
  for (std::uint32_t i = 0; i < kNarrow; ++i) bit[i] = 1 << i;
  return (bit & static_cast<std::int32_t>(bits)) != 0;
}
#if defined(__AVX512F__)
inline Narrow narrow_behind(Narrow before, Narrow now) {
  const __m256i shifted = _mm256_maskz_alignr_epi32(0xFF, __builtin_bit_cast(__m256i, now),
                                                    __builtin_bit_cast(__m256i, before), 7);
  return __builtin_bit_cast(Narrow, shifted);
}
inline Narrow narrow_ahead(Narrow now, Narrow behind) {
  const __m256i shifted = _mm256_maskz_alignr_epi32(0xFF, __builtin_bit_cast(__m256i, behind),
                                                    __builtin_bit_cast(__m256i, now), 1);
  return __builtin_bit_cast(Narrow, shifted);
}
#else
inline Narrow narrow_behind(Narrow before, Narrow now) {
  return lanes_behind(before, now);
}
inline Narrow narrow_ahead(Narrow now, Narrow behind) {
  return lanes_ahead(now, behind);
}
#endif
// Stores each lane of `a` followed by the same lane of `b`.
inline void store_pairs(float* to, Wide a, Wide b) {
#if defined(__AVX512F__)
  store(to, __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
  store(to + kWide, __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14,
                                            30, 15, 31));
#elif defined(__AVX2__)
  store(to, __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11));
  store(to + kWide, __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15));
#else
  store(to, __builtin_shufflevector(a, b, 0, 4, 1, 5));
  store(to + kWide, __builtin_shufflevector(a, b, 2, 6, 3, 7));
#endif
}
// Clamps to +-bound; what is not a number stays so, for the tick to notice.
inline Wide no_larger(Wide value, float bound) {
  const Wide most = bound - Wide{}, least = -bound - Wide{};
  value = most < value ? most : value;
  return least > value ? least : value;
}

}  // namespace
}  // namespace stylet
