// SPDX-License-Identifier: Apache-2.0
#include "coupling/track.h"

#include "coupling/spring.h"
#include "lattice/voxel.h"

namespace stylet {
namespace {

// Just behind the entry the whole voxel counts as tissue, this far along the track, in voxel edges.
constexpr float kEntrySkin = 0.5F;
// A hole's mouth, in the needle's outer radii: a contact this near to an entry is at that entry,
// and a tip that has left its hole lies no deeper in it.
constexpr float kMouthInRadii = 3;
// A needle at the mouth of a hole enters it if its direction is the hole's, within 18 degrees.
constexpr float kSameWayCosine = 0.95F;

}  // namespace

bool holds_track(const Model& model, Vec3 rest_m, float track_m) {
  if (track_m < kEntrySkin * model.head->edge_m) return inside_lattice(model, rest_m);
  return material_at(model, rest_m) != kNoTissue;
}

float mouth_m(const Model& model) {
  return kMouthInRadii * model.needle_config().outer_radius_m;
}

namespace {

// The track that this contact enters, if the tissue remembers one here.
std::uint32_t find_track(const Model& model, const State& state, Vec3 rest_m, Vec3 rest_direction) {
  const float reach = mouth_m(model);
  for (std::uint32_t i = 0; i < state.head->track_count; ++i) {
    const Track& track = state.track[i];
    const Vec3 gap = track.entry_rest_m - rest_m;
    if (dot(gap, gap) < reach * reach &&
        dot(track.direction_rest, rest_direction) > kSameWayCosine) {
      return i;
    }
  }
  return kNoTrack;
}

}  // namespace

std::uint32_t remember_track(State& state, Vec3 rest_m, Vec3 rest_direction) {
  const std::uint32_t index = state.head->track_next;
  state.track[index] = {rest_m, rest_direction, 0};
  state.head->track_next = (index + 1) % kMaxTracks;
  if (state.head->track_count < kMaxTracks) ++state.head->track_count;
  state.head->track_max = state.head->track_count;
  return index;
}

std::uint32_t track_of(const Model& model, const State& state, const Needle& needle,
                       const Particle& entry) {
  if (entry.support_count == 0) return kNoTrack;
  const VoxelFrame frame = voxel_frame(model, state, entry.support[heaviest(entry)].slot,
                                       entry.support[heaviest(entry)].row);
  return find_track(model, state, entry.rest_m,
                    transposed_times(frame.rotation, needle.tip_direction));
}

}  // namespace stylet
