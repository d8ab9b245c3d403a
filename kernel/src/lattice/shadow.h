// SPDX-License-Identifier: Apache-2.0
// True mass on a graded lattice: a cascade of levels in place of many passes of the filter.
//
// The finer a voxel, the faster its short waves: passes that slow the waves of the finest level
// would have to go through all levels, many times. Here each level slows its own waves. Where there
// are finer voxels, each level has shadows: nodes and cells that are not tissue, so that a motion
// that is long for the fine voxels is a motion of the coarse cells. With P_l the interpolation of
// nodes of
// level l to those of the finest, D_l mobilities (velocity over momentum) and f a momentum, the
// velocity is
//     v = P_0 psi(D_0 L_0) D_0 P_0^T f  +  sum over l > 0 of  P_l D_l P_l^T f :
// momentum goes down to the coarsest level, which is filtered as a lattice of one level (filter.h),
// and velocities come up again. A finer level adds a small motion of its own, slow enough for the
// step. Every term is symmetric and positive, so v . f / 2 is a kinetic energy; total momentum is
// that of f, exactly. A constant velocity stays what it is: at a shadow of level 0 the mobility is
// less by what finer levels add.
//
// Stability: the largest eigenvalue of a sum is at most the sum of the terms' largest eigenvalues.
// Level 0 gets most of the step's limit, the other levels share the rest. A cell's bound b
// (filter.h), as a form of the corners of the coarser cell that holds it, is at most half of the
// form of these corners with the bound 2 b: eight children with the same b give exactly that, and
// a child that is missing or softer gives less. Where a cell's corners do not follow from the
// corners of the coarser cell (attached and tied nodes), its bound goes to the coarser nodes by
// their weights.
//
// Promises: no allocation; a fixed number of operations in a fixed order, the same on every
// instruction set. PHYSICS 3.5.
#pragma once

#include "state/layout.h"

namespace stylet {

// x, y and z of a node, and one more number.
typedef float Four __attribute__((vector_size(16)));

// At creation. `fine`: particles of the levels above 0.
void count_shadows(const Organ& organ, std::uint64_t fine, Counts& counts_io);
// On entry step_per_mass has the bounds on stiffness with what hangs. No level but the coarsest
// needs more than its real mass: afterwards step_per_mass has the bounds of the coarsest voxels
// alone. Returns whether some motion is faster than the step can follow; else nothing changes, and
// there is no cascade.
bool bound_coarse(Model& model, float limit_per_s2);
// Needs masses, with those that are attached. `limit`: of the step (filter.h).
void fill_shadows(const Organ& organ, Model& model, float limit_per_s2);
// The part of the limit that level 0 gets in a lattice of so many levels.
float coarse_limit_per_s2(float limit_per_s2, std::uint32_t levels);

// What the cascade keeps in a step: for all nodes, their momenta and then their velocities; for the
// border and the shadows of level 0, their mobilities (1/kg; times stiffness, 1/s^2), what the
// passes start from, three iterates, and what cells give in a pass.
struct CascadeVectors {
  Four *all, *mobility, *start, *iterate[3], *got;

  const Four* of_pass(std::uint32_t j) const { return j > 1 ? iterate[j % 3] : start; }
};
std::uint64_t shadow_floats(const Counts& counts);
CascadeVectors cascade_vectors(const Model& model, float* memory);

// In a step. Momenta go down to level 0.
void give_down(const Model& model, const State& state, const Scratch& scratch, Four* all);
// In tiles of the planes of level 0: start values and bounds of the border, and of the shadows.
void start_shadows(const Model& model, CascadeVectors& vectors, float* starts, float* bounds);
// Pass j, after that of the planes, whose next iterates are `next`.
void pass_shadows(const Model& model, CascadeVectors& vectors, std::uint32_t j, float* next);
// The last iterates come up.
void give_up(const Model& model, CascadeVectors& vectors);
// Velocities of a plane of finer levels: x, y, z, `axis` apart, in the order of particles.
void pack_fine(const Model& model, const Plane& plane, const Four* all, float* to,
               std::ptrdiff_t axis);

}  // namespace stylet
