// SPDX-License-Identifier: Apache-2.0
// What bends a needle: the forces of its constraint particles and contacts.
//
// Needle and tissue are solved in turn. This is stable, because each solution lowers their common
// energy. The needle bends twice in a tick, before and after the step of the tissue, so that the
// hand feels the energy that the joints store. (With one bend it bent against tissue that stood
// still; so it bent too far, and the hand felt the difference: up to 10 % of its work.) With its
// tip in contact it bends once more (meet_tissue). Every bend includes the obstacles
// (needle/rod.h).
//
// Promises: no allocation; operations bounded by limits.h. Units SI, frame of the attachments.
// PHYSICS 6.4.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// The needle as the last tick left it in the state's nodes; without directions.
Needle needle_of(const Model& model, const State& state);

// Makes the rods and their shape at rest; set_obstacles adds the obstacles.
void make_needle(const NeedleConfig& config, RodModel& rod_out);

// Shape of this needle at its handle's pose, and its contacts with obstacles. For an elastic needle
// in tissue, settle_needle finds the contacts. Returns output flags.
std::uint32_t place_needle(const Model& model, State& state, Scratch& scratch, Needle& needle_out);

// A needle whose tip is in contact bends once more before the step of the tissue, under the force
// with which the tip would press: until then its shape follows from the depth of the last tick, or
// from no force. Returns output flags.
std::uint32_t meet_tissue(const Model& model, State& state, Scratch& scratch, Needle& needle);

// After the tissue's step: bends by the new forces and moves the particles along. Returns
// output flags.
std::uint32_t settle_needle(const Model& model, State& state, Scratch& scratch, Needle& needle);

}  // namespace stylet
