// SPDX-License-Identifier: Apache-2.0
#include "coupling/insertion.h"

#include "coupling/contact_spring.h"
#include "coupling/friction.h"
#include "coupling/shaft.h"
#include "coupling/spring.h"
#include "coupling/stiffness.h"
#include "coupling/support.h"
#include "coupling/track.h"
#include "lattice/voxel.h"
#include "state/events.h"

namespace stylet {

namespace {

// From the spring of contact to that of cutting, at the same force along the needle and across; the
// difference of their energies is spent on the rupture.
void change_spring(const View& view, const Needle& needle, float force_n) {
  StateHead& state = *view.state.head;
  Particle& tip = *view.state.tip;
  const double before = contact_energy(view, tip);
  const Vec3 direction = needle.tip_direction, pressed = force_on_tissue(tip);
  const Vec3 across = pressed - dot(pressed, direction) * direction;
  const float old = tip.stiffness_n_per_m, spread = spread_of(tip, residual(tip));
  tip.tissue_compliance = 0;  // of the contact only
  set_stiffness(view, tip, Place::kTip);
  forget(tip);
  const float k = tip.stiffness_n_per_m;
  gather_goals(tip, (1 / k) * (across + force_n * direction), spread * min_of(old / k, 1));
  state.cutting_j += before - spring_energy(tip);
}

// The needle is in a track, its tip `depth_m` along it and its first shaft CP at the entry.
void enter_track(const View& view, const Needle& needle, std::uint32_t track, float depth_m,
                 const Particle& entry) {
  NeedleState& own = *view.state.needle;
  Particle& tip = *view.state.tip;
  own.track_current = track;
  own.track_end_m = max_of(view.state.track[track].length_m, depth_m);
  tip.track_m = own.tissue_track_m = own.layer_track_m = depth_m;
  own.drop_track_m = 0;
  own.shaft_count = 0;
  (void)push_shaft(view, entry);
  own.layer = own.spring_layer = own.layer_before = tip.material;
  own.cut = needle.tip_direction;
}

}  // namespace

void begin_insertion(const View& view, const Needle& needle, std::uint32_t track, float force_n) {
  NeedleState& own = *view.state.needle;
  const Particle& tip = *view.state.tip;
  const VoxelFrame frame =
      voxel_frame(view, tip.share[heaviest(tip)].slot, tip.share[heaviest(tip)].row);
  const Vec3 rest_direction = transposed_times(frame.rotation, needle.tip_direction);
  const bool again = track != kNoTrack;
  // The entry is held where the surface is now, behind the tip by the depth of the dimple's cone.
  const float behind = dot(residual(tip), needle.tip_direction);
  const Vec3 place = tip.position_m - behind * needle.tip_direction;
  enter_track(view, needle, again ? track : remember_track(view, tip.rest_m, rest_direction), 0,
              new_particle(view, needle, tip.rest_m, place, 0, behind, Place::kShaft));
  change_spring(view, needle, force_n);
  own.phase = Phase::kInserted;
  add_event(view, again ? EventKind::kReentry : EventKind::kPuncture, force_n);
}

void take_in(const View& view, const Needle& needle, std::uint32_t track, const Particle& entry) {
  enter_track(view, needle, track, view.state.tip->track_m, entry);
  view.state.needle->phase = Phase::kRetracting;
  (void)drop_shaft(view, needle);
  meet_friction(view, entry.rest_m, 0);
  add_event(view, EventKind::kReentry, 0);
}

void end_insertion(const View& view) {
  NeedleState& own = *view.state.needle;
  add_event(view, EventKind::kExit, 0);
  if (own.track_current != kNoTrack) {
    view.state.track[own.track_current].length_m = own.track_end_m;
  }
  own.track_current = kNoTrack;
  own.shaft_count = 0;
  own.tip_alive = 0;
  own.phase = Phase::kFree;
  own.layer = kNoLayer;
  own.leaving = 1;
}

}  // namespace stylet
