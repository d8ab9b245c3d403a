// SPDX-License-Identifier: Apache-2.0
// Random numbers from a seed, for random scenes and sessions.
//
// Promise: the same numbers with every standard library. Units: those of the bounds.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace stylet::test {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}

  double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  float between(double low, double high) { return static_cast<float>(low + (high - low) * unit()); }
  // Each factor of ten is equally likely.
  float magnitude(double low, double high) {
    return static_cast<float>(low * std::pow(high / low, unit()));
  }
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(engine_() % count); }
  bool chance(double share) { return unit() < share; }

 private:
  std::mt19937_64 engine_;
};

// A number from the environment, such as a seed.
inline int number_from(const char* variable, int otherwise) {
  const char* wanted = std::getenv(variable);
  return wanted != nullptr ? std::atoi(wanted) : otherwise;
}

}  // namespace stylet::test
