// SPDX-License-Identifier: Apache-2.0
// Vectors of the kernel's boundary: what is computed with them in float. In double: wide.h.
// Promise: only + - * and sqrt in the written order, so the same bits everywhere; no allocation.
// Without Eigen: to and from its types each Vec3 would be converted, and it adds products in an
// order that differs from processor to processor. Units: those of what is given. Frames: any,
// right-handed.
#pragma once

#include <cmath>

#include "stylet/units.h"

namespace stylet::hal {

inline Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator*(float s, Vec3 v) {
  return {s * v.x, s * v.y, s * v.z};
}
inline float dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline float length(Vec3 v) {
  return std::sqrt(dot(v, v));
}
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline bool finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace stylet::hal
