// SPDX-License-Identifier: Apache-2.0
// Vectors in double, where the square of any finite float stays finite: Eigen's, with sums of ours.
// Promise: only + - * / and sqrt, so the same bits everywhere; no allocation. Eigen adds the three
// products of a dot product in one order with its vector instructions and in another without them,
// so dot and length are written out. Units: those of what is given. Frames: any, right-handed.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "stylet/units.h"

namespace stylet::hal {

inline Eigen::Vector3d wide(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline Vec3 narrow(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}
inline double length(const Eigen::Vector3d& v) {
  return std::sqrt(dot(v, v));
}

// Of vectors in float, computed in double.
inline double wide_dot(Vec3 a, Vec3 b) {
  return dot(wide(a), wide(b));
}
inline double wide_length(Vec3 v) {
  return length(wide(v));
}
inline Vec3 scaled(Vec3 v, double s) {
  return narrow(s * wide(v));
}
inline Vec3 shortened(Vec3 v, double most) {
  const double size = wide_length(v);
  return size > most ? scaled(v, most / size) : v;
}

}  // namespace stylet::hal
