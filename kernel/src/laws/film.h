// SPDX-License-Identifier: Apache-2.0
// A thin skin on tissue, pressed in by a needle's point: a capsule, a fascia.
//
// A skin with hardly any bending stiffness carries a point by stretching around it. If the dimple
// is L wide, then at the depth d the skin stores about M d^4 / L^2 and the tissue below E* d^2 L,
// with M the skin's modulus times its thickness and E* = E / (1 - nu^2). So L^3 goes as M d^2 / E*,
// and
//   F(d) = C E*^(2/3) M^(1/3) d^(5/3),
// for any needle, as long as contact is narrower than L; it is a little less where the skin becomes
// steep. C and that reduction come from a stretched skin, bonded to a half space, solved by
// finite elements (tests/fidelity/coupling/film.py).
//
// The law of contact (cone.h) has two parabolas and a line. It agrees with a film at the depth at
// which the film is punctured and at kFilmShallow of that, and is within three hundredths of it
// from a tenth of that on. It changes over at kFilmFirst and kFilmChange of that depth.
//
// Promises: no allocation, no branch on hardware. Units SI. PHYSICS 8.2.
#pragma once

#include "laws/cone.h"

namespace stylet {

constexpr float kFilmFirst = 0.08F, kFilmChange = 0.72F, kFilmShallow = 0.22F;

// Depth and force at which the law of contact is the film's, and how wide contact is, over its
// width there, where it changes over first; force 0 without a film.
struct Film {
  float depth_m, force_n, first_width;
};

inline Widening film_widening(const Film& film) {
  return {kFilmChange * film.depth_m, kFilmFirst * film.depth_m, film.first_width};
}

// Force of the law at a fraction of that depth, over k and that depth. It is linear in the width.
inline float film_shape(float share, float first_width) {
  const Cone law = {1, {kFilmChange, kFilmFirst, first_width}, 0, 0, 0};
  return cone_point(law, share).force_m();
}

// Stiffness of the punch of that law.
inline float film_punch_n_per_m(const Film& film) {
  return film.force_n / (film.depth_m * film_shape(1, film.first_width));
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
  const float low = film_shape(kFilmShallow, 0), high = film_shape(1, 0);
  const float more_low = film_shape(kFilmShallow, 1) - low, more_high = film_shape(1, 1) - high;
  // share = (low + more_low w) / (high + more_high w) for the first width w.
  const float width = (share * high - low) / (more_low - share * more_high);
  return {high_m, force, clamp(width, kFilmFirst / kFilmChange, 1)};
}

}  // namespace stylet
