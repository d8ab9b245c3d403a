// SPDX-License-Identifier: Apache-2.0
#include "laws/filter.h"

namespace stylet {
namespace {

// Damping of the polynomial. With the least, waves whose frequency the filter bounds keep 0.6 of it
// where they keep least, so the shortest come to rest in some 10 ms with the usual damping of the
// tissue; with 0.05 they hardly moved. What the passes can spare goes into damping, up to the most:
// long waves are then nearer to the true ones, too.
constexpr double kLeastDamping = 1;
constexpr double kMostDamping = 2;
constexpr int kHalvings = 30;  // of the way between them: to 1e-9

// Chebyshev's polynomials of the first kind and their slopes at w0 > 1, for degrees 0 .. n.
struct Chebyshev {
  double w0;
  double value[kMaxFilterPasses + 2];
  double slope[kMaxFilterPasses + 2];
};

Chebyshev chebyshev(std::uint32_t degree, double damping) {
  Chebyshev t = {};
  t.w0 = 1 + damping / (static_cast<double>(degree) * static_cast<double>(degree));
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
double fraction_left(std::uint32_t passes, double damping) {
  const std::uint32_t degree = passes + 1;
  const Chebyshev t = chebyshev(degree, damping);
  return (1 + t.value[degree]) / ((1 + t.w0) * t.slope[degree]);
}

// The most damping with which the passes leave no more than `share`, or the least.
double choose_damping(std::uint32_t passes, double share) {
  if (fraction_left(passes, kMostDamping) <= share) return kMostDamping;
  double damping = kLeastDamping;
  double step = (kMostDamping - kLeastDamping) / 2;
  for (int i = 0; i < kHalvings; ++i, step /= 2) {
    if (fraction_left(passes, damping + step) <= share) damping += step;
  }
  return damping;
}

}  // namespace

float wave_limit_per_s2(float step_s, float tau_s) {
  const double dt = static_cast<double>(step_s);
  return static_cast<float>(4 / (dt * (dt + 2 * static_cast<double>(tau_s))));
}

float most_filtered_per_s2(float limit_per_s2) {
  return static_cast<float>(static_cast<double>(limit_per_s2) /
                            fraction_left(kMaxFilterPasses, kLeastDamping));
}

// With x = w0 - (1 + w0) z, z = S / s, and T_n(x) = T_n(w0) - z r_n, the polynomial is r_n over its
// value at z = 0, (1 + w0) T'_n(w0); and r_(n+1) = 2 x r_n - r_(n-1) + 2 (1 + w0) T_n(w0).
Filter choose_filter(float limit_per_s2, float fastest_per_s2) {
  Filter out = {};
  out.limit_per_s2 = limit_per_s2;
  const double fastest = static_cast<double>(fastest_per_s2);
  const double limit = static_cast<double>(limit_per_s2);
  for (std::uint32_t passes = 1; passes <= kMaxFilterPasses; ++passes) {
    if (fastest * fraction_left(out.passes, kLeastDamping) > limit) out.passes = passes;
  }
  const Chebyshev t = chebyshev(out.passes + 1, choose_damping(out.passes, limit / fastest));
  for (std::uint32_t j = 1; j <= out.passes; ++j) {
    const double next = t.slope[j + 1];
    out.pass[j - 1] = {static_cast<float>(2 * t.w0 * t.slope[j] / next),
                       static_cast<float>(2 * t.value[j] / next),
                       static_cast<float>(-t.slope[j - 1] / next),
                       static_cast<float>(2 * (1 + t.w0) * t.slope[j] / (next * fastest))};
  }
  // In pass 1 w is also the last iterate: one factor for both.
  out.pass[0].last += out.pass[0].first;
  out.pass[0].first = 0;
  return out;
}

}  // namespace stylet
