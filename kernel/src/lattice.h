// SPDX-License-Identifier: Apache-2.0
// The tissue: shape matching on a voxel lattice, one explicit step of the whole organ.
//
// Physics (model.md section 2 in words of the paper's section IV): each voxel is a cluster of eight
// particles; with spring k = G h per corner, a volume term lambda and the hourglass weight chi, the
// force of a cluster on corner i at rest offset q_i is
//     k [ chi (t - u_i) + H q_i ],   H = (1 - p)(R - I) - p I - (1 - chi) D,
//     p = lambda / (2 G) (tr(R^T F) - 3),   F = I + D,
// u the displacement, t its mean over the corners, D its gradient, R the best rotation. That is
// corotated linear elasticity with the modulus the material states, for every voxel size.
// Damping: clusters are evaluated at e = u + tau v (Kelvin-Voigt, objective).
// Step: v += dt f / M, u += dt v, symplectic; M bounded below so that any material is stable.
//
// Promises: no branch on data, same operations for every state; same bits for any lane width
// because no sum is horizontal (a lane is a voxel or a particle). The source is compiled once per
// instruction set; the choice is made at creation.
#pragma once

#include "layout.h"

namespace stylet {

// One substep. Compiled from lattice.cpp for several instruction sets; all give the same bits.
using LatticeStep = void (*)(const Kernel&);
LatticeStep lattice_step_for_this_processor();

// Fits of up to kLanes voxels that hold constraint particles (fit.cpp). The step makes them for
// each voxel plane, after the clusters and before the particles, and turns them itself, all lanes
// at once: rotations are most of their work.
struct Fits {
  std::uint32_t count;
  alignas(64) float corner[9][kLanes];  // matrices of the corners alone and together with the
  alignas(64) float joint[9][kLanes];   // constraint particles, row-major, a voxel in each lane
  alignas(64) float corner_turn[4][kLanes];  // their rotations w, x, y, z; at first that of the
                                             // corners'
  alignas(64) float joint_turn[4][kLanes];   // last fit, and nothing
  struct Voxel {
    std::uint32_t index;  // of ScratchView::coupled
    float k, whole;       // stiffness of a corner, and of the whole fit
    Vec3 centre_m, place, offset;
  } voxel[kLanes];
};
// The next fits of a voxel plane from the `first` on (plane_first .. plane_first + 1).
void prepare_fits(const View& view, std::uint32_t plane, std::uint32_t first, Fits& fits_out);
// Goals of the constraint particles, and what they change for the corners.
void finish_fits(const View& view, std::uint32_t plane, const Fits& fits);

}  // namespace stylet
