// SPDX-License-Identifier: Apache-2.0
// The ground of parts that slide: its voxels, and in which of them a place lies. Voxels of one body
// may be of several levels (PHYSICS 2.9): a place is in edges of its voxel's level, and is the same
// place of the tissue at rest after it has gone to another voxel.
//
// Promises: no allocation; so many operations for a place as there are levels, each with one search
// by halving. Units SI; places in edges from a voxel's low corner.
#pragma once

#include "state/layout.h"

namespace stylet {

// At creation. Needs rows and slots.
void fill_grounds(const Organ& organ, Model& model);
// Where a ground of the organ file is among the model's.
std::uint32_t ground_of(const Organ& organ, const Model& model, std::uint32_t in_file);

inline float edge_m_of(const Model& model, const SlideGround& ground) {
  return model.head->level[ground.level].edge_m;
}

// The particle at a corner (bits x, y, z) of a voxel.
inline std::uint32_t corner_node(const Row& row, std::uint32_t slot, std::uint32_t corner) {
  return row.node[corner >> 1U] + (slot - row.slot) + (corner & 1U);
}

// Each component between two bounds.
Vec3 within(Vec3 place, float low, float high);

// Brings a place back into a voxel of its ground's body: to the next one along each axis, else to
// the one of any level in which it lies, which may be of another piece. Without any it stays with
// the last one, whose map goes on.
void enter_ground(const Model& model, std::uint32_t& ground_io, Vec3& place_io);

}  // namespace stylet
