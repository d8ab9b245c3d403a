// SPDX-License-Identifier: Apache-2.0
// The most expensive possible tick, apart from the number of voxels: every pool of limits.h is full
// at once.
//
// Four elastic needles of kMaxRods rods go down as fast as a hand may, with kMaxDropsPerTick new
// constraint particles a tick and needle, until each has kMaxConstraintParticles of them and as
// many voxels of its own as the lattice can give. All their rods are inside all kMaxObstacles
// obstacles, hulls of kMaxHullVertices vertices that are too soft to push anything away;
// kMaxSubsteps substeps. The hand is a function of the tick alone. Units: SI. Frame: world, the
// needles come from +z.
#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "session.h"

namespace stylet::test {

// Voxels and needle units are an eighth as long as the way of a tick.
constexpr float kWorstEdgeM = 0.6e-3F;
constexpr std::uint64_t kWorstTicks = 24;

struct WorstCase {
  std::unique_ptr<OpenOrgan> organ;
  Config config;
  std::vector<ObstacleConfig> obstacles;
};

inline std::unique_ptr<OpenOrgan> worst_organ() {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = 16;
  tiny.nz = kMaxConstraintParticles + 12;
  tiny.voxel_edge_m = kWorstEdgeM;
  tiny.fixed_faces = kLowX | kHighX | kLowY | kHighY | kLowZ;
  TinyMaterial& gel = tiny.materials[0];
  gel.youngs_modulus_pa = 2e4F;
  gel.puncture_force_n = 1e-3F;
  gel.cutting_force_n = 1e-3F;
  gel.coulomb_friction_n_per_m = gel.static_friction_n_per_m = 1e-2F;
  gel.viscous_friction_n_s_per_m2 = 1e-3F;
  gel.relaxing_fraction = 0.5F;
  gel.puncture_velocity_exponent = 0.1F;
  return open_organ(tiny_organ(tiny));
}

inline Config worst_config() {
  Config config;
  config.inertia = Inertia::kAddedMass;  // with it tissue is dragged along while pools are full
  config.substeps = kMaxSubsteps;
  config.needle_count = kMaxNeedles;
  config.breathing = {{1e-5F, 0, 0}, 2};
  for (NeedleConfig& needle : config.needle) {
    needle.length_m = 0.12F;
    needle.unit_m = kWorstEdgeM;
    needle.bending_nm2 = 2e-2F;
    needle.rods = kMaxRods;
    needle.bevel_per_m = 1;
  }
  return config;
}

// Around all needles, from far above to far below: rings of vertices, each body turned a little.
inline std::vector<ObstacleConfig> worst_obstacles(Vec3 middle_m) {
  std::vector<ObstacleConfig> bodies(kMaxObstacles);
  for (std::uint32_t b = 0; b < kMaxObstacles; ++b) {
    ObstacleConfig& body = bodies[b];
    body.pose.position_m = middle_m;
    body.vertex_count = kMaxHullVertices;
    for (std::uint32_t i = 0; i < kMaxHullVertices; ++i) {
      const double angle = 0.19 * i + 0.05 * b;
      const float height = 0.3F * (static_cast<float>(i % 8) - 3.5F) / 3.5F;
      const float radius = 0.05F - 0.2F * height * height;
      body.vertices_m[i] = {radius * static_cast<float>(std::cos(angle)),
                            radius * static_cast<float>(std::sin(angle)), height};
    }
    body.stiffness_n_per_m = 1e-6F;
    body.largest_force_n = 1e-6F;
    body.friction = 0.5F;
  }
  return bodies;
}

inline WorstCase worst_case() {
  WorstCase made = {worst_organ(), worst_config(), {}};
  const Script script = block_script(made.organ->organ, made.config);
  made.obstacles = worst_obstacles(script.entry_m);
  return made;
}

inline void worst_inputs(const WorstCase& worst, std::uint64_t tick, std::span<Input> inputs) {
  const Script script = block_script(worst.organ->organ, worst.config);
  const float step_m = 0.999F * kMaxHandleSpeedMPerS * worst.config.period_s;
  const float deep_m = kWorstEdgeM * (kMaxConstraintParticles + 4);
  const float down_m = std::min(static_cast<float>(tick) * step_m - 1e-3F, deep_m);
  for (std::uint32_t i = 0; i < kMaxNeedles; ++i) {
    inputs[i] = {{script.entry_m, {1, 0, 0, 0}}, 1};
    Vec3& base = inputs[i].handle.position_m;
    base.x += kWorstEdgeM * ((i & 1U) != 0 ? 3.3F : -3.3F);
    base.y += kWorstEdgeM * ((i & 2U) != 0 ? 4.5F : -3.5F);
    base.z += script.needle_length_m - down_m;
  }
}

}  // namespace stylet::test
