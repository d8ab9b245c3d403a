// SPDX-License-Identifier: Apache-2.0
// Sine and cosine of angles given in turns, the same bits everywhere.
//
// Why not libm: the last digit of its results depends on processor and C library, and results of
// these functions go into poses, recordings and hashes.
// Promises: only + - * / and rounding, absolute error below 1e-15 up to a hundred turns.
#pragma once

#include <cmath>

namespace stylet::hal {

struct SineCosine {
  double sine, cosine;
};

// Taylor series about the nearest quarter turn, up to the 17th power: the rest is below 1e-16.
inline SineCosine sine_cosine(double turns) {
  constexpr double kTwoPi = 6.283185307179586;
  const double quarter = std::round(4 * turns);
  const double a = kTwoPi * (turns - 0.25 * quarter), a2 = a * a;
  double sine = 1, cosine = 1;
  for (double k = 16; k > 0; k -= 2) {
    sine = 1 - a2 / (k * (k + 1)) * sine;
    cosine = 1 - a2 / (k * (k - 1)) * cosine;
  }
  sine *= a;
  switch (static_cast<int>(quarter - 4 * std::floor(0.25 * quarter))) {
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    case 3:
      return {-cosine, sine};
    default:
      return {sine, cosine};
  }
}

}  // namespace stylet::hal
