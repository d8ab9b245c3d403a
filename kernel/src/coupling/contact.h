// SPDX-License-Identifier: Apache-2.0
// Begins a contact, and decides whether it goes on, ends, or becomes a puncture.
//
// Promises: bounded by limits.h, no allocation, fixed order. Units SI, frame of the attachments.
// Source: paper section IV.B. PHYSICS 7.2, 7.3.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Starts contact: the tip holds the surface point `rest_m` (rest frame), now at `place_m`. Only the
// `advance_m` that the tip moved forward in this tick are pressed in. If the tip lies deeper (it
// slid in over an edge, or the tissue came to it), it holds the tissue there without force, because
// no work was done to press it in. If it lies deep behind the entry of a track, it is in that track
// again. If it has just left its track, it does not touch the tissue that it lies in.
void begin_contact(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                   Vec3 rest_m, Vec3 place_m, float advance_m);

// The contact goes on, ends, or becomes a puncture.
void update_contact(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                    Vec3 step_m, std::uint32_t& flags_out);

// Call after a bend that has moved the tip by `moved_m`. If the bend throws a tip in contact aside,
// farther than it was off when the tissue's step began, the tip takes hold of the tissue where it
// is, without force. Over such a distance the old tangent is wrong: with it the needle would drag
// tissue along for almost no work.
void throw_aside(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                 Vec3 moved_m);

// Call after a bend before the step of the tissue that has moved the tip by `moved_m`: the substeps
// stretch the tip's spring by this, too.
void stretch_tip(const State& state, Scratch& scratch, Vec3 moved_m);

}  // namespace stylet
