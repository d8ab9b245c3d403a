// SPDX-License-Identifier: Apache-2.0
// What a tick leaves to the next one about a needle: its pose, the obstacles that it touches, the
// tissue that it holds, and the holes that it has made.
//
// Promise: plain structs, the same bytes on every machine. The arrays of them, and
// who writes each, are in layout.h. Units: SI. Frames: rest (tissue without displacement) where a
// name says so, else the world.
#pragma once

#include <cstdint>

#include "base/math.h"
#include "laws/friction.h"
#include "needle/obstacle.h"
#include "organ/membranes.h"
#include "stylet/kernel.h"
#include "stylet/limits.h"

namespace stylet {

// One voxel's support of a constraint particle.
struct Support {
  std::uint32_t slot;  // the voxel's
  std::uint32_t row;   // that it lies in
  float weight;        // supports of one particle add up to 1
  Vec3 offset_m;       // rest offset from the voxel's centre
  Vec3 goal_m;         // by the last match of the voxel
  Quat turn;           // the voxel's rotation in that match
};

struct Particle {                // a constraint particle
  Vec3 rest_m;                   // place in the rest frame; chooses the voxels
  Vec3 position_m;               // the needle's point that holds it
  Vec3 memory_m, memory_n;       // Maxwell branch: displacement and force, both lagged
  Vec3 axial_way_m;              // axial way of the tissue, in addition to its way across
  Vec3 slack_m;                  // residual at which the spring carries nothing
  Vec3 force_n;                  // on the tissue, from the last match
  float track_m;                 // track coordinate: length from the entry
  float arc_m;                   // arc length on the needle, from the tip
  float stiffness_n_per_m;       // for the tributary length of now
  float full_stiffness_n_per_m;  // for a whole unit
  float tissue_compliance;       // of the lattice under the tip in contact, over the spring's
  float relaxing_fraction;       // part of the whole force that relaxes
  float memory_keep;             // part of the difference that is kept, per tick
  float memory_spread;           // relaxed part of the supports' spread
  float axial_fraction;          // axial compliance over that of spring and it together
  float slip_m_per_s;            // low-passed
  Friction friction;             // mean over the shaft length it carries, sampled at the tip
  float friction_length_m;       // how much of that length has been sampled
  Vec3 slip_m;                   // way of the needle past the tissue in this tick
  std::uint32_t material;        // of the tissue that holds it: index in the organ file
  std::uint32_t support_count;   // of the supports that are in use, the first ones
  Support support[kSupportsPerParticle];  // the voxels that hold it
};

constexpr std::uint32_t kNoTrack = 0xFFFFFFFFU;
struct Track {
  Vec3 entry_rest_m;    // where it begins: the rest place of the puncture
  Vec3 direction_rest;  // unit, inwards
  float length_m;       // as deep as a tip has been
};

// What a needle's tip has met of membranes (coupling/membranes.h).
struct MembraneState {
  Vec3 clear_m;                 // rest frame: no whole membrane lies between here and the tip
  std::uint32_t held;           // material of the membrane that holds it, plus 1; 0: none
  Vec3 held_at_m, held_normal;  // rest frame: where on that membrane, and its normal there
};
// The holes that tips have made in membranes, a ring.
struct MembraneHoles {
  std::uint32_t count;                    // of holes kept
  std::uint32_t next;                     // the one to overwrite next
  MembraneOpening opening[kMaxOpenings];  // a hole each
};

struct NeedleState {
  Pose handle;                  // of this tick, clamped
  Vec3 base_m;                  // of the handle, in the frame of the attachments
  std::uint32_t handle_known;   // 0 until the first valid input
  Phase phase;                  // changed by contact, insertion and cut of coupling/
  std::uint32_t layer;          // the material that the tip has entered last
  std::uint32_t spring_layer;   // the material of its spring: `layer`, or one that holds it up
  std::uint32_t shaft_count;    // particles on the shaft
  std::uint32_t shaft_max;      // the most since reset
  std::uint32_t tip_alive;      // 1: the tip holds tissue
  std::uint32_t leaving;        // the tip has left a track but not yet the surface around it
  std::uint32_t track_current;  // the track that it is in: index, or kNoTrack
  float layer_track_m;          // where the tip last changed layer
  std::uint32_t layer_before;   // the layer before `layer`
  float press_m_per_s;          // of the needle towards a surface that holds it, low-passed
  float track_end_m;            // length of the current track
  float drop_track_m;           // where the last shaft CP was added, or could not be: in a gap
  float tissue_track_m;         // the tip's track coordinate when it was last in tissue
  float twist_rad, twist_nm_per_rad;  // the hand's roll less the tip's, see roll.h
  Vec3 moved_m;  // of the tissue at the contact, by other needles; zero if there are none
  Vec3 cut;      // direction of the cut: that of the needle there, changed by a bevel
  Vec3 last_force_n, last_torque_nm;  // on the hand in the last tick, for its work
  std::uint32_t touch_count;          // contacts with obstacles
  std::uint32_t touch_max;            // the most since reset
};

// A piece of needle that touches an obstacle.
struct Touch {
  std::uint32_t obstacle;   // index
  std::uint32_t rod;        // the piece: index of its first node
  ObstacleContact contact;  // the bristle's state
  Vec3 at_m, force_n;       // on the needle, in the world
  float arc_m;              // from the handle
  Mat3 stiffness_n_per_m;   // how the force changes with the place: for elastic needles
  Vec3 normal;              // unit, out of the obstacle
  float depth_m;            // of the needle's surface in the obstacle
};

}  // namespace stylet
