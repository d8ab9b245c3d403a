// SPDX-License-Identifier: Apache-2.0
#include "state/events.h"

namespace stylet {

void add_event(State& state, EventKind kind, float force_n) {
  NeedleState& own = *state.needle;
  const float depth = own.tip_alive != 0 ? state.tip->track_m : 0;
  state.event[state.head->event_count % kMaxEvents] = {
      state.head->tick, kind, own.layer, depth, force_n, state.needle_index, 0};
  ++state.head->event_count;
}

}  // namespace stylet
