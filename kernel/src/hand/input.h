// SPDX-License-Identifier: Apache-2.0
// The hand's input in a tick: checked, clamped, flagged and counted, never refused.
//
// Promises: whatever the bytes are, the pose that is kept is finite, its rotation has unit length,
// and its motion in the tick is within limits.h (kMaxHandleDistanceM, kMaxHandleSpeedMPerS,
// kMaxHandleSpinRadPerS). Units SI, world frame. PHYSICS 5.
#pragma once

#include "state/layout.h"

namespace stylet {

// Takes the sample into the state, or keeps the last pose; never an error. Returns output flags.
std::uint32_t accept_input(const Model& model, State& state, const Input& input);

// The turn between two rotations as a vector along its axis; only for small turns.
Vec3 turn_between(const Quat& a, const Quat& b);

}  // namespace stylet
