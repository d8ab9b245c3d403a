// SPDX-License-Identifier: Apache-2.0
// Parts of the organ that lie on each other without being joined: they press, slide with friction
// and separate. Points of one part's surface meet the other part, their ground, which knows how
// deep each place of it lies below its own surface. PHYSICS 2.8.
//
// A point at a depth below the ground's surface has the energy k depth^2 / 2. The depth is that, in
// the ground at rest, of the material that lies at the point now. The forces are the slopes of that
// energy, with the ground's gradient of the substep before. They are equal and opposite, so
// momentum is kept exactly; its moment and the energy are kept with an error that grows with the
// substep.
// Friction is a spring along the surface that slips at its limit.
//
// Promises: no allocation; a fixed number of operations for each point; the same bits for any
// number of threads. Units SI, frame of the attachments.
#pragma once

#include "state/layout.h"

namespace stylet {

// At creation: counts; the model's points and grounds; and room for the stiffness of contact, which
// is added to the bounds on particles (`bound_io`, N/m). The last needs the bounds of the tissue.
void count_slides(const Organ& organ, Counts& counts_io);
void fill_slides(const Organ& organ, Model& model);
void add_slide_room(Model& model, float* bound_io);

// Every point at rest.
void reset_slides(const Model& model, State& state);

// Once a substep, before the tissue's step: the forces of contact, in scratch.slide_force.
void press_slides(const Model& model, State& state, Scratch& scratch);

// Energy of the contacts now, J (cold path).
double slides_energy(const Model& model, const State& state);

}  // namespace stylet
