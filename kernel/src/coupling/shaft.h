// SPDX-License-Identifier: Apache-2.0
// The shaft's constraint particles (CPs): a stack ordered along the track, one per needle unit.
// They are added behind a tip that goes on and removed as it comes back.
//
// Promises: bounded by kMaxConstraintParticles and kMaxDropsPerTick, no allocation. Units SI.
// Source: paper section IV.C, step 4. PHYSICS 10.4.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Adds a CP on top of the stack; kFlagCpPoolFull if there is no room.
std::uint32_t push_shaft(const Model& model, State& state, Scratch& scratch, Particle p);

// One shaft CP for each unit of track that the tip has left behind, except in gaps between organs.
// A track is as long as the tissue at rest. So near the tip it counts as straight, and the needle
// holds the points on it. If tissue that the tip pushes ahead ends before such a point, the needle
// holds the tissue that the tip has passed.
std::uint32_t drop_shaft(const Model& model, State& state, Scratch& scratch, const Needle& needle);

// Whether the tip has come back past a shaft CP: along the track or, when a violent hand has made
// the track unreliable, by the needle's own length.
bool is_behind(const Model& model, const State& state, const Particle& p);

}  // namespace stylet
