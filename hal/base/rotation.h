// SPDX-License-Identifier: Apache-2.0
// Rotations as quaternions.
// Promise: only + - * / and sqrt in the written order, so the same bits everywhere; no allocation.
// Without Eigen, whose product of quaternions adds in another order with vector instructions than
// without. Quaternions have unit length. Frames: any, right-handed.
// Source: Kuipers, Quaternions and Rotation Sequences, 1999.
#pragma once

#include "stylet/units.h"

namespace stylet::hal {

Vec3 rotate(const Quat& q, Vec3 v);
// The rotation by `b`, then by `a`.
Quat product(const Quat& a, const Quat& b);
inline Quat inverse(const Quat& q) {
  return {q.w, -q.x, -q.y, -q.z};
}
// The same of unit length again, after a product or a small step.
Quat unit(const Quat& q);

}  // namespace stylet::hal
