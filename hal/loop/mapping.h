// SPDX-License-Identifier: Apache-2.0
// From the device's frame to the world's and back: a rotation and a shift.
// Promise: only + - * and sqrt, so the same bits everywhere; no allocation.
// Units: SI. Frames: device (x right, y up, z toward the operator) and world.
#pragma once

#include "stylet/units.h"

namespace stylet::hal {

struct Mapping {
  Quat rotation = {1, 0, 0, 0};  // turns device coordinates into world coordinates
  Vec3 origin_m = {};            // of the device, in the world
};

Pose to_world(const Mapping& mapping, const Pose& device);
Vec3 to_device(const Mapping& mapping, Vec3 world_vector);
Vec3 place_in_device(const Mapping& mapping, Vec3 world_place);

// The shortest rotation that turns -z into `direction` (unit length).
Quat needle_rotation(Vec3 direction);

}  // namespace stylet::hal
