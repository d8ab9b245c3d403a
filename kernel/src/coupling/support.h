// SPDX-License-Identifier: Apache-2.0
// Support of a constraint particle (CP): which voxels hold it, with which weights and goals.
//
// A CP is a material point of the tissue held by the needle (paper section IV.A). The eight voxels
// whose centres surround it support it. For a tip inside, weights change smoothly along its path,
// so that running along a voxel face, or crossing one, is not felt. A shaft CP keeps its voxels,
// with even weights. Two layers hold a tip in contact, each according to its stiffness. In paper
// mode one voxel holds a CP. A new voxel gets the residual that the CP has, so a change of support
// changes no force.
//
// Promises: bounded by kSupportsPerParticle, no allocation, fixed order. Units SI, frame of the
// attachments. PHYSICS 10.1.
#pragma once

#include "coupling/stiffness.h"
#include "lattice/voxel.h"
#include "needle/shape.h"

namespace stylet {

// Takes the voxels around the CP's rest place. A voxel that is kept keeps its offset; a new one
// gets the residual that the CP has. The force does not change, and the energy does not rise.
void renew_supports(const Model& model, const State& state, Particle& p,
                    Weighting weighting = Weighting::kTent);

// Where the goal of a support lies in unloaded tissue; below, that of a CP: their mean.
Vec3 unloaded_place(const Model& model, const Support& support);
Vec3 unloaded_place(const Model& model, const Particle& p);

// Puts a CP at a rest place with its goals at `place_m` (rigid pull-back: if the needle holds it
// there, matches, goals and energy of all voxels do not change).
Particle new_particle(const Model& model, State& state, const Needle& needle, Vec3 rest_m,
                      Vec3 place_m, float track_m, float arc_m, Role role);

// A CP for whose voxels there was no room (keep_supports) takes the voxels around it again: there
// may be room now.
void refill_supports(const Model& model, State& state, Particle& p);

// A shaft CP whose rest place has moved takes the voxels around that place, at the same force;
// outside of all voxels it holds nothing.
void take_other_voxels(const Model& model, State& state, Particle& p);

// Leaves a shaft CP only the supports whose bits are set in `kept`, because there is no room for
// the others; they take over the weight of the others, at the same force. A CP without supports has
// no force. refill_supports restores supports when there is room again.
void keep_supports(StateHead& state, Particle& p, std::uint32_t kept);

}  // namespace stylet
