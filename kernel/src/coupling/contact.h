// SPDX-License-Identifier: Apache-2.0
// Free -> contact, and how a contact goes on: it holds, ends, or becomes a puncture.
//
// Promises: bounded by limits.h, no allocation, fixed order. Units SI, frame of the attachments.
// Source: paper section IV.B. PHYSICS 7.2, 7.3.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Starts contact: the tip holds the surface point `rest_m` (rest frame), now at `place_m`. Only the
// `came_m` the tip moved forward this tick are pressed in: where it lies deeper (it has slid in
// over an edge, or the tissue has come to it) it holds the tissue it lies in, without force, for
// nobody has spent the work to press it there. One that lies deep behind the entry of a track is in
// that track again. One that has just left its track does not touch what it lies in there.
void begin_contact(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                   Vec3 rest_m, Vec3 place_m, float came_m);

// Contact holds, ends, or becomes a puncture.
void update_contact(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                    Vec3 step_m, std::uint32_t& flags_out);

// After a bend that has moved the tip by `moved_m`. A tip in contact that is thrown aside by it,
// farther than it was off when the tissue's step began, holds the tissue it lies in now, without
// force: the tangent it was held by says nothing of so long a way, and would let the needle drag
// tissue along for next to no work.
void throw_aside(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                 Vec3 moved_m);

// A bend before the tissue's step has moved the tip by so much, which its spring feels substep by
// substep, too.
void stretch_tip(const State& state, Scratch& scratch, Vec3 moved_m);

}  // namespace stylet
