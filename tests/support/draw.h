// SPDX-License-Identifier: Apache-2.0
// Random numbers from a seed, for random scenes and sessions.
//
// Promise: the same numbers with every standard library, whose distributions differ. Units: those
// of the bounds.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace stylet::test {

// Its numbers are drawn in double and given as `Real`.
template <typename Real>
class DrawOf {
 public:
  explicit DrawOf(std::uint64_t seed) : engine_(seed) {}

  double unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
  Real between(double low, double high) { return static_cast<Real>(low + (high - low) * unit()); }
  // Each factor of ten is equally likely.
  Real magnitude(double low, double high) {
    return static_cast<Real>(low * std::pow(high / low, unit()));
  }
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(bits() % count); }
  bool chance(double share) { return unit() < share; }
  std::uint64_t bits() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};
using Draw = DrawOf<float>;
using DoubleDraw = DrawOf<double>;

// A number from the environment, such as a seed.
inline int number_from(const char* variable, int otherwise) {
  const char* wanted = std::getenv(variable);
  return wanted != nullptr ? std::atoi(wanted) : otherwise;
}

}  // namespace stylet::test
