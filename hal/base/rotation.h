// SPDX-License-Identifier: Apache-2.0
// Rotations as quaternions, and the cross product they are made of.
// Promise: only + - * and sqrt, so the same bits everywhere; no allocation. Quaternions have unit
// length. Frames: any, right-handed. Source: Kuipers, Quaternions and Rotation Sequences, 1999.
#pragma once

#include "stylet/units.h"

namespace stylet::hal {

Vec3 cross(Vec3 a, Vec3 b);
Vec3 rotate(const Quat& q, Vec3 v);
// The rotation by `b`, then by `a`.
Quat product(const Quat& a, const Quat& b);
inline Quat inverse(const Quat& q) {
  return {q.w, -q.x, -q.y, -q.z};
}

}  // namespace stylet::hal
