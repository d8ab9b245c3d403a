// SPDX-License-Identifier: Apache-2.0
// Which voxels hold constraint particles in a tick, and which particles each of them holds: in
// scratch, made anew in every tick by coupling/match.
// Promise: plain data. Units SI.
#pragma once

#include <cstdint>

#include "organ/runs.h"
#include "stylet/limits.h"

namespace stylet {

// A voxel coupled to the needle in this tick.
struct CoupledVoxel {
  std::uint32_t slot, row;                                // where it is
  std::uint32_t first_member, last_member, member_count;  // its list
};
// Up to kLanes coupled voxels in the order of plane_order: where they are, and how the constraint
// particles in them change the forces on their corners.
struct MatchGroup {
  struct Side {                       // four corners of each voxel: those at low z, or at high z
    std::uint32_t node[2][kLanes];    // [dy][voxel]: lattice particle at the corner with dx = 0
    float change_n[2][3][kLanes][2];  // [dy][axis][voxel][dx]: change of the force on a corner
  };
  Side side[2];                // low, high
  std::uint32_t count;         // voxels
  std::uint32_t most_members;  // most supports of constraint particles in one of them
  // Of each voxel: its list and its slot.
  std::uint32_t first_member[kLanes], member_count[kLanes];
  std::uint32_t slot[kLanes];
  float cell[3][kLanes];  // centre at rest, in edges from the lattice's origin
  float edge_m[kLanes], inverse_edge_per_m[kLanes];
  float k[kLanes];  // stiffness of a corner
};
static_assert(kMaxCoupledVoxels % kLanes == 0);
struct Member {                     // in a coupled voxel: a particle's support
  std::uint16_t particle, support;  // indices; a needle's last particle is its tip
  std::uint32_t next;               // the next member of the same voxel
};
constexpr std::uint32_t kNeedleParticles = kMaxConstraintParticles + 1;
constexpr std::uint32_t kMaxMembers = kNeedleParticles * kSupportsPerParticle;

}  // namespace stylet
