// SPDX-License-Identifier: Apache-2.0
// Contacts with obstacles: faces of bodies near the needle, and the touches that a tick keeps.
//
// An elastic needle bends against the faces that are found here (needle/rod.h). A rigid one follows
// the hand and gets a force that pushes it back.
//
// Promises: at most kMaxTouches touches, bounded by kMaxObstacles and kMaxRods; no allocation.
// Units SI; places of touches in the world. PHYSICS 13.
#pragma once

#include "needle/obstacle.h"
#include "needle/rod.h"
#include "needle/shape.h"
#include "state/layout.h"

namespace stylet {

// Obstacles nearer than this are looked for. No step of one look moves the needle farther, so a
// needle that snaps over does not pass through a body that was not seen.
constexpr double kReachM = 2e-3;

// A face of a body beside a piece of the needle.
struct Near {
  std::uint32_t body, rod;
  ObstacleFace face;
  const Touch* last;
};
// The faces that are deepest, in two forms: as found, and for the rods.
struct Nearest {
  std::uint32_t left_out;  // that touch, but had no room
  Near near[kMaxTouches];
  RodFaces faces;
};

// For all pieces, at the shape of the rods' result, and all bodies. The state still holds the shape
// before.
void look_around(const Model& model, const State& state, const Scratch& scratch, Vec3 shift,
                 const Nearest& before, Nearest& out);

std::uint32_t enter_touches(const Model& model, State& state, Scratch& scratch,
                            const Nearest& nearest);

// For a rigid needle, which follows the hand. `before_m`: its nodes before this tick's motion.
std::uint32_t touch_obstacles(const Model& model, State& state, Scratch& scratch,
                              const Needle& needle, const Vec3 before_m[2], Vec3 shift);

}  // namespace stylet
