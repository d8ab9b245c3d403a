// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/mapping.h"

#include <cmath>

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

Pose to_world(const Mapping& mapping, const Pose& device) {
  const Vec3 p = rotate(mapping.rotation, device.position_m);
  return {{mapping.origin_m.x + p.x, mapping.origin_m.y + p.y, mapping.origin_m.z + p.z},
          product(mapping.rotation, device.rotation)};
}

Vec3 to_device(const Mapping& mapping, Vec3 world_vector) {
  const Quat& q = mapping.rotation;
  return rotate({q.w, -q.x, -q.y, -q.z}, world_vector);
}

Vec3 place_in_device(const Mapping& mapping, Vec3 world_place) {
  const Vec3& o = mapping.origin_m;
  return to_device(mapping, {world_place.x - o.x, world_place.y - o.y, world_place.z - o.z});
}

Quat needle_rotation(Vec3 direction) {
  // Half-way quaternion: (1 + a.b, a x b) with a = -z; next to +z it has no length, so turn about
  // x.
  const float w = 1.0F - direction.z;
  if (w < 1e-6F) return {0, 1, 0, 0};
  const Vec3 axis = cross({0, 0, -1}, direction);
  const float size = std::sqrt(w * w + axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  return {w / size, axis.x / size, axis.y / size, axis.z / size};
}

}  // namespace stylet::hal
