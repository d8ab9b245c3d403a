// SPDX-License-Identifier: Apache-2.0
// Membranes on the tip's way: surfaces of their own, which hold the tip at their place until it
// presses hard enough.
//
// The tip's way in the rest frame is searched before it moves on. What it has gone through in its
// track stays open, also when it comes again.
//
// Promises: bounded by limits.h, no allocation; nothing at all where the organ has no membranes.
// Units SI; places in the rest frame. PHYSICS 9.7.
#pragma once

#include "organ/membranes.h"
#include "state/layout.h"

namespace stylet {

// The tip's insertion begins at the surface, or in a track that is there already.
void start_membranes(const Model& model, State& state, Vec3 rest_direction, bool again);

// The membrane that holds the tip; kNoTissue: none.
std::uint32_t holding_membrane(const Model& model, const State& state);

// Which part of a motion of the tip by `way_m` no membrane is in the way of, and what then holds
// it (MembraneCrossing).
MembraneCrossing free_part(const Model& model, const State& state, Vec3 way_m);

// The tip has been free to move by `way_m`, or a membrane holds it.
void note_free(const Model& model, State& state, Vec3 way_m);
void hold_at(const Model& model, State& state, std::uint32_t material);

// The tip is where it is, and nothing holds it: it moved back, or it is outside the tissue.
void let_go(const Model& model, State& state);

// The tip goes through what holds it, in this direction.
void go_through(const Model& model, State& state, Vec3 rest_direction);

}  // namespace stylet
