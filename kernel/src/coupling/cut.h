// SPDX-License-Identifier: Apache-2.0
// The tip in tissue: how far it cuts, into which material, and in which direction.
//
// The tissue in front of the tip holds the tip's constraint particle. Under more force than it may
// carry, it moves on to other tissue (return_map.h). Its path is integrated in the rest frame.
//
// Promises: a fixed number of operations, no allocation. Units SI, frame of the attachments.
// Source: paper section IV.C, step 3; Mahvash and Dupont 2010 (force of a rupture by speed).
// PHYSICS 9.1 to 9.3.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Force that breaks a surface: less than the given one if the needle presses faster (Mahvash and
// Dupont 2010).
float puncture_force(const Model& model, const State& state, std::uint32_t material, float given_n);

// The tip moves on to other tissue as far as it is pressed or pulled beyond its limits, in the
// direction of the cut. A bevel is pushed aside against the tissue's force: the hand that pushes
// the needle does that work.
void cut_tip(const Model& model, State& state, const Needle& needle, float moved_m);

// Takes the voxels where the tip now is. Supports that fade take with them how far their goals
// differ from the others'; when the tip leaves the tissue, everything goes.
void rehome_tip(const Model& model, State& state);

// The tissue may pull at the tip as hard as the tip may press. A tip that slipped back in this
// tick did so without force. Where the released tissue follows it, the tip takes back as much of
// the slip: else it would press at the tick's end but not while it slipped, a force that the hand
// had not paid for. A tip that has just reached another material enters it with the next cut.
void cut_after_step(const Model& model, State& state);

}  // namespace stylet
