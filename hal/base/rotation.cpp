// SPDX-License-Identifier: Apache-2.0
#include "hal/base/rotation.h"

#include <cmath>

#include "hal/base/vector.h"

namespace stylet::hal {

Quat product(const Quat& a, const Quat& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Vec3 rotate(const Quat& q, Vec3 v) {
  const Vec3 axis = {q.x, q.y, q.z};
  const Vec3 twice = 2 * cross(axis, v);
  return v + q.w * twice + cross(axis, twice);
}

Quat unit(const Quat& q) {
  const float size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / size, q.x / size, q.y / size, q.z / size};
}

}  // namespace stylet::hal
