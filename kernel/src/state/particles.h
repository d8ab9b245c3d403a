// SPDX-License-Identifier: Apache-2.0
// The constraint particles of all needles by one number: that of the needle, then the place in its
// shaft, the tip last.
//
// Promises: bounded by limits.h, a fixed order. The views of model and state are the first
// needle's.
#pragma once

#include "state/layout.h"

namespace stylet {

inline Particle& particle_at(State& state, std::uint32_t index) {
  return state.shaft[index];
}
inline const Particle& particle_at(const State& state, std::uint32_t index) {
  return state.shaft[index];
}

inline bool is_tip(std::uint32_t index) {
  return index % kNeedleParticles == kMaxConstraintParticles;
}

// Calls `visit(number)` for each particle there is.
template <typename Visit>
void for_each_particle(const Model& model, const State& state, Visit visit) {
  for (std::uint32_t n = 0; n < model.head->counts.needles; ++n) {
    const NeedleState& needle = state.needle[n];
    const std::uint32_t first = n * kNeedleParticles;
    for (std::uint32_t i = 0; i < needle.shaft_count; ++i) visit(first + i);
    if (needle.tip_alive != 0) visit(first + kMaxConstraintParticles);
  }
}

}  // namespace stylet
