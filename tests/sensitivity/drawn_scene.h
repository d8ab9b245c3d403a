// SPDX-License-Identifier: Apache-2.0
// Random scenes, given by a seed, whose hands keep moving: the kernel's constants are tried with
// them.
//
// Every needle goes in, rests, steps aside, swings to and fro at 4 Hz across and along, goes
// deeper, back and in again, and comes out. Organs and needles are realistic: 3 to 50 kPa, voxels
// of 3 to 6 mm, 25G to 16G; a surface breaks at a dimple of 2 to 8 mm.
//
// Promises: the same seed gives the same scene; the way of a hand depends on time alone, not on
// forces, nor on how long a tick is. Units: SI. Frame: world; needles come from +z.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "session.h"
#include "stylet/kernel.h"

namespace stylet::test {

// What a scene is about; every kind has all the motions.
enum class Kind : std::uint32_t { kRigid, kElastic, kBone, kTwo, kSurface, kLayers };
constexpr std::uint32_t kKinds = 6;
const char* kind_name(Kind kind);

// A part of a hand's way: the tip comes to a place, with a smooth beginning and end, and then
// swings about it. Places count from the entry: to the right, up, and along the needle.
struct Move {
  Vec3 to_m;
  double duration_s = 0;
  Vec3 swing_m = {};     // amplitude at kSwingHz
  bool is_rest = false;  // at its end the force must be steady
};
constexpr double kSwingHz = 4;  // as fast as a hand can swing on purpose

struct Hand {
  Vec3 entry_m;
  Quat rotation;
  float length_m;
  std::vector<Move> moves;
};

struct DrawnScene {
  Kind kind;
  std::unique_ptr<OpenOrgan> organ;
  Config config;
  std::vector<ObstacleConfig> obstacles;
  std::vector<Hand> hands;
  double duration_s = 0;
};

DrawnScene draw_scene(std::uint64_t seed, Kind kind);

// Where the hand is at a time, with its tip `deeper_m` deeper than in the scene; and whether it
// rests there.
struct HandPlace {
  Pose pose;
  bool at_rest;  // in the last kJudgedS of a rest
};
constexpr double kJudgedS = 0.05;
HandPlace hand_place(const Hand& hand, double time_s, double deeper_m);

}  // namespace stylet::test
