// SPDX-License-Identifier: Apache-2.0
// Geometry of the embedded surface that organ_raycast and the tick share.
#pragma once

#include "base/math.h"
#include "stylet/levels.h"
#include "stylet/organ.h"

namespace stylet {

// Place at rest of a surface vertex; `voxel` has the cell of its voxel in space, in edges of its
// level.
inline Vec3 rest_place(const Organ& organ, Vec3 voxel, std::uint32_t level, const OrganVertex& v) {
  constexpr float kScale = 1.0F / 65535.0F;
  const Vec3 inside = {static_cast<float>(v.fx) * kScale, static_cast<float>(v.fy) * kScale,
                       static_cast<float>(v.fz) * kScale};
  return organ.origin_m + (organ.voxel_edge_m * edge_ratio(level)) * (voxel + inside);
}

// Crossing of a line with a triangle: distance `t` along the unit direction (any sign), barycentric
// weights `u` of b and `v` of c. Moeller and Trumbore, "Fast, minimum storage ray-triangle
// intersection", 1997.
inline bool hit_triangle(Vec3 from_m, Vec3 direction, Vec3 a, Vec3 b, Vec3 c, float& t, float& u,
                         float& v) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 p = cross(direction, ac);
  const float det = dot(ab, p);
  if (!(det > 1e-20F || det < -1e-20F)) return false;
  const float inverse = 1 / det;
  const Vec3 gap = from_m - a;
  u = dot(gap, p) * inverse;
  const Vec3 q = cross(gap, ab);
  v = dot(direction, q) * inverse;
  t = dot(ac, q) * inverse;
  return u >= 0 && v >= 0 && u + v <= 1;
}

}  // namespace stylet
