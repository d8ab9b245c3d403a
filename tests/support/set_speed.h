// SPDX-License-Identifier: Apache-2.0
// A speed for a particle, whichever field of the state has it: with true mass the filter makes
// velocities of the momenta, and what stands in the velocities before a step is not read.
// Units: m/s, world.
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
