// SPDX-License-Identifier: Apache-2.0
#include "coupling/shaft.h"

#include "coupling/deformation.h"
#include "coupling/friction.h"
#include "coupling/spring.h"
#include "coupling/support.h"
#include "coupling/track.h"

namespace stylet {
namespace {

// The tip must be this far behind a shaft CP to have passed it: a tip that re-enters a track starts
// beside the first CP.
constexpr float kTrackSkinM = 1e-5F;
// In a gap, steps of this many units search for a place for a shaft CP.
constexpr float kGapStep = 0.25F;

}  // namespace

std::uint32_t push_shaft(const Model& model, State& state, Scratch& scratch, Particle p) {
  NeedleState& own = *state.needle;
  if (own.shaft_count == kMaxConstraintParticles) {
    ++state.head->cp_pool_full;
    return kFlagCpPoolFull;
  }
  take_tributary_spring(model, state, p);
  stretch_of(state, scratch, own.shaft_count) = {};
  state.shaft[own.shaft_count++] = p;
  own.shaft_max = own.shaft_count > own.shaft_max ? own.shaft_count : own.shaft_max;
  return 0;
}

namespace {

// The place on the needle of a tissue point near the tip: its arc length from the tip.
float arc_at(const Model& model, const State& state, const Needle& needle, Vec3 rest_m,
             float otherwise_m) {
  Vec3 present = {};
  if (!present_place(model, state, rest_m, present)) return otherwise_m;
  return max_of(dot(needle.tip_m - present, needle.tip_direction), 0);
}

}  // namespace

std::uint32_t drop_shaft(const Model& model, State& state, Scratch& scratch, const Needle& needle) {
  NeedleState& own = *state.needle;
  const Particle& tip = *state.tip;
  const float unit = model.needle_config().unit_m;
  if (tip.support_count == 0) return 0;  // this shaft length lies outside the tissue
  if (own.drop_track_m > tip.track_m) {
    own.drop_track_m = state.shaft[own.shaft_count - 1].track_m;
  }
  if (tip.track_m - (own.drop_track_m + unit) < 0) return 0;
  const Gradient g = gradient_around(model, state, tip);
  const Vec3 image = pull_back(g, needle.tip_direction);
  const Vec3 along = (1 / norm(image)) * image;
  const Vec3 point = tip.rest_m + pull_back_step(g, residual(tip));  // at the needle's tip
  for (std::uint32_t drop = 0; drop < kMaxDropsPerTick; ++drop) {
    const float track = own.drop_track_m + unit, behind = tip.track_m - track;
    if (behind < 0) return 0;
    Vec3 rest = point - behind * along;
    if (!holds_track(model, rest, track)) rest = tip.rest_m - behind * along;
    const float arc = arc_at(model, state, needle, rest, behind);
    const Particle p = new_particle(model, state, needle, rest, needle_place(needle, arc), track,
                                    arc, Role::kShaft);
    if (p.support_count == 0 || !holds_track(model, rest, track)) {
      own.drop_track_m += kGapStep * unit;
      continue;
    }
    const std::uint32_t flags = push_shaft(model, state, scratch, p);
    if (flags != 0) return flags;
    own.drop_track_m = track;
  }
  return 0;
}

bool is_behind(const Model& model, const State& state, const Particle& p) {
  return state.tip->track_m < p.track_m - kTrackSkinM || p.arc_m < -model.needle_config().unit_m;
}

}  // namespace stylet
