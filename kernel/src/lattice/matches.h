// SPDX-License-Identifier: Apache-2.0
// Matches of voxels that hold constraint particles (CPs), each a match of the voxel's corners
// together with its CPs. The functions here load the input of these matches from memory into the
// step's registers, and store their results. Lists in the scratch name the voxels and supports
// (coupling/match.h makes them once a tick); the lattice only follows the lists.
//
// Promises: bounded by limits.h, no allocation, a fixed order of sums: needles, their CPs, their
// supports. Compiled once, for all instruction sets. Units SI, frame of the attachments. Source:
// paper section IV; PHYSICS 10.
#pragma once

#include "state/layout.h"

namespace stylet {

// Matches of up to kLanes voxels that hold constraint particles, one voxel per lane. The step makes
// them with its own registers (match_lanes.h), before the sweep; what is here reads their input
// from memory and stores their results.
struct Matches {
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

  std::uint32_t next_member[kLanes];
  alignas(64) float corner_m[3][8][kLanes];  // displacements: two nodes of each row
  alignas(64) float whole[kLanes];           // stiffness of the whole match
  alignas(64) float centre_m[3][kLanes];     // of the corners, then of the match
  alignas(64) float sum[kSums][kLanes];
  alignas(64) float corner[9][kLanes];       // matrix of the corners alone, row-major
  alignas(64) float joint[9][kLanes];        // of corners and constraint particles together
  alignas(64) float corner_turn[4][kLanes];  // rotations of the two matrices: w, x, y, z
  alignas(64) float joint_turn[4][kLanes];
  alignas(64) float rotation[9][kLanes];  // rotation of the match, row-major
};
// One constraint particle's support in each of those voxels.
struct MatchMembers {
  alignas(64) float weight_n_per_m[kLanes];  // 0: no such support
  alignas(64) float place_m[3][kLanes];      // of its spring's end
  alignas(64) float offset_m[3][kLanes];     // at rest
};

// Loads where a group's corners are, and their rotations of the last substep.
void begin_matches(const State& state, const Scratch& scratch, const MatchGroup& group,
                   Matches& matches_out);
// Pulls the constraint particles' springs as far as the needles have come in this substep: in equal
// steps, by `stretch` (layout.h). Pulled all at once they would press on tissue that cannot yield
// yet, and the hand would not feel the work of that in the force at the end of the tick.
void place_members(const Model& model, const State& state, Scratch& scratch);
// Takes constraint particle `n` of each voxel, the next one.
void take_members(const State& state, const Scratch& scratch, const MatchGroup& group,
                  std::uint32_t n, Matches& matches, MatchMembers& members_out);
// Stores where the matches put their constraint particles; only needed in the last substep.
void give_goals(State& state, const Scratch& scratch, const MatchGroup& group,
                const Matches& matches);
// Adds what the matches change to the forces on a plane of particles: x, y, z,
// `particles_per_plane` apart. This has its own place, after all that clusters send: so the sum is
// the same for sweeps from either side.
void add_changes(const Model& model, Scratch& scratch, std::uint32_t plane, float* force);

}  // namespace stylet
