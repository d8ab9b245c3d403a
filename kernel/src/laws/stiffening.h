// SPDX-License-Identifier: Apache-2.0
// Tissue that gets stiffer the more it is strained.
//
// With S = R^T F the strain of a voxel seen from its rotation, J is the squared norm of the part of
// S that changes the shape, not the volume. Linear tissue stores G J; this stores
//   G (J + b J^2 / (2 + b J / Z)),
// so its shear modulus, the derivative by J, is G at rest, grows as G (1 + b J) and ends at
// G (1 + Z), with Z = kMaxStiffer. In a small shear e, J is e^2 / 2; in an isochoric stretch by the
// small strain e, it is 3 e^2 / 2. Rational: no step of the strain takes more than one division,
// and the stiffest motion (the largest second derivative of the energy, at b J = 2 Z) is bounded.
//
// Promises: no branch, finite for all finite J >= 0. PHYSICS 2.7.
#pragma once

#include "stylet/limits.h"

namespace stylet {

// Internal linkage: compiled for several instruction sets.
// What is added to the shear modulus, over the modulus at rest. `Number`: float or lanes of it.
template <typename Number>
static inline Number stiffer(Number stiffening, Number shape) {
  const Number x = stiffening * shape * (0.5F / kMaxStiffer), y = 1.0F / (1.0F + x);
  return kMaxStiffer * (x * y) * (1.0F + y);
}

// Largest value of stiffer + 2 J d(stiffer)/dJ, over kMaxStiffer: of what a motion along the strain
// adds to the stiffness.
constexpr float kStiffestMotion = 1.25F;

// What is added to the energy, over the modulus at rest.
inline double stiffening_energy(double stiffening, double shape) {
  const double grown = stiffening * shape;
  return grown * shape / (2 + grown / static_cast<double>(kMaxStiffer));
}

}  // namespace stylet
