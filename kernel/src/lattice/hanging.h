// SPDX-License-Identifier: Apache-2.0
// Nodes that hang on coarser voxels: what joins the levels of a graded lattice.
//
// A hanging node stays on the surface of the coarser voxel: u = sum of w u over its masters, which
// are the voxel's corners around the node. So neighbouring levels fit together without a gap, and a
// linear displacement is linear across them. By virtual work the node's forces go to its masters
// with the same weights, and so does its mass: momentum, moment of momentum and energy are kept. A
// master may itself hang on a coarser level. So nodes give what they got from fine levels to coarse
// ones, and then follow their masters from coarse levels to fine ones; the list has the nodes of
// coarse levels first.
//
// A hanging node has a mobility (step over mass) like every particle, so the sweep treats it like a
// particle; its momentum is then passed on to its masters, scaled by the mobilities. The value of a
// hanging node's mobility changes only the rounding. It is so small that the node's momentum is not
// bounded (kMaxEdgesPerSubstep): one side of a face between levels alone pulls hard.
//
// Promises: no allocation; a fixed number of operations in a fixed order. PHYSICS 2.9.
#pragma once

#include "state/layout.h"

namespace stylet {

// At creation. Nodes, masters and weights; needs rows and ties.
void count_hanging(const Organ& organ, Counts& counts_io);
void fill_hanging(const Organ& organ, Model& model);
// Adds what belongs to hanging nodes (mass, bounds on stiffness) to that of their masters.
void add_to_masters(const Model& model, float* of_particles);
// The level of a particle; particles of a finer one have larger numbers.
std::uint32_t level_of_particle(const Model& model, std::uint32_t particle);
// The entry of a particle that hangs, or null.
const HangingNode* hanging_at(const Model& model, std::uint32_t particle);
inline bool hangs(const Model& model, std::uint32_t particle) {
  return hanging_at(model, particle) != nullptr;
}
// Until shares are counted, HangingShare::count holds the level. order_shares sorts by level, then
// by the node that gets, then by the node that gives. count_shares then sets `count` in the first
// share of each node that gets, to the number of its shares.
void order_shares(HangingShare* first, HangingShare* end, bool finest_first);
void count_shares(HangingShare* first, const HangingShare* end);
// The nodes' mobilities and shares; needs the masters' mobilities, with 0 where they are attached,
// and the nodes' bounds. Afterwards nodes have no mass.
void fill_shares(Model& model);

// In a step. Nodes give their momentum over mass to their masters; then it is 0 at the nodes, and
// at their masters no larger than `most`, as at every particle.
void give_momentum(const Model& model, State& state, float most);
// Nodes get the values that follow from their masters': x, y, z, `axis` apart.
void follow(const Model& model, float* values, std::ptrdiff_t axis);

}  // namespace stylet
