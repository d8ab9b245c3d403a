// SPDX-License-Identifier: Apache-2.0
#include "laws/filter.h"

namespace stylet {
namespace {

// Damping of the polynomial: with it p stays above 0.011. With 0.05, which divides s by a little
// more, the shortest waves hardly move and come to rest slowly.
constexpr double kDamping = 2;
// Part of the limit that is used. With all of it a lattice in paper mode, whose waves reach the
// bound, gained a thousandth a step in large motion, to which no linear bound applies.
constexpr double kUsed = 0.8;

// Chebyshev's polynomials of the first kind and their slopes at w0 > 1, for degrees 0 .. n.
struct Chebyshev {
  double w0;
  double value[kMaxFilterPasses + 2];
  double slope[kMaxFilterPasses + 2];
};

Chebyshev chebyshev(std::uint32_t degree) {
  Chebyshev t = {};
  t.w0 = 1 + kDamping / (static_cast<double>(degree) * static_cast<double>(degree));
  t.value[0] = 1;
  t.value[1] = t.w0;
  t.slope[1] = 1;
  for (std::uint32_t k = 2; k <= degree; ++k) {
    t.value[k] = 2 * t.w0 * t.value[k - 1] - t.value[k - 2];
    t.slope[k] = 2 * t.value[k - 1] + 2 * t.w0 * t.slope[k - 1] - t.slope[k - 2];
  }
  return t;
}

// Largest x p(x) over s, for the polynomial p of so many passes.
double share_left(std::uint32_t passes) {
  const std::uint32_t degree = passes + 1;
  const Chebyshev t = chebyshev(degree);
  return (1 + t.value[degree]) / ((1 + t.w0) * t.slope[degree]);
}

}  // namespace

float wave_limit_per_s2(float step_s, float tau_s) {
  const double dt = static_cast<double>(step_s);
  return static_cast<float>(kUsed * 4 / (dt * (dt + 2 * static_cast<double>(tau_s))));
}

float most_filtered_per_s2(float limit_per_s2) {
  return static_cast<float>(static_cast<double>(limit_per_s2) / share_left(kMaxFilterPasses));
}

// With x = w0 - (1 + w0) z, z = S / s, and T_n(x) = T_n(w0) - z r_n, the polynomial is r_n over its
// value at z = 0, (1 + w0) T'_n(w0); and r_(n+1) = 2 x r_n - r_(n-1) + 2 (1 + w0) T_n(w0).
Filter choose_filter(float limit_per_s2, float fastest_per_s2) {
  Filter out = {};
  out.limit_per_s2 = limit_per_s2;
  const double fastest = static_cast<double>(fastest_per_s2);
  const double limit = static_cast<double>(limit_per_s2);
  for (std::uint32_t passes = 1; passes <= kMaxFilterPasses; ++passes) {
    if (fastest * share_left(out.passes) > limit) out.passes = passes;
  }
  const Chebyshev t = chebyshev(out.passes + 1);
  for (std::uint32_t j = 1; j <= out.passes; ++j) {
    const double next = t.slope[j + 1];
    out.pass[j - 1] = {static_cast<float>(2 * t.w0 * t.slope[j] / next),
                       static_cast<float>(2 * t.value[j] / next),
                       static_cast<float>(-t.slope[j - 1] / next),
                       static_cast<float>(2 * (1 + t.w0) * t.slope[j] / (next * fastest))};
  }
  return out;
}

}  // namespace stylet
