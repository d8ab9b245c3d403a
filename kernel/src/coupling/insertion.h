// SPDX-License-Identifier: Apache-2.0
// The transitions contact -> inserted -> out: a track begins, is entered again, and ends.
//
// Promises: a fixed number of operations, no allocation. Units SI. Source: paper section IV.B,
// IV.C. PHYSICS 9.1, 9.5.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Contact -> inserted: the entry becomes the first shaft CP, and the tip starts to cut.
void begin_insertion(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                     std::uint32_t track, float force_n);

// For tissue that has moved over a tip which had left its hole, or was never clear of it: the tip
// is in the hole again, at its present depth and without force, and friction holds the shaft.
void take_in(const Model& model, State& state, Scratch& scratch, const Needle& needle,
             std::uint32_t track, const Particle& entry);

void end_insertion(State& state);

}  // namespace stylet
