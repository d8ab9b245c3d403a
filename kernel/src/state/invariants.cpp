// SPDX-License-Identifier: Apache-2.0
#include "state/invariants.h"

#ifdef STYLET_INVARIANTS

#undef NDEBUG  // also in builds that turn other asserts off
#include <cassert>

namespace stylet {
namespace {

// By how much the supports' weights may miss the sum 1: rounding, as in the check of snapshots.
constexpr float kRounding = 1e-3F;

bool is_outside(float x, float low, float high) {
  return x < low || x > high;
}

void assert_particle(const Model& model, const Particle& p) {
  const Counts& counts = model.head->counts;
  assert(p.support_count <= kSupportsPerParticle);
  assert(p.material < model.head->material_count);
  float sum = 0;
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    const Support& support = p.support[i];
    assert(support.slot < counts.slots && support.row < counts.rows);
    assert(support.slot - model.row[support.row].slot < model.row[support.row].count);
    assert(!is_outside(support.weight, -kRounding, 1 + kRounding));
    sum += support.weight;
  }
  assert(p.support_count == 0 || !is_outside(sum, 1 - kRounding, 1 + kRounding));
  assert(!(p.stiffness_n_per_m < 0) && !(p.full_stiffness_n_per_m < 0));
  assert(!is_outside(p.relaxing_fraction, 0, 1) && !is_outside(p.axial_fraction, 0, 1));
}

}  // namespace

void assert_needle(const Model& model, const State& state) {
  const NeedleState& own = *state.needle;
  const bool inside = own.phase == Phase::kInserted || own.phase == Phase::kRetracting;
  assert(own.phase <= Phase::kRetracting);
  assert((own.phase == Phase::kFree) == (own.tip_alive == 0));  // it holds tissue, or is free
  assert(inside == (own.shaft_count > 0));                      // from its entry to its exit
  assert(own.shaft_count <= kMaxConstraintParticles && own.touch_count <= kMaxTouches);
  assert(own.track_current == kNoTrack || own.track_current < state.head->track_count);
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) assert_particle(model, state.shaft[i]);
  if (own.tip_alive != 0) assert_particle(model, *state.tip);
}

}  // namespace stylet

#endif
