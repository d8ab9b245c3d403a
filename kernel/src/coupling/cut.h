// SPDX-License-Identifier: Apache-2.0
// The tip in tissue: how far it cuts, into which material, and in which direction.
//
// The tissue ahead of the tip holds the tip's constraint particle. Under more force than this
// particle may carry, it moves on to other tissue (return_map.h). Its path is integrated in the
// rest frame.
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

// Moves the tip on, in the direction of the cut, so far that its force is within its limits. A
// bevel is pushed aside against the force of the tissue; the hand that pushes the needle does that
// work.
void cut_tip(const Model& model, State& state, const Needle& needle, float moved_m);

// Takes the voxels around the tip's present place. When a support fades out, the difference of its
// goal from the others' is lost with it; when the tip leaves the tissue, all are lost.
void rehome_tip(const Model& model, State& state);

// After the step of the tissue: the tissue may pull at the tip with as much force as the tip may
// press. A tip that slipped back in this tick did so without force. As far as the released tissue
// has followed it, the tip takes its slip back; otherwise it would press at the end of the tick
// with a force against which the hand has done no work. A tip that has just reached another
// material enters it with the next cut.
void cut_after_step(const Model& model, State& state);

}  // namespace stylet
