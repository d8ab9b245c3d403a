// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/mapping.h"

#include <cmath>

#include "hal/base/rotation.h"

namespace stylet::hal {

Pose to_world(const Mapping& mapping, const Pose& device) {
  const Vec3 p = rotate(mapping.rotation, device.position_m);
  return {{mapping.origin_m.x + p.x, mapping.origin_m.y + p.y, mapping.origin_m.z + p.z},
          product(mapping.rotation, device.rotation)};
}

Vec3 to_device(const Mapping& mapping, Vec3 world_vector) {
  return rotate(inverse(mapping.rotation), world_vector);
}

Vec3 place_in_device(const Mapping& mapping, Vec3 world_place) {
  const Vec3& o = mapping.origin_m;
  return to_device(mapping, {world_place.x - o.x, world_place.y - o.y, world_place.z - o.z});
}

Quat needle_rotation(Vec3 direction) {
  // Half-way quaternion: (1 + a.b, a x b) with a = -z. Close to +z it has no length, so use half a
  // turn about x.
  const float w = 1.0F - direction.z;
  if (w < 1e-6F) return {0, 1, 0, 0};
  const Vec3 axis = cross({0, 0, -1}, direction);
  const float size = std::sqrt(w * w + axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  return {w / size, axis.x / size, axis.y / size, axis.z / size};
}

}  // namespace stylet::hal
