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
// Step: v += dt f / M, u += dt v, symplectic; M bounded below so that any material is stable, v
// bounded by kMaxEdgesPerSubstep.
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

// Fits of up to kLanes voxels that hold constraint particles, a voxel in each lane. The step makes
// them with its own registers (fit_lanes.h), for each voxel plane, after the clusters and before
// the particles; what they take from memory and leave there is fit.cpp's.
struct Fits {
  // Sums over a voxel's constraint particles: weight; then, weighted, places from the mean of the
  // corners, rest offsets, products of place and offset, squares of the offset.
  enum Sum : std::uint32_t {
    kWeight,
    kPlace,
    kOffset = 4,
    kProduct = 7,
    kOffsetSquare = 16,
    kSums
  };

  std::uint32_t count;          // voxels
  std::uint32_t most_members;   // constraint particles' shares in one of them
  std::uint32_t voxel[kLanes];  // of ScratchView::coupled
  std::uint32_t next_member[kLanes], member_count[kLanes];
  alignas(64) float corner_m[3][8][kLanes];  // displacements: two nodes of each row
  alignas(64) float cell[3][kLanes];         // centre at rest, in edges from the lattice's origin
  alignas(64) float k[kLanes];               // stiffness of a corner
  alignas(64) float whole[kLanes];           // and of the whole fit
  alignas(64) float centre_m[3][kLanes];     // of the corners, then of the fit
  alignas(64) float sum[kSums][kLanes];
  alignas(64) float corner[9][kLanes];       // matrices of the corners alone and together with the
  alignas(64) float joint[9][kLanes];        // constraint particles, row-major
  alignas(64) float corner_turn[4][kLanes];  // their rotations w, x, y, z
  alignas(64) float joint_turn[4][kLanes];
  alignas(64) float rotation[9][kLanes];  // of the fit, row-major
  alignas(64) float change[12][kLanes];   // of what the clusters send
};
// A constraint particle's share in each of those voxels.
struct FitMembers {
  alignas(64) float weight_n_per_m[kLanes];  // 0: no such share
  alignas(64) float place_m[3][kLanes];      // of its spring's end
  alignas(64) float offset_m[3][kLanes];     // at rest
};

// From the `first` entry of plane_order on: voxels, corners, and the rotations the step has just
// made.
void begin_fits(const View& view, std::uint32_t first, std::uint32_t count, Fits& fits_out);
// Of each voxel its constraint particle `n`, the next one.
void take_members(const View& view, std::uint32_t n, Fits& fits, FitMembers& members_out);
// Where the fits put their constraint particles; nobody asks before the last substep.
void give_goals(const View& view, const Fits& fits);
// Adds the changes to what the clusters of the plane send.
void end_fits(const View& view, const Plane& plane, const Fits& fits);

}  // namespace stylet
