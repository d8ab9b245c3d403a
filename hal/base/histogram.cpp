// SPDX-License-Identifier: Apache-2.0
#include "hal/base/histogram.h"

#include <algorithm>
#include <cmath>

namespace stylet::hal {

void histogram_add(Histogram& histogram, std::int64_t ns) {
  const std::int64_t bin = std::clamp<std::int64_t>(ns / 1000, 0, Histogram::kBins - 1);
  ++histogram.count[static_cast<std::size_t>(bin)];
  ++histogram.total;
  histogram.max_ns = std::max(histogram.max_ns, ns);
}

double histogram_quantile_us(const Histogram& histogram, double fraction) {
  const double wanted = fraction * static_cast<double>(histogram.total);
  const double max_us = static_cast<double>(histogram.max_ns) * 1e-3;
  std::uint64_t seen = 0;
  for (std::size_t bin = 0; bin + 1 < Histogram::kBins; ++bin) {
    seen += histogram.count[bin];
    if (static_cast<double>(seen) >= wanted) {
      return std::min(static_cast<double>(bin + 1), max_us);
    }
  }
  return max_us;
}

}  // namespace stylet::hal
