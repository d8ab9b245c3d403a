// SPDX-License-Identifier: Apache-2.0
// Vectors and poses of the interface as the kernel has them, and back.
#pragma once

#include "stylet/stylet.h"
#include "stylet/units.h"

namespace stylet::c {

inline Vec3 vec(stylet_vec3 v) {
  return {v.x, v.y, v.z};
}
inline stylet_vec3 plain(Vec3 v) {
  return {v.x, v.y, v.z};
}
inline Pose pose(const stylet_pose& p) {
  return {vec(p.position_m), {p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z}};
}
inline stylet_pose plain(const Pose& p) {
  return {plain(p.position_m), {p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z}};
}

}  // namespace stylet::c
