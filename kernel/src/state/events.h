// SPDX-License-Identifier: Apache-2.0
// The event log: a ring of the last kMaxEvents, in the state.
#pragma once

#include "state/layout.h"

namespace stylet {

void add_event(State& state, EventKind kind, float force_n);

}  // namespace stylet
