// SPDX-License-Identifier: Apache-2.0
// The frame of the attachments: the world, shifted as the patient breathes (BreathingConfig).
// PHYSICS 4.5.
#pragma once

#include "state/layout.h"

namespace stylet {

// Shift of the attachments at the state's tick.
Vec3 attachment_shift(const Model& model, const State& state);

}  // namespace stylet
