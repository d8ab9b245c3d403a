// SPDX-License-Identifier: Apache-2.0
// Poses of a needle by the direction in which it points. Units: SI. Frame: world.
#pragma once

#include <cmath>

#include "stylet/kernel.h"

namespace stylet::test {

// Shortest rotation that takes the needle's own axis, -z, to `direction`, which has unit length
// and is not +z.
inline Quat towards(Vec3 direction) {
  const Vec3 axis = {direction.y, -direction.x, 0};  // (-z) x direction
  const Quat q = {1 - direction.z, axis.x, axis.y, axis.z};
  const float n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / n, q.x / n, q.y / n, q.z / n};
}

}  // namespace stylet::test
