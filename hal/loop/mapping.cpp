// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/mapping.h"

#include "hal/base/rotation.h"
#include "hal/base/vector.h"

namespace stylet::hal {

Pose to_world(const Mapping& mapping, const Pose& device) {
  return {mapping.origin_m + rotate(mapping.rotation, device.position_m),
          product(mapping.rotation, device.rotation)};
}

Vec3 to_device(const Mapping& mapping, Vec3 world_vector) {
  return rotate(inverse(mapping.rotation), world_vector);
}

Vec3 place_in_device(const Mapping& mapping, Vec3 world_place) {
  return to_device(mapping, world_place - mapping.origin_m);
}

Quat needle_rotation(Vec3 direction) {
  // Half-way quaternion: (1 + a.b, a x b) with a = -z. Close to +z it has no length, so use half a
  // turn about x.
  const float w = 1.0F - direction.z;
  if (w < 1e-6F) return {0, 1, 0, 0};
  const Vec3 axis = cross({0, 0, -1}, direction);
  return unit({w, axis.x, axis.y, axis.z});
}

}  // namespace stylet::hal
