// SPDX-License-Identifier: Apache-2.0
// The tip in tissue: how far it cuts, into which material, along which way.
//
// The tip's constraint particle is held by the tissue in front of it; beyond the force it may carry
// it moves on to other tissue (return_map.h). Where it goes is integrated in the rest frame.
//
// Promises: a fixed number of operations, no allocation. Units SI, frame of the attachments.
// Source: paper section IV.C, step 3; Mahvash and Dupont 2010 (force of a rupture by speed).
// PHYSICS 9.1 to 9.3.
#pragma once

#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Force that breaks a surface: less when pressed faster (Mahvash and Dupont 2010).
float puncture_force(const State& state, const MaterialModel& m);

// The tip moves on to other tissue as far as it is pressed or pulled beyond its limits, along the
// way it cuts: a bevel that is pushed aside against the tissue's force has to be paid for by the
// hand that pushes.
void cut_tip(const Model& model, State& state, const Needle& needle, float moved_m);

// Takes the voxels where the tip now is. Supports that fade take along what their goals differ from
// the others'; a tip that leaves, all.
void rehome_tip(const Model& model, State& state);

// The tissue may pull at the tip as hard as the tip may press. One that has slipped back in this
// tick, without force, takes back as much of that as the tissue it has let go comes after it: it
// would press at the tick's end and not while it slipped, and the hand would have that for nothing.
// One that has just come to another material enters it with the next cut.
void let_cut(const Model& model, State& state);

}  // namespace stylet
