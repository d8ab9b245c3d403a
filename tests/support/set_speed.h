// SPDX-License-Identifier: Apache-2.0
// Sets a particle's speed in the field of the state that counts: with true mass the filter computes
// velocities from momenta, and does not read the velocities from before a step. Units: m/s, world.
#pragma once

#include "state/layout.h"

namespace stylet::test {

inline void set_speed(View view, std::uint32_t particle, Vec3 speed) {
  const bool filtered = has_true_mass(view.model);
  (filtered ? view.state.wx : view.state.vx)[particle] = speed.x;
  (filtered ? view.state.wy : view.state.vy)[particle] = speed.y;
  (filtered ? view.state.wz : view.state.vz)[particle] = speed.z;
}

}  // namespace stylet::test
