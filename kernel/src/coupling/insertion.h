// SPDX-License-Identifier: Apache-2.0
// Contact -> inserted -> out: a track begins, is entered again, and ends.
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

// Tissue has come over a tip that had left its hole or was never clear of it. The tip lies in the
// hole again, as deep as it is now and without force; the friction there holds the shaft.
void take_in(const Model& model, State& state, Scratch& scratch, const Needle& needle,
             std::uint32_t track, const Particle& entry);

void end_insertion(State& state);

}  // namespace stylet
