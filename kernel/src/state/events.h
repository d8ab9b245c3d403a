// SPDX-License-Identifier: Apache-2.0
// The event log: a ring of the last kMaxEvents, in the state.
#pragma once

#include "state/layout.h"

namespace stylet {

// Logs an event in the material that the tip has entered last, or in material `layer`.
void add_event(State& state, EventKind kind, float force_n);
void add_event(State& state, EventKind kind, float force_n, std::uint32_t layer);

}  // namespace stylet
