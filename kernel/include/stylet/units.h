// SPDX-License-Identifier: Apache-2.0
// Plain values that cross the kernel's boundary.
// Promise: trivially copyable, no padding, no pointer.
// Units: SI. Frames: right-handed; "world" is the organ's rest frame.
#pragma once

#include <cstdint>

namespace stylet {

struct Vec3 {
  float x, y, z;
};

// Unit quaternion, Hamilton convention: it turns handle coordinates into world coordinates.
struct Quat {
  float w, x, y, z;
};

struct Pose {
  Vec3 position_m;
  Quat rotation;
};

}  // namespace stylet
