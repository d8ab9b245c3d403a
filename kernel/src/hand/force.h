// SPDX-License-Identifier: Apache-2.0
// Force and torque on the hand: the sum over constraint particles and contacts, by cause.
//
// Promises: bounded by limits.h, fixed order of sums. Units SI; forces in the world, torques about
// the handle. Source: paper section V. PHYSICS 14.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Sums the forces of this needle on its hand.
void sum_forces(const Model& model, const State& state, const Needle& needle, Output& out);

// Adds the hand's work since the last tick to the energies: the mean of the forces before and
// after, times the motion from the handle's pose `before`.
void book_work(State& state, const Pose& before, const Output& out);

}  // namespace stylet
