// SPDX-License-Identifier: Apache-2.0
// What acts on all tissue alike: the frame of the attachments, which is the world shifted as the
// patient breathes (BreathingConfig); and the change of gravity since the shape at rest was taken.
// PHYSICS 4.5, 4.6.
#pragma once

#include "state/layout.h"

namespace stylet {

// Shift of the attachments at the state's tick.
Vec3 attachment_shift(const Model& model, const State& state);

inline bool has_weight(const Model& model) {
  const Vec3 g = model.head->config.gravity_m_per_s2;
  return g.x != 0 || g.y != 0 || g.z != 0;
}
// In m/s^2, at the state's tick: all of it once kGravityFadeS have passed.
Vec3 gravity_now(const Model& model, const State& state);

}  // namespace stylet
