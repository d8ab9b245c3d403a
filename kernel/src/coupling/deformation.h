// SPDX-License-Identifier: Apache-2.0
// The deformation of the tissue around a constraint particle (CP), by which a step in deformed
// tissue becomes a step in the rest frame.
//
// Rest places must follow the material, not only the rotation: else a needle that leaves strained
// tissue does not find its way back to its entry.
//
// Promises: bounded by kSupportsPerParticle, no allocation. Units SI. PHYSICS 9.3.
#pragma once

#include "lattice/voxel.h"

namespace stylet {

// Deformation of the tissue around a CP: the displacement gradient, averaged over its supports.
struct Gradient {
  Vec3 c0, c1, c2;  // columns of I + gradient
  float det;
  float edge_m;  // of the voxels there
};

Gradient gradient_around(const Model& model, const State& state, const Particle& p);

// Rest-frame image of a step in deformed tissue.
Vec3 pull_back(const Gradient& g, Vec3 step);

// The same for a long step. A voxel's deformation says nothing about the next voxel: in tissue
// pressed to a fraction of its length (the dimple of a puncture) the image ends within the
// voxel.
Vec3 pull_back_step(const Gradient& g, Vec3 step_m);

}  // namespace stylet
