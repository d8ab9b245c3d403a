// SPDX-License-Identifier: Apache-2.0
// Energy and force of a touch of a body: the law of obstacle.h, for one contact.
//
// Promises: finite for finite arguments, no negative stiffness. Units SI. Source: the law of
// pressing is ours. Friction is Coulomb's as a return map, which for a given limit has a potential
// (Huber's function), so that a needle's equilibrium is the minimum of an energy. PHYSICS 13.3.
#pragma once

#include "base/vec3d.h"

namespace stylet {

// Stiffness k at small depth, the largest force in the end: F = k d / sqrt(1 + (k d / F_max)^2).
struct Press {
  double force_n, stiffness_n_per_m, energy_j;
  double chord_n_per_m;  // force over depth: at least the stiffness here or deeper
};
inline Press press(double k, double largest_force_n, double depth_m) {
  if (!(depth_m > 0)) return {0, 0, 0, 0};
  const double u = k * depth_m / largest_force_n;
  const double root = std::sqrt(1 + u * u);
  return {k * depth_m / root, k / (root * root * root), k * depth_m * depth_m / (1 + root),
          k / root};
}

// The bristle follows the needle until its tension reaches the limit.
struct Slip {
  Vec3d bristle_m;
  double energy_j;  // of the potential: stored energy, and what slip took since rest
  bool slips;
};
inline Slip slip(double k, double limit_n, Vec3d trial_m) {
  const double length = norm(trial_m), tension = k * length;
  if (!(tension > limit_n)) return {trial_m, 0.5 * tension * length, false};
  return {(limit_n / tension) * trial_m, limit_n * (length - 0.5 * limit_n / k), true};
}

}  // namespace stylet
