// SPDX-License-Identifier: Apache-2.0
#include "coupling/membranes.h"

#include "base/math.h"
#include "coupling/layers.h"
#include "coupling/track.h"

namespace stylet {
namespace {

// The tip stops this far before a membrane: twenty times what floats resolve there (limits.h).
constexpr float kStopM = 1e-5F;
// A membrane counts as the surface's own this far outside it: no two triangulations of one surface
// lie nearer.
constexpr float kBeforeEntryM = kLayerSkinM;

}  // namespace

void start_membranes(const Model& model, State& state, Vec3 rest_direction, bool in_track) {
  if (!has_membranes(model)) return;
  const Vec3 rest_m = state.tip->rest_m;
  *state.membrane = {in_track ? rest_m : rest_m - kBeforeEntryM * rest_direction, 0, {}, {}};
}

std::uint32_t holding_membrane(const Model& model, const State& state) {
  return has_membranes(model) && state.membrane->held > 0 ? state.membrane->held - 1 : kNoTissue;
}

MembraneCrossing free_part(const Model& model, const State& state, Vec3 way_m) {
  const float way = norm(way_m);
  if (!has_membranes(model) || !(way > 0)) return {1, kNoTissue, {}, {}};
  const Vec3 rest_m = state.tip->rest_m;
  const MembraneHoles& holes = *state.holes;
  // A little beyond its end, as the tip stops before a membrane.
  const Vec3 end_m = rest_m + (1 + kStopM / way) * way_m;
  MembraneCrossing met = first_membrane(model.organ(), {holes.opening, holes.count}, mouth_m(model),
                                        state.membrane->clear_m, end_m);
  if (met.clear >= 1) return met;
  const float before_m = dot(met.at_m - rest_m, (1 / way) * way_m) - kStopM;
  met.clear = clamp(before_m / way, 0, 1);
  return met;
}

void hold_at(State& state, const MembraneCrossing& met) {
  state.membrane->held = met.material + 1;
  state.membrane->held_at_m = met.at_m;
  state.membrane->held_normal = met.normal;
}

void let_go(const Model& model, State& state, bool through) {
  if (!has_membranes(model)) return;
  MembraneState& own = *state.membrane;
  if (through && own.held > 0) {
    MembraneHoles& holes = *state.holes;
    holes.opening[holes.next] = {own.held_at_m, own.held_normal, own.held - 1};
    holes.next = (holes.next + 1) % kMaxOpenings;
    if (holes.count < kMaxOpenings) ++holes.count;
  }
  own.held = 0;
  own.held_at_m = own.held_normal = {};
}

void note_place(const Model& model, State& state) {
  if (has_membranes(model)) state.membrane->clear_m = state.tip->rest_m;
}

}  // namespace stylet
