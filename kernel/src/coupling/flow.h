// SPDX-License-Identifier: Apache-2.0
// Where a needle's opening lies, and the flow through it (laws/fluid.h).
//
// Pressure and resistance are those of the layer in which the middle of the opening lies. The flow
// moves no tissue. Promises: no allocation; nothing is done for a needle whose hub is closed. Units
// SI. PHYSICS 9.9.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// The force on a syringe's plunger, checked and clamped; returns flags.
std::uint32_t accept_plunger(const Model& model, State& state, const Input& input);

// One tick of flow; writes Output::flow and the events of fluid.
void move_fluid(const Model& model, State& state, const Needle& needle, Output& out);

}  // namespace stylet
