// SPDX-License-Identifier: Apache-2.0
#include "coupling/layers.h"

#include "state/events.h"

namespace stylet {

namespace {

// What the log last reported as this needle's layer. Only the log: forces follow the tip's place.
struct LoggedLayer {
  bool known, crossed;          // known: still in the log; crossed: by an event of a layer
  std::uint32_t layer, before;  // and the layer reported before that
  float track_m;
};

bool tells_layer(const Event& e, std::uint32_t needle) {
  return e.needle == needle && (e.kind == EventKind::kLayer || e.kind == EventKind::kPuncture ||
                                e.kind == EventKind::kReentry);
}

LoggedLayer told_layer(const State& state) {
  const std::uint32_t all = state.head->event_count;
  const std::uint32_t kept = all < kMaxEvents ? all : kMaxEvents;
  LoggedLayer told = {};
  for (std::uint32_t i = 1; i <= kept; ++i) {
    const Event& e = state.event[(all - i) % kMaxEvents];
    if (!tells_layer(e, state.needle_index)) continue;
    told.before = e.layer;
    if (told.known) return told;
    told = {true, e.kind == EventKind::kLayer, e.layer, kNoLayer, e.depth_m};
  }
  return told;
}

bool is_near(const LoggedLayer& told, float track_m) {
  const float since = track_m - told.track_m;
  return since < kLayerSkinM && since > -kLayerSkinM;
}

}  // namespace

void tell_layer(State& state, float force_n) {
  const LoggedLayer told = told_layer(state);
  const bool back = told.known && told.crossed && state.needle->layer == told.before &&
                    is_near(told, state.tip->track_m);
  if (!back) add_event(state, EventKind::kLayer, force_n);
}

void tell_layer_late(State& state) {
  const LoggedLayer told = told_layer(state);
  if (!told.known || told.layer == state.needle->layer) return;
  if (!is_near(told, state.tip->track_m)) add_event(state, EventKind::kLayer, 0);
}

void leave_layers(State& state) {
  NeedleState& own = *state.needle;
  if (state.tip->support_count > 0 || own.layer == kNoLayer) return;
  own.layer = kNoLayer;
  tell_layer(state, 0);
}

}  // namespace stylet
