// SPDX-License-Identifier: Apache-2.0
// A thin skin on tissue, pressed in by a needle's point: a capsule, a fascia.
//
// A skin that hardly bends carries a point by stretching around it. If the skin's deformation is L
// wide, then at the depth d the skin stores about M d^4 / L^2 and the tissue below E* d^2 L, with M
// the skin's modulus times its thickness and E* = E / (1 - nu^2). So L^3 goes as M d^2 / E*, and
//   F(d) = C E*^(2/3) M^(1/3) d^(5/3),
// for any needle, as long as contact is narrower than L; it is a little less where the skin becomes
// steep. C and that reduction come from a stretched skin, bonded to a half space, solved by
// finite elements (tests/fidelity/coupling/film.py).
//
// The law of contact (cone.h) has two pieces, a parabola and a line, and the part `start` of a
// plain spring. It agrees with a film at the depth at which the film is punctured and at
// kFilmShallow of that, and is within a twentieth of it from a fifth of that on. It changes over at
// kFilmChange of that depth.
//
// Promises: no allocation, no branch on hardware. Units SI. PHYSICS 8.2.
#pragma once

#include "base/math.h"

namespace stylet {

constexpr float kFilmChange = 0.65F, kFilmShallow = 0.25F;
// At most this part of the law is a plain spring: divisions by the rest are possible.
constexpr float kMostStart = 0.9F;

// Depth and force at which the law of contact is the film's, and the part of it that is a plain
// spring; force 0 without a film.
struct Film {
  float depth_m, force_n, start;
};

// The law's force there over k and that depth: of the spring, and of the cone with its line.
constexpr float kFilmHigh = 1 - 0.5F * kFilmChange;
inline float film_shape(float start) {
  return start + (1 - start) * kFilmHigh;
}

inline float film_force_n(float plane_pa, float membrane_n_per_m, float depth_m) {
  constexpr float kFilm = 0.69F, kSteep = 0.3F;
  const float steep = plane_pa * depth_m / membrane_n_per_m;
  return kFilm * plane_pa * depth_m * depth_m * power(steep, -1.0F / 3) /
         (1 + kSteep * std::sqrt(steep));
}

// Of the depths to which needles press tissue, the depth at which a film carries this force.
inline Film film_at(float plane_pa, float membrane_n_per_m, float force_n) {
  constexpr int kHalvings = 20;  // to 10 nm
  float low_m = 1e-4F, high_m = 1e-2F;
  for (int i = 0; i < kHalvings; ++i) {
    const float middle_m = 0.5F * (low_m + high_m);
    (film_force_n(plane_pa, membrane_n_per_m, middle_m) < force_n ? low_m : high_m) = middle_m;
  }
  const float force = film_force_n(plane_pa, membrane_n_per_m, high_m);
  const float share = film_force_n(plane_pa, membrane_n_per_m, kFilmShallow * high_m) / force;
  // share = (s x + (1 - s) low) / film_shape(s), where x is kFilmShallow.
  constexpr float kFilmLow = kFilmShallow * kFilmShallow / (2 * kFilmChange);
  const float start =
      (share * kFilmHigh - kFilmLow) / ((kFilmShallow - kFilmLow) - share * (1 - kFilmHigh));
  return {high_m, force, clamp(start, 0, kMostStart)};
}

}  // namespace stylet
