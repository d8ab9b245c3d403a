// SPDX-License-Identifier: Apache-2.0
// Rotations and axes as vendors give them, in ours. Plain arithmetic, no allocation.
#pragma once

#include "stylet/units.h"

namespace stylet::hal {

// Of a rotation matrix, row by row; its largest component is the one divided by.
Quat rotation_of(const double (&m)[3][3]);

// Force Dimension and Haply count x toward the user, y right, z up; we count x right, y up, z
// toward the user. A cyclic change of axes: handedness and rotations stay.
inline Vec3 from_user_first(double x, double y, double z) {
  return {static_cast<float>(y), static_cast<float>(z), static_cast<float>(x)};
}
struct UserFirst {
  double x, y, z;
};
inline UserFirst to_user_first(Vec3 v) {
  return {static_cast<double>(v.z), static_cast<double>(v.x), static_cast<double>(v.y)};
}
inline Quat from_user_first(const Quat& q) {
  return {q.w, q.y, q.z, q.x};
}

}  // namespace stylet::hal
