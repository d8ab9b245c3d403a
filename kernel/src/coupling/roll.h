// SPDX-License-Identifier: Apache-2.0
// The tip's roll lags behind the hand's: friction along the shaft twists a thin needle.
//
// A torsion bar of stiffness GJ is held at each constraint particle by friction on its surface, up
// to what the axial force leaves of the particle's limit, times the radius. If all of them slip,
// with torques t_i at distances s_i from the hand, the tip lags by sum(t_i s_i) / GJ. Before that
// the twist is elastic, the torques in proportion. So a tip that is rolled in place lags. It
// follows as the needle moves on, because friction then points along the shaft. Slip dissipates
// energy.
//
// Left out: the tissue does not turn with the shaft. Promises: operations bounded by the particles,
// no allocation. Units SI. Source: Reed, Okamura, Cowan 2009 (torsional lag in needle steering);
// the elastic-plastic bar is from textbooks. PHYSICS 6.6.
#pragma once

#include "base/math.h"
#include "state/layout.h"

namespace stylet {

// Takes in how far the hand has rolled in this tick, about the handle's z.
void roll_tip(const Model& model, State& state, float rolled_rad);

// The handle's x, rolled as the tip is.
Vec3 rolled_side(const State& state, const Mat3& handle);

// The torque on the hand.
Vec3 roll_torque_nm(const State& state);
double roll_energy(const State& state);

}  // namespace stylet
