// SPDX-License-Identifier: Apache-2.0
// Crossings of a ray with the rest surface, by its tree of spheres; outside ticks.

#include "organ/triangle.h"
#include "stylet/limits.h"
#include "stylet/organ.h"

namespace stylet {
namespace {

// Lattice coordinates of a voxel, by walking the runs: callers only ask for a few triangles.
Vec3 voxel_low_corner(const Organ& organ, std::uint32_t voxel) {
  std::uint32_t first = 0;
  for (const OrganRun& run : organ.runs) {
    if (voxel < first + run.count) {
      return {static_cast<float>(run.x + (voxel - first)),
              static_cast<float>(run.y % organ.sheet_rows), static_cast<float>(run.z)};
    }
    first += run.count;
  }
  return {};
}

Vec3 vertex_rest(const Organ& organ, std::uint32_t index) {
  const OrganVertex& v = organ.vertices[index];
  return rest_place(organ, voxel_low_corner(organ, v.voxel), v);
}

bool near_ray(const OrganSphere& sphere, Vec3 origin_m, Vec3 direction) {
  const Vec3 to = Vec3{sphere.x, sphere.y, sphere.z} - origin_m;
  const float along = max_of(dot(to, direction), 0);
  const Vec3 gap = to - along * direction;
  return dot(gap, gap) <= sphere.radius * sphere.radius;
}

}  // namespace

Vec3 organ_vertex_place(const Organ& organ, std::uint32_t voxel_x, std::uint32_t voxel_y,
                        std::uint32_t voxel_z, const OrganVertex& vertex) {
  const Vec3 voxel = {static_cast<float>(voxel_x), static_cast<float>(voxel_y),
                      static_cast<float>(voxel_z)};
  return rest_place(organ, voxel, vertex);
}

bool organ_raycast(const Organ& organ, Vec3 origin_m, Vec3 direction, float& distance_out_m) {
  bool found = false;
  std::uint32_t stack[kMaxTreeDepth];
  std::uint32_t top = 0;
  if (!organ.spheres.empty()) stack[top++] = 0;
  while (top > 0) {
    const OrganSphere& node = organ.spheres[stack[--top]];
    if (!near_ray(node, origin_m, direction)) continue;
    if (node.count == 0) {
      stack[top++] = node.first + 1;
      stack[top++] = node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const OrganTriangle& t = organ.triangles[i];
      float at = 0, u = 0, v = 0;
      if (!hit_triangle(origin_m, direction, vertex_rest(organ, t.a), vertex_rest(organ, t.b),
                        vertex_rest(organ, t.c), at, u, v) ||
          at < 0 || (found && at >= distance_out_m)) {
        continue;
      }
      found = true;
      distance_out_m = at;
    }
  }
  return found;
}

}  // namespace stylet
