// SPDX-License-Identifier: Apache-2.0
// The tissue: shape matching on a voxel lattice, one explicit step of the whole organ.
//
// Physics (PHYSICS 2, in words of the paper's section IV): each voxel is a cluster of eight
// particles. With the spring k = G h per corner, a volume term lambda and the hourglass weight chi,
// the force of a cluster on corner i at rest offset q_i is
//     k [ chi (t - u_i) + H q_i ],   H = (1 - p)(R - I) - p I - (1 - chi) D,
//     p = lambda / (2 G) (tr(R^T F) - 3),   F = I + D,
// with u the displacement, t its mean over the corners, D its gradient, R the best rotation. This
// is corotated linear elasticity with the modulus of the material, for every voxel size.
// Damping: clusters are evaluated at e = u + tau v (Kelvin-Voigt, objective); what constraint
// particles change in their voxels is evaluated at u, undamped.
// Step: v += dt f / M, u += dt v, symplectic. M has a lower bound so that any material is stable; v
// is bounded by kMaxEdgesPerSubstep.
//
// Promises: no branch on data, the same operations for every state; the same bits for any lane
// width because no sum is horizontal (a lane is a voxel or a particle). The source is compiled once
// per instruction set; the choice is made at creation.
#pragma once

#include "state/layout.h"

namespace stylet {

// One substep. Compiled from step.h for several instruction sets; all give the same bits.
using LatticeStep = void (*)(const Kernel&);
LatticeStep lattice_step_for_this_processor();

}  // namespace stylet
