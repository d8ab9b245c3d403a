// SPDX-License-Identifier: Apache-2.0
// A scene: one TOML file that says what is simulated. hal/scene/README.md lists every key.
//
// Promise: an unknown key, a wrong type, a missing or impossible value throws SceneError with one
// line "file:line: key: value: what is allowed". May allocate; never called from the loop.
// Units: those of the file are in its keys, those of the struct are SI.
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

// Where the needle starts and where it goes: along `direction`, through a point in the organ.
struct Approach {
  Vec3 direction = {1, 0, 0};     // unit length
  std::optional<Vec3> through_m;  // nullopt: the centroid of the organ's voxels
  float start_m = 0.01F;          // distance of the tip from the surface
};

// What holds a needle, where the needle starts, and what keeps the hand safe.
struct Hand {
  Approach approach;
  std::string device = "simulated";  // or "steered", "replay", "attached"
  std::string replay_path;           // for device "replay"
  std::string uri;                   // for device "attached": see devices.h
  DeviceModel model;                 // numbers that the scene gives replace the model's
  DeviceInfo limits = {"simulated hand", 8, 2000, 0};
  GuardConfig guard;
  CouplingConfig coupling;
  GripConfig grip;
  SimulatedHandConfig hand;
  std::vector<Waypoint> waypoints;
  SteeringConfig steering;  // for device "steered"; targets in the world
};

struct Scene {
  std::string file;
  std::string text;
  std::string organ_path;  // as written; relative to the scene's folder
  Config config;
  std::vector<ObstacleConfig> obstacles;
  std::vector<std::string> hulls;  // files of obstacles
  std::vector<Target> targets;     // only for the score
  int rt_priority = 80;
  int cpu = -1;               // -1: the last isolated one, or else the last that is allowed
  std::uint32_t threads = 1;  // of the tissue step: the loop's thread and its helpers
  std::uint32_t hash_every_ticks = 1000;
  std::vector<Hand> hands = {Hand{}};  // one for each needle
};

// Makes the device of this URI hold the needle, whatever the scene says.
void attach(Hand& hand, const std::string& uri);
// Reduces what the hand asks of an open device to what the device can do. Each threshold of the
// guard becomes the stricter of the device's and the scene's. Returns a text that says which number
// was used and where it came from: scene, device, or both if they have the same.
std::string fit_to_device(const DeviceInfo& info, Hand& hand);

// Devices will hold the first `held` needles (attach), whatever the scene says, so the hands of
// these needles need no script.
Scene read_scene(const std::string& path, std::size_t held = 0);
// `file` is only for messages.
Scene parse_scene(std::string_view text, const std::string& file, std::size_t held = 0);
// Reads only the targets of a scene. Other files of the scene, such as its organ, may be missing.
std::vector<Target> parse_targets(std::string_view text, const std::string& file);

// Start pose of a needle at an organ. place_needle throws SceneError if the line misses the organ.
struct Placement {
  Course course;    // from where the line first meets the surface
  Mapping mapping;  // device at rest = needle's base at the start; device -z = direction
};
Placement place_needle(const Scene& scene, const Organ& organ, std::uint32_t needle = 0);

}  // namespace stylet::hal
