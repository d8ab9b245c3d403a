// SPDX-License-Identifier: Apache-2.0
// A scene: one TOML file that says what is run and how. Every key is listed in hal/scene/README.md.
//
// Promise: an unknown key, a wrong type, a missing or an impossible value throws SceneError with
// one line "file:line: key: value: what is allowed". May allocate; never called from the loop.
// Units: the file's are in its keys, the struct's are SI.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hal/device/drivers/simulated_hand.h"
#include "hal/device/drivers/steered.h"
#include "hal/guard/guard.h"
#include "hal/loop/coupling.h"
#include "hal/loop/grip.h"
#include "hal/loop/mapping.h"
#include "hal/loop/record.h"
#include "hal/score/score.h"
#include "stylet/kernel.h"

namespace stylet::hal {

struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Where the needle starts and where it goes: along `direction`, through a point of the organ.
struct Approach {
  Vec3 direction = {1, 0, 0};     // unit length
  std::optional<Vec3> through_m;  // none: the centroid of the organ's voxels
  float start_m = 0.01F;          // tip outside the surface
};

// Who holds a needle, where it starts, and what keeps the hand safe.
struct Hand {
  Approach approach;
  std::string device = "simulated";  // or "steered", "replay", "attached"
  std::string replay_path;           // device "replay"
  std::string uri;                   // device "attached": see devices.h
  DeviceModel model;                 // its numbers, or those of the scene's own keys
  DeviceInfo limits = {"simulated hand", 8, 2000, 0};
  GuardConfig guard;
  CouplingConfig coupling;
  GripConfig grip;
  SimulatedHandConfig hand;
  std::vector<Waypoint> waypoints;
  SteeringConfig steering;  // device "steered"; targets in the world
};

struct Scene {
  std::string file;
  std::string text;
  std::string organ_path;  // as written; relative to the scene's folder
  Config config;
  std::vector<ObstacleConfig> obstacles;
  std::vector<std::string> hulls;  // files of obstacles
  std::vector<Target> targets;     // for the score alone
  int rt_priority = 80;
  int cpu = -1;               // -1: the last isolated one, else the last the process may use
  std::uint32_t threads = 1;  // of the tissue step: the loop's, and the rest help it
  std::uint32_t hash_every_ticks = 1000;
  std::vector<Hand> hands = {Hand{}};  // of each needle
};

// The needle is held by the device of this URI, whatever the scene says.
void attach(Hand& hand, const std::string& uri);
// What an open device cannot do, the hand does not ask of it; and the guard's thresholds are those
// of the device that is there: the scene's count where they are stricter. What was taken from
// where, in words.
std::string fit_to_device(const DeviceInfo& info, Hand& hand);

// The first `held` needles will be held by devices (attach), whatever the scene says: their hands
// need no script.
Scene read_scene(const std::string& path, std::size_t held = 0);
// `file` is only for messages.
Scene parse_scene(std::string_view text, const std::string& file, std::size_t held = 0);
// Nothing but the targets of a scene, such as that of a recording, whose other files may be gone.
std::vector<Target> parse_targets(std::string_view text, const std::string& file);

// Start pose of a needle for an organ. Throws SceneError if the line misses the organ.
struct Placement {
  Course course;    // from the first point of the surface along the line
  Mapping mapping;  // device at rest = needle's base at the start; device -z = direction
};
Placement place_needle(const Scene& scene, const Organ& organ, std::uint32_t needle = 0);

}  // namespace stylet::hal
