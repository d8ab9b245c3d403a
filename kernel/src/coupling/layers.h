// SPDX-License-Identifier: Apache-2.0
// Reports to the event log which layer the tip is in. A tip that moves back and forth at the
// boundary of two layers is reported once.
//
// Promises: bounded by kMaxEvents, no allocation; changes the log and nothing that is felt.
// PHYSICS 9.2.
#pragma once

#include "state/layout.h"

namespace stylet {

// The tip must go this far to return to the layer it has just left, and for the log to report it.
constexpr float kLayerSkinM = 5e-4F;

// Call when the needle's layer has changed, at this force. The change is reported, unless the
// needle only returns to the layer reported before the last one, near the place where it left that
// layer.
void tell_layer(State& state, float force_n);

// Reports a layer that was not reported there, once the needle has gone on in it.
void tell_layer_late(State& state);

// Outside the tissue the needle is in no layer.
void leave_layers(State& state);

}  // namespace stylet
