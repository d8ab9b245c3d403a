// SPDX-License-Identifier: Apache-2.0
// Support of a constraint particle (CP): which voxels hold it, with which weights and goals.
//
// A CP is a material point of the tissue held by the needle (paper section IV.A). It is shared by
// the eight voxels whose centres surround it. Those of a tip inside have weights that change
// smoothly along its way, so that a tip running along a voxel face, or crossing one, is not felt;
// those of a shaft CP, which keeps its voxels, are even; a tip in contact is held by two layers,
// each as it is stiff. In paper mode a CP belongs to one voxel. New voxels are given the residual
// the CP has, so a change of support changes no force.
//
// Promises: bounded by kSupportsPerParticle, no allocation, fixed order. Units SI, frame of the
// attachments. PHYSICS 10.1.
#pragma once

#include "coupling/stiffness.h"
#include "lattice/voxel.h"
#include "needle/shape.h"

namespace stylet {

// Takes the voxels around the CP's rest place. A voxel that is kept keeps its offset; a new one is
// given the residual the CP has. The force does not change, and the energy does not rise.
void renew_supports(const Model& model, const State& state, Particle& p,
                    Weighting weighting = Weighting::kTent);

// Where the goal of a support lies in unloaded tissue; that of a CP, the mean of them.
Vec3 unloaded_place(const Model& model, const Support& support);
Vec3 unloaded_place(const Model& model, const Particle& p);

// Puts a CP at a rest place with its goals at `place_m` (rigid pull-back: matches, goals and energy
// of all voxels stay as they are when the needle holds it there).
Particle new_particle(const Model& model, State& state, const Needle& needle, Vec3 rest_m,
                      Vec3 place_m, float track_m, float arc_m, Role role);

// A CP whose voxels found no room (keep_supports) takes those around it again: next time there may
// be.
void refill_supports(const Model& model, State& state, Particle& p);

// Leaves a shaft CP only those supports whose bits `kept` names, for there is no room for the
// others: their weight goes to these, at the same force. With none left it holds nothing, and
// nothing holds it. refill_supports gives them back where there is room again.
void keep_supports(StateHead& state, Particle& p, std::uint32_t kept);

}  // namespace stylet
