// SPDX-License-Identifier: Apache-2.0
// Membranes on the path of the tip: surfaces that hold the tip where they lie until it presses hard
// enough.
//
// Every motion of the tip's rest place is first searched for membranes. A hole stays open around
// its place, for any tip; everywhere else the membrane is whole.
//
// Promises: bounded by limits.h, no allocation; nothing at all where the organ has no membranes.
// Units SI; places in the rest frame. PHYSICS 9.7.
#pragma once

#include "organ/membranes.h"
#include "state/layout.h"

namespace stylet {

// Call when an insertion begins, at the surface or at any place in a track.
void start_membranes(const Model& model, State& state, Vec3 rest_direction, bool in_track);

// The membrane that holds the tip; kNoTissue: none.
std::uint32_t holding_membrane(const Model& model, const State& state);

// The part of a motion of the tip by `way_m` that is free of membranes, and the membrane that ends
// it.
MembraneCrossing free_part(const Model& model, const State& state, Vec3 way_m);

void hold_at(State& state, const MembraneCrossing& met);

// Call when nothing holds the tip any more. `through`: it has made a hole in the membrane that held
// it.
void let_go(const Model& model, State& state, bool through);

// Call when the tip has reached its place on a free path: the next search begins there.
void note_place(const Model& model, State& state);

}  // namespace stylet
