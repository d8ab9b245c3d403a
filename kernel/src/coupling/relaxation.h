// SPDX-License-Identifier: Apache-2.0
// Relaxation: what a constraint particle's (CP's) force loses with time, and how its tissue gives
// way along the needle. Runs at the start of a tick, at the forces of the last one.
//
// Promises: bounded by limits.h; energy never rises, and what falls is booked. Units SI.
// Source: Maxwell branch in parallel with a spring (standard linear solid), Fung 1993.
// PHYSICS 11.3, 12.4.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// The CPs creep at the last tick's forces; then those of the shaft go with the needle. As they load
// the tissue together, one may gain energy where others lose more: those come last.
void relax_and_follow(const Model& model, State& state, const Needle& needle);

}  // namespace stylet
