// SPDX-License-Identifier: Apache-2.0
// Rotations and axes as vendors give them, converted to ours. Plain arithmetic, no allocation.
#pragma once

#include "stylet/units.h"

namespace stylet::hal {

// Quaternion of a rotation matrix, given row by row; divides by its largest component.
Quat rotation_of(const double (&m)[3][3]);

// Force Dimension and Haply have x toward the user, y right, z up; we have x right, y up, z toward
// the user. A cyclic change of axes keeps handedness and rotations.
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
