// SPDX-License-Identifier: Apache-2.0
// Tracks: the holes that needles have left, each an entry and a direction at rest and a length.
//
// Promises: bounded by kMaxTracks, no allocation. Units SI, rest frame. Source: paper section IV.C.
// PHYSICS 9.4.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Whether a place of the track lies in tissue. Just behind the entry the surface has the word: the
// planes of mixed voxels lie a little beside it.
bool holds_track(const Model& model, Vec3 rest_m, float track_m);

// How wide and how deep the mouth of a hole is, about its entry.
float mouth_m(const Model& model);

// A new track; the oldest one is forgotten where there is no room. Returns its index.
std::uint32_t remember_track(State& state, Vec3 rest_m, Vec3 rest_direction);

// The track that a needle enters whose first CP would be `entry`; kNoTrack: none is there.
std::uint32_t track_of(const Model& model, const State& state, const Needle& needle,
                       const Particle& entry);

}  // namespace stylet
