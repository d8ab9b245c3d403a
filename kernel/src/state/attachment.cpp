// SPDX-License-Identifier: Apache-2.0
#include "state/attachment.h"

#include "base/math.h"

namespace stylet {

Vec3 attachment_shift(const Model& model, const State& state) {
  const BreathingConfig& b = model.head->config.breathing;
  const double breaths = static_cast<double>(state.head->tick) *
                         static_cast<double>(model.head->config.period_s) /
                         static_cast<double>(b.period_s);
  const double part = breaths - static_cast<double>(static_cast<std::int64_t>(breaths));
  const float s = sine_of_half_turns(static_cast<float>(part));
  return ((s * s) * (s * s)) * b.amplitude_m;
}

Vec3 gravity_now(const Model& model, const State& state) {
  const Config& config = model.head->config;
  const double elapsed_s =
      static_cast<double>(state.head->tick) * static_cast<double>(config.period_s);
  const float part = min_of(static_cast<float>(elapsed_s) / kGravityFadeS, 1);
  return (part * part * (3 - 2 * part)) * config.gravity_m_per_s2;
}

}  // namespace stylet
