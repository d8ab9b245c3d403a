// SPDX-License-Identifier: Apache-2.0
// Membranes on the tip's way: surfaces of their own, which hold the tip at their place until it
// presses hard enough.
//
// Whatever moves the tip's rest place is searched for membranes first. A hole stays open around its
// place for whatever tip comes; everywhere else the membrane is whole.
//
// Promises: bounded by limits.h, no allocation; nothing at all where the organ has no membranes.
// Units SI; places in the rest frame. PHYSICS 9.7.
#pragma once

#include "organ/membranes.h"
#include "state/layout.h"

namespace stylet {

// The tip's insertion begins at the surface, or at any place in a track.
void start_membranes(const Model& model, State& state, Vec3 rest_direction, bool in_track);

// The membrane that holds the tip; kNoTissue: none.
std::uint32_t holding_membrane(const Model& model, const State& state);

// Which part of a motion of the tip by `way_m` no membrane is in the way of, and what is.
MembraneCrossing free_part(const Model& model, const State& state, Vec3 way_m);

void hold_at(State& state, const MembraneCrossing& met);

// Nothing holds the tip any more. `through`: it has made a hole in what held it.
void let_go(const Model& model, State& state, bool through);

// The tip has come to where it is by a way that was free: the next one is searched from there.
void note_place(const Model& model, State& state);

}  // namespace stylet
