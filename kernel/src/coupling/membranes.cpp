// SPDX-License-Identifier: Apache-2.0
#include "coupling/membranes.h"

#include "base/math.h"
#include "coupling/layers.h"

namespace stylet {
namespace {

// The tip stops this far before a membrane, and has gone through it this far behind: twenty times
// what floats resolve there (limits.h).
constexpr float kStopM = 1e-5F;
// A membrane counts as the surface's own this far outside it: no two triangulations of one surface
// lie nearer.
constexpr float kBeforeEntryM = kLayerSkinM;
// Membranes on the tip's way in a tick that it has been through before. Reached: the rest of the
// way follows in the next tick.
constexpr int kMostOpen = 4;

TrackMembranes& track_of(State& state) {
  return state.track_membranes[state.needle->track_current];
}

// Whether the track has gone through this membrane. The same membrane within kLayerSkinM is one:
// a track that is walked again is as long as before only up to there.
bool is_open(const State& state, std::uint32_t material, float track_m) {
  const TrackMembranes& track = state.track_membranes[state.needle->track_current];
  const float since = track_m - track.passed_m;
  const bool passed = track.passed == material + 1 && since < kLayerSkinM && since > -kLayerSkinM;
  return passed || track_m < track.open_m - kLayerSkinM;
}

}  // namespace

void start_membranes(const Model& model, State& state, Vec3 rest_direction, bool again) {
  if (!has_membranes(model)) return;
  const Vec3 rest_m = state.tip->rest_m;
  if (!again) track_of(state) = {};
  *state.membrane = {again ? rest_m : rest_m - kBeforeEntryM * rest_direction, 0};
}

std::uint32_t holding_membrane(const Model& model, const State& state) {
  return has_membranes(model) && state.membrane->held > 0 ? state.membrane->held - 1 : kNoTissue;
}

MembraneCrossing free_part(const Model& model, const State& state, Vec3 way_m) {
  const float way = norm(way_m);
  if (!has_membranes(model) || !(way > 0)) return {1, kNoTissue};
  const Vec3 rest_m = state.tip->rest_m, end_m = rest_m + way_m;
  const Vec3 direction = (1 / way) * way_m;
  Vec3 from_m = state.membrane->clear_m;
  for (int i = 0; i < kMostOpen; ++i) {
    if (dot(end_m - from_m, direction) <= 0) return {1, kNoTissue};
    const MembraneCrossing met = first_membrane(model.organ(), from_m, end_m);
    if (met.clear >= 1) return {1, kNoTissue};
    const Vec3 at_m = from_m + met.clear * (end_m - from_m);
    const float before = dot(at_m - rest_m, direction);  // along the tip's way
    const float part = clamp((before - kStopM) / way, 0, 1);
    if (met.material == kNoTissue) return {part, kNoTissue};
    if (!is_open(state, met.material, state.tip->track_m + before)) return {part, met.material};
    from_m = at_m + kStopM * direction;
  }
  return {clamp(dot(from_m - rest_m, direction) / way, 0, 1), kNoTissue};
}

void note_free(const Model& model, State& state, Vec3 way_m) {
  if (!has_membranes(model)) return;
  const Vec3 end_m = state.tip->rest_m + way_m;
  Vec3& clear_m = state.membrane->clear_m;
  // Behind a membrane that it goes through, the way is searched only from there on.
  if (dot(end_m - clear_m, way_m) > 0) clear_m = end_m;
  TrackMembranes& track = track_of(state);
  track.open_m = max_of(track.open_m, state.tip->track_m);
}

void hold_at(const Model& model, State& state, std::uint32_t material) {
  if (has_membranes(model)) state.membrane->held = material + 1;
}

void let_go(const Model& model, State& state) {
  if (has_membranes(model)) *state.membrane = {state.tip->rest_m, 0};
}

void go_through(const Model& model, State& state, Vec3 rest_direction) {
  MembraneState& own = *state.membrane;
  const Vec3 ahead_m = kLayerSkinM * rest_direction;
  const MembraneCrossing met = first_membrane(model.organ(), own.clear_m, own.clear_m + ahead_m);
  const bool found = met.material != kNoTissue;
  const Vec3 at_m = found ? own.clear_m + met.clear * ahead_m : state.tip->rest_m;
  TrackMembranes& track = track_of(state);
  track.passed_m = state.tip->track_m + dot(at_m - state.tip->rest_m, rest_direction);
  track.passed = own.held;
  track.open_m = max_of(track.open_m, state.tip->track_m);
  own = {at_m + kStopM * rest_direction, 0};
}

}  // namespace stylet
