// SPDX-License-Identifier: Apache-2.0
// The tip in contact: a cone that sinks into a half space, and what the tissue under it relaxes.
//
// Contact widens as the cone sinks in (Sneddon 1965: force with the square of depth), until it is
// as wide as the needle (flat punch: force with depth). One law has both limits and an energy:
//   F(d) = k d^2 / (d + l),   U(d) = k (d^2 / 2 - l d + l^2 ln(1 + d / l)),
// with k the punch's stiffness and l its pi a / tan(half angle). Relaxation is quasi-linear (Fung):
// the relaxed force q follows F in time and a share s of it is missing, f = F(d) - s q. With y the
// depth at which F(y) = q, the energy is U(d) - s (U(y) + q (d - y)), which creep can only lower.
// Deep as vectors: F and q point along the displacement they belong to.
//
// Promises: no branch on hardware, no allocation. Units SI.
#pragma once

#include "math.h"

namespace stylet {

// pi over the tangent of a tip's half angle of 15 degrees.
constexpr float kConeLengthInRadii = 11.7F;

struct Cone {
  float stiffness_n_per_m;  // of the punch, k
  float length_m;           // l
};

inline float cone_secant(const Cone& c, float depth_m) {
  return c.stiffness_n_per_m * depth_m / (depth_m + c.length_m);
}

inline float cone_tangent(const Cone& c, float depth_m) {
  const float part = depth_m / (depth_m + c.length_m);
  return c.stiffness_n_per_m * part * (2 - part);
}

// Depth of a force: the positive root of k y^2 = q (y + l).
inline float cone_depth(const Cone& c, float force_n) {
  const float half = 0.5F * force_n / c.stiffness_n_per_m;
  return half + std::sqrt(half * (half + 2 * c.length_m));
}

// The logarithm is a series where its leading terms cancel.
inline double cone_energy(const Cone& c, float depth_m) {
  const float x = depth_m / c.length_m;
  const float series =
      x * x * x * (1.0F / 3 - x * (1.0F / 4 - x * (1.0F / 5 - x * (1.0F / 6 - x / 7))));
  const float whole = 0.5F * x * x - x + natural_log(1 + x);
  const float unit = c.stiffness_n_per_m * c.length_m * c.length_m;
  return static_cast<double>(unit) * static_cast<double>(x < 0.1F ? series : whole);
}

// Energy at displacement d with relaxed force q, of which the share s is missing.
inline double cone_energy(const Cone& c, Vec3 displacement_m, Vec3 relaxed_n, float share) {
  const float y = cone_depth(c, norm(relaxed_n)), q = norm(relaxed_n);
  const double left = static_cast<double>(dot(relaxed_n, displacement_m) - q * y);
  return cone_energy(c, norm(displacement_m)) -
         static_cast<double>(share) * (cone_energy(c, y) + left);
}

}  // namespace stylet
