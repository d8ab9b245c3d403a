// SPDX-License-Identifier: Apache-2.0
// Tracks: the holes that needles have left, each with an entry, a direction at rest and a length.
//
// Promises: bounded by kMaxTracks, no allocation. Units SI, rest frame. Source: paper section IV.C.
// PHYSICS 9.4.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Whether a place of the track lies in tissue. Just behind the entry the surface decides, because
// the planes of mixed voxels do not lie exactly on it.
bool holds_track(const Model& model, Vec3 rest_m, float track_m);

// Width and depth of the mouth of a hole, around its entry.
float mouth_m(const Model& model);

// Adds a track; without room the oldest one is forgotten. Returns its index.
std::uint32_t remember_track(State& state, Vec3 rest_m, Vec3 rest_direction);

// The track that a needle enters if its first CP would be `entry`; kNoTrack if there is none.
std::uint32_t track_of(const Model& model, const State& state, const Needle& needle,
                       const Particle& entry);

}  // namespace stylet
