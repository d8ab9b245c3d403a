// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors as Eigen's, for the few files that need a matrix: an inverse, an eigenvector, a rotation.
// Vec itself stays a plain struct: it begins as zero and is part of constant tables, which Eigen's
// vectors do not and cannot. Promise: exact copies. Units and frame: those of what is given.
#pragma once

#include <Eigen/Core>

#include "base/geometry.h"

namespace stylet::offline {

inline Eigen::Vector3d to_eigen(Vec v) {
  return {v.x, v.y, v.z};
}
inline Vec from_eigen(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

inline Eigen::Matrix3d columns_of(const std::array<Vec, 3>& v) {
  return (Eigen::Matrix3d() << to_eigen(v[0]), to_eigen(v[1]), to_eigen(v[2])).finished();
}
inline std::array<Vec, 3> rows_of(const Eigen::Matrix3d& m) {
  return {from_eigen(m.row(0)), from_eigen(m.row(1)), from_eigen(m.row(2))};
}

}  // namespace stylet::offline
