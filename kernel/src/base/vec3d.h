// SPDX-License-Identifier: Apache-2.0
// Vectors in double precision, for small differences of large numbers. As in math.h: a written
// order, so the same bits everywhere.
#pragma once

#include <cmath>

#include "stylet/units.h"

namespace stylet {

// What returns a vector is always inlined, for the reason given in math.h.
struct Vec3d {
  double x, y, z;
};

[[gnu::always_inline]] constexpr Vec3d operator+(Vec3d a, Vec3d b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] constexpr Vec3d operator-(Vec3d a, Vec3d b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] constexpr Vec3d operator*(double s, Vec3d a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr double dot(Vec3d a, Vec3d b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] constexpr Vec3d cross(Vec3d a, Vec3d b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3d a) {
  return std::sqrt(dot(a, a));
}
[[gnu::always_inline]] constexpr Vec3d to_double(Vec3 a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}
[[gnu::always_inline]] constexpr Vec3 to_float(Vec3d a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

// The part of v across a unit normal.
[[gnu::always_inline]] constexpr Vec3d across(Vec3d normal, Vec3d v) {
  return v - dot(normal, v) * normal;
}
constexpr double max_of(double a, double b) {
  return a > b ? a : b;
}
constexpr double min_of(double a, double b) {
  return a < b ? a : b;
}

}  // namespace stylet
