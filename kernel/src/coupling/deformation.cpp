// SPDX-License-Identifier: Apache-2.0
#include "coupling/deformation.h"

#include "coupling/spring.h"

namespace stylet {
namespace {

// A voxel's deformation is valid this far from its centre, in voxel edges.
constexpr float kVoxelReach = 0.5F;
// In tissue pressed to less than this part of its volume, or turned inside out, no direction is
// better than another.
constexpr float kCrushed = 0.05F;

}  // namespace

Gradient gradient_around(const Model& model, const State& state, const Particle& p) {
  float f[9] = {};
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    const Corners corners = sum_corners(model, state, p.support[i].slot, p.support[i].row);
    for (int j = 0; j < 9; ++j) f[j] += p.support[i].weight * corners.gradient[j];
  }
  Gradient g = {{1 + f[0], f[3], f[6]},
                {f[1], 1 + f[4], f[7]},
                {f[2], f[5], 1 + f[8]},
                0,
                level_of(model, p).edge_m};
  g.det = dot(g.c0, cross(g.c1, g.c2));
  return g;
}

Vec3 pull_back(const Gradient& g, Vec3 step) {
  if (!(g.det > kCrushed)) return step;
  return (1 / g.det) * Vec3{dot(step, cross(g.c1, g.c2)), dot(step, cross(g.c2, g.c0)),
                            dot(step, cross(g.c0, g.c1))};
}

Vec3 pull_back_step(const Gradient& g, Vec3 step_m) {
  const Vec3 image = pull_back(g, step_m);
  const float length = norm(image);
  const float most = max_of(kVoxelReach * g.edge_m, norm(step_m));
  return length > most ? (most / length) * image : image;
}

}  // namespace stylet
