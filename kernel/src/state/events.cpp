// SPDX-License-Identifier: Apache-2.0
#include "state/events.h"

namespace stylet {

void add_event(const View& view, EventKind kind, float force_n) {
  StateHead& state = *view.state.head;
  NeedleState& own = *view.state.needle;
  const float depth = own.tip_alive != 0 ? view.state.tip->track_m : 0;
  view.state.event[state.event_count % kMaxEvents] = {state.tick, kind,        own.layer, depth,
                                                      force_n,    view.needle, 0};
  ++state.event_count;
}

}  // namespace stylet
