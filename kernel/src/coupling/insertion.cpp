// SPDX-License-Identifier: Apache-2.0
#include "coupling/insertion.h"

#include "coupling/contact_spring.h"
#include "coupling/friction.h"
#include "coupling/membranes.h"
#include "coupling/shaft.h"
#include "coupling/spring.h"
#include "coupling/stiffness.h"
#include "coupling/support.h"
#include "coupling/track.h"
#include "lattice/voxel.h"
#include "state/events.h"

namespace stylet {

namespace {

// From the spring of contact to that of cutting, at the same force along the needle and across it.
// The difference of their energies is spent on the rupture.
void change_spring(const Model& model, State& state, const Needle& needle, float force_n) {
  Particle& tip = *state.tip;
  const double before = contact_energy(model, state, tip);
  const Vec3 direction = needle.tip_direction, pressed = force_on_tissue(tip);
  const Vec3 across = pressed - dot(pressed, direction) * direction;
  const float old = tip.stiffness_n_per_m, spread = spread_of(tip, residual(tip));
  tip.tissue_compliance = 0;  // only used in contact
  set_stiffness(model, state, tip, Role::kTip);
  forget(tip);
  const float k = tip.stiffness_n_per_m;
  gather_goals(tip, (1 / k) * (across + force_n * direction), spread * min_of(old / k, 1));
  state.head->cutting_j += before - spring_energy(tip);
}

// The needle enters a track: its tip is `depth_m` along it, its first shaft CP at the entry.
void enter_track(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                 std::uint32_t track, float depth_m, const Particle& entry) {
  NeedleState& own = *state.needle;
  Particle& tip = *state.tip;
  own.track_current = track;
  own.track_end_m = max_of(state.track[track].length_m, depth_m);
  tip.track_m = own.tissue_track_m = own.layer_track_m = depth_m;
  own.drop_track_m = 0;
  own.shaft_count = 0;
  (void)push_shaft(model, state, scratch, entry);
  own.layer = own.spring_layer = own.layer_before = tip.material;
  own.cut = needle.tip_direction;
}

}  // namespace

void begin_insertion(const Model& model, State& state, Scratch& scratch, const Needle& needle,
                     std::uint32_t track, float force_n) {
  NeedleState& own = *state.needle;
  const Particle& tip = *state.tip;
  const VoxelFrame frame =
      voxel_frame(model, state, tip.support[heaviest(tip)].slot, tip.support[heaviest(tip)].row);
  const Vec3 rest_direction = transposed_times(frame.rotation, needle.tip_direction);
  const bool again = track != kNoTrack;
  // The entry is held where the surface is now, behind the tip by the depth of the dimple's cone.
  const float behind = dot(residual(tip), needle.tip_direction);
  const Vec3 place = tip.position_m - behind * needle.tip_direction;
  enter_track(model, state, scratch, needle,
              again ? track : remember_track(state, tip.rest_m, rest_direction), 0,
              new_particle(model, state, needle, tip.rest_m, place, 0, behind, Role::kShaft));
  start_membranes(model, state, rest_direction, again);
  change_spring(model, state, needle, force_n);
  own.phase = Phase::kInserted;
  add_event(state, again ? EventKind::kReentry : EventKind::kPuncture, force_n);
}

void take_in(const Model& model, State& state, Scratch& scratch, const Needle& needle,
             std::uint32_t track, const Particle& entry) {
  enter_track(model, state, scratch, needle, track, state.tip->track_m, entry);
  start_membranes(model, state, {}, true);
  state.needle->phase = Phase::kRetracting;
  (void)drop_shaft(model, state, scratch, needle);
  gather_friction(model, state, entry.rest_m, 0);
  add_event(state, EventKind::kReentry, 0);
}

void end_insertion(State& state) {
  NeedleState& own = *state.needle;
  add_event(state, EventKind::kExit, 0);
  if (own.track_current != kNoTrack) {
    state.track[own.track_current].length_m = own.track_end_m;
  }
  own.track_current = kNoTrack;
  own.shaft_count = 0;
  own.tip_alive = 0;
  own.phase = Phase::kFree;
  own.layer = kNoLayer;
  own.leaving = 1;
}

}  // namespace stylet
