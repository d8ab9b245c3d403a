// SPDX-License-Identifier: Apache-2.0
// Crossings of a ray with the rest surface, by its tree of spheres; outside ticks.

#include "organ/triangle.h"
#include "stylet/limits.h"
#include "stylet/organ.h"

namespace stylet {
namespace {

// Walks the runs for the voxel: callers only ask for a few triangles.
Vec3 vertex_rest(const Organ& organ, std::uint32_t index) {
  const OrganVertex& v = organ.vertices[index];
  std::uint32_t first = 0;
  for (const OrganRun& run : organ.runs) {
    if (v.voxel < first + run.count) {
      return organ_vertex_place(organ, run.x + (v.voxel - first),
                                std::uint32_t{run.y} % organ.sheet_rows, run.z, v);
    }
    first += run.count;
  }
  return {};
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
  const std::uint32_t level = level_of(organ.level_planes, voxel_z);
  const std::uint32_t z = voxel_z - first_plane(organ.level_planes, level);
  const Vec3 voxel = {static_cast<float>(voxel_x), static_cast<float>(voxel_y),
                      static_cast<float>(z)};
  return rest_place(organ, voxel, level, vertex);
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
