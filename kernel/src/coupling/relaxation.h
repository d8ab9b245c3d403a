// SPDX-License-Identifier: Apache-2.0
// Relaxation: the force that a constraint particle (CP) loses with time, and how far its tissue
// yields along the needle. Runs at the start of a tick, with the forces of the last tick.
//
// Promises: bounded by limits.h; energy never rises, and its loss is booked. Units SI.
// Source: Maxwell branch in parallel with a spring (standard linear solid), Fung 1993.
// PHYSICS 11.3, 12.4.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// The CPs creep under the forces of the last tick; then the CPs of the shaft move with the needle.
// The CPs load the tissue together, so one may gain energy if others lose more: the CPs that gain
// are computed last.
void relax_and_follow(const Model& model, State& state, const Needle& needle);

}  // namespace stylet
