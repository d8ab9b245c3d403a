// SPDX-License-Identifier: Apache-2.0
// Energy of tissue and springs as the explicit step conserves it: an observer of energy must use
// this one. Units: J.
#pragma once

#include <algorithm>
#include <utility>

#include "state/layout.h"
#include "stylet/kernel.h"

namespace stylet::test {

// Moves the particles to where the tissue's dampers feel them, a time tau ahead. A second swap
// moves them back.
inline void swap_ahead(View view) {
  const std::uint32_t count = view.model.head->counts.particles;
  float* const places[] = {view.state.ux, view.state.uy, view.state.uz};
  float* const ahead[] = {view.state.ex, view.state.ey, view.state.ez};
  for (int axis = 0; axis < 3; ++axis) {
    std::swap_ranges(places[axis], places[axis] + count, ahead[axis]);
  }
}

// `now` is the kernel's. Its velocities v are those half a substep h before its places u, so that
// the sum of its energies swings with a wave of w by up to h w / 2 of it. With P the energy of
// places, for waves
//   v M v / 2 + P(u) - h / (2 tau) (P(u + tau v) - P(u))
// is what steps without damping keep, and steps with damping lower it, each by h tau w^2 (v + v')^2
// / 4 (tau to zero: v M v / 2 + u K u' / 2, which leapfrog keeps).
inline double tissue_energy(const Kernel& kernel, const Energy& now) {
  View view = view_of(kernel);
  const ModelHead& head = *view.model.head;
  swap_ahead(view);
  const Energy ahead = energy(kernel);
  swap_ahead(view);
  const double part =
      0.5 * static_cast<double>(head.substep_s) / static_cast<double>(head.config.tissue_damping_s);
  const double held = now.elastic + now.coupling;
  return now.kinetic + held - part * (ahead.elastic + ahead.coupling - held);
}

}  // namespace stylet::test
