// SPDX-License-Identifier: Apache-2.0
#include "hal/base/rotation.h"

namespace stylet::hal {

Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Quat product(const Quat& a, const Quat& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Vec3 rotate(const Quat& q, Vec3 v) {
  const Vec3 axis = {q.x, q.y, q.z};
  const Vec3 twice = cross(axis, v);
  const Vec3 t = {2 * twice.x, 2 * twice.y, 2 * twice.z};
  const Vec3 u = cross(axis, t);
  return {v.x + q.w * t.x + u.x, v.y + q.w * t.y + u.y, v.z + q.w * t.z + u.z};
}

}  // namespace stylet::hal
