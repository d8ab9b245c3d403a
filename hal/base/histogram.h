// SPDX-License-Identifier: Apache-2.0
// Counts of how long something took.
// Promise: plain data of fixed size; adding a duration always takes the same few instructions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace stylet::hal {

// Durations in bins of 1 us; the last bin holds everything longer.
struct Histogram {
  static constexpr std::size_t kBins = 5001;
  std::array<std::uint64_t, kBins> count{};
  std::uint64_t total = 0;
  std::int64_t max_ns = 0;
};
void histogram_add(Histogram& histogram, std::int64_t ns);
// Upper edge of the bin at which the fraction `fraction` of all entries is reached, us; the maximum
// for entries beyond the last bin.
double histogram_quantile_us(const Histogram& histogram, double fraction);

}  // namespace stylet::hal
