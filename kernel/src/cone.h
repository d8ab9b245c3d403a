// SPDX-License-Identifier: Apache-2.0
// The tip in contact: a cone that sinks into a half space, and what the tissue under it relaxes.
//
// Contact widens as the cone sinks in (Sneddon 1965: force with the square of depth), until it is
// as wide as the needle (flat punch: force with depth). One law has both limits and an energy:
//   F(d) = k d^2 / (d + l),   U(d) = k (d^2 / 2 - l d + l^2 ln(1 + d / l)),
// with k the punch's stiffness and l its pi a / tan(half angle). Relaxation is quasi-linear (Fung):
// the relaxed force q follows F in time and a share s of it is missing, f = F(d) - s q. With y the
// depth at which F(y) = q, the energy is U(d) - s (U(y) + q (d - y)), which creep can only lower.
// As vectors: F and q point along the displacement they belong to.
//
// The law is that of all the tissue. The lattice gives way by itself, by a part c of the punch's
// 1 / k; what is left for the tip's own spring is y = d - c F(d) / k: the same force at a smaller
// depth, with U(d) - c F^2 / (2 k). Giving the spring a cone of its own instead made the whole law
// depend on the voxel.
//
// Promises: no branch on hardware, no allocation. Units SI.
#pragma once

#include "math.h"
#include "stylet/kernel.h"

namespace stylet {

struct Cone {
  float stiffness_n_per_m;  // of the punch on all the tissue, k
  float length_m;           // l
  float lattice_part;       // c, below 1
};

// pi a / tan(half angle) of a needle's tip.
inline float cone_length_m(const NeedleConfig& needle) {
  constexpr float kPi = 3.14159265F;
  const float half_turns = needle.tip_half_angle_rad / kPi;
  const float cosine = sine_of_half_turns(0.5F - half_turns);
  return kPi * needle.outer_radius_m * cosine / sine_of_half_turns(half_turns);
}

// Depth over the spring's own, at least 1: the positive root of
// (1 - c) d^2 + (l - y) d - l y = 0, over y.
inline float cone_ratio(const Cone& c, float own_m) {
  const float half = 0.5F * (c.length_m - own_m);
  const float left = 1 - c.lattice_part;
  const float root = std::sqrt(half * half + left * c.length_m * own_m);
  return half > 0 ? c.length_m / (half + root) : (root - half) / (left * own_m);
}

// Force over the spring's own depth.
inline float cone_secant(const Cone& c, float own_m) {
  const float ratio = cone_ratio(c, own_m), depth = ratio * own_m;
  return c.stiffness_n_per_m * ratio * depth / (depth + c.length_m);
}

// Change of force with the spring's own depth.
inline float cone_tangent(const Cone& c, float own_m) {
  const float depth = cone_ratio(c, own_m) * own_m;
  const float part = depth / (depth + c.length_m);
  const float whole = part * (2 - part);
  return c.stiffness_n_per_m * whole / (1 - c.lattice_part * whole);
}

// The spring's own depth at a force; k d^2 = F (d + l) gives d.
inline float cone_depth(const Cone& c, float force_n) {
  const float half = 0.5F * force_n / c.stiffness_n_per_m;
  return (half + std::sqrt(half * (half + 2 * c.length_m))) - 2 * c.lattice_part * half;
}

// The logarithm is a series where its leading terms cancel.
inline double cone_energy(const Cone& c, float own_m) {
  const float x = cone_ratio(c, own_m) * own_m / c.length_m;
  const float series =
      x * x * x * (1.0F / 3 - x * (1.0F / 4 - x * (1.0F / 5 - x * (1.0F / 6 - x / 7))));
  const float whole = 0.5F * x * x - x + natural_log(1 + x);
  const float force = x * x / (1 + x);  // over k l
  const float unit = c.stiffness_n_per_m * c.length_m * c.length_m;
  return static_cast<double>(unit) *
         static_cast<double>((x < 0.1F ? series : whole) - 0.5F * c.lattice_part * force * force);
}

// Energy at the spring's displacement with relaxed force q, of which the share s is missing.
inline double cone_energy(const Cone& c, Vec3 displacement_m, Vec3 relaxed_n, float share) {
  const float y = cone_depth(c, norm(relaxed_n)), q = norm(relaxed_n);
  const double left = static_cast<double>(dot(relaxed_n, displacement_m) - q * y);
  return cone_energy(c, norm(displacement_m)) -
         static_cast<double>(share) * (cone_energy(c, y) + left);
}

}  // namespace stylet
