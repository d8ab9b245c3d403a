// SPDX-License-Identifier: Apache-2.0
// Vectors as a test looks at them: in double, and with none of the product's own arithmetic.
#pragma once

#include <cmath>

#include "stylet/units.h"

namespace stylet::test {

inline double size(Vec3 v) {
  return std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
}
inline Vec3 minus(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

}  // namespace stylet::test
