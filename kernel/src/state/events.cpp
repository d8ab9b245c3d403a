// SPDX-License-Identifier: Apache-2.0
#include "state/events.h"

namespace stylet {

void add_event(State& state, EventKind kind, float force_n) {
  add_event(state, kind, force_n, state.needle->layer);
}

void add_event(State& state, EventKind kind, float force_n, std::uint32_t layer) {
  const float depth = state.needle->tip_alive != 0 ? state.tip->track_m : 0;
  state.event[state.head->event_count % kMaxEvents] = {
      state.head->tick, kind, layer, depth, force_n, state.needle_index, 0};
  ++state.head->event_count;
}

}  // namespace stylet
