// SPDX-License-Identifier: Apache-2.0
// Layers as the event log tells them: a tip that trembles at a face is told once.
//
// Promises: bounded by kMaxEvents, no allocation; changes the log and nothing that is felt.
// PHYSICS 9.2.
#pragma once

#include "state/layout.h"

namespace stylet {

// The tip must go this far to come back to the layer it has just left, or for the log to tell it.
constexpr float kLayerSkinM = 5e-4F;

// The needle's layer has changed, at this force: told, unless it only comes back to the layer told
// before the last one, near where it left that.
void tell_layer(State& state, float force_n);

// What was not told there is told from here, where it has stayed.
void tell_layer_late(State& state);

// Outside the tissue there is no layer.
void leave_layers(State& state);

}  // namespace stylet
