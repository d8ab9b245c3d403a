// SPDX-License-Identifier: Apache-2.0
// The matches of voxels that hold constraint particles (CPs): corners and CPs together, exactly.
// The paper's ghost particles are eliminated in closed form (they sit on their goals and drop
// out).
//
// The lattice sweep matches the corners alone. The matches of lattice/matches.h add what the CPs of
// a voxel change in it, and give the CPs their goals.
//
// Promises: bounded by limits.h, no allocation, a fixed order of sums: needles, their CPs, their
// supports. Units SI, frame of the attachments. Source: paper section IV; PHYSICS 10.
#pragma once

#include "base/math.h"
#include "state/layout.h"

namespace stylet {

// Where the last match put a voxel, together with its CPs if it has any. (A CP that joins others in
// a voxel must be placed by this match. Placed by that of the corners alone, it would be moved by
// the next match, which the hand would feel.)
struct MatchFrame {
  Quat turn;
  Vec3 centre_m;
};
MatchFrame match_frame(const Model& model, const State& state, std::uint32_t slot,
                       std::uint32_t row);

// Lists the coupled voxels of this tick, plane by plane; with true mass it also adds their springs
// to the bounds on stiffness. Returns output flags.
std::uint32_t gather_coupled(const Model& model, State& state, Scratch& scratch);

// Computes the forces of all CPs from the goals of the last match, and books the energy that their
// slips have lost.
void measure_forces(const Model& model, State& state);

// Copies a CP (its number: needle, then place in the shaft, the tip last) with goals computed for
// the present tissue, because those of the last match are a substep old. Returns the energy of the
// corners of its voxels beyond that of their own match, for each voxel only with its first CP. Cold
// path: reads all CPs.
double rematch(const Model& model, const State& state, std::uint32_t index, Particle& particle_out);

}  // namespace stylet
