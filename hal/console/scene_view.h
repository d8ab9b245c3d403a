// SPDX-License-Identifier: Apache-2.0
// What a console shows: one scene with its organ, needles and lattice; and what a page may ask for.
// Plain data between the session, which decides what runs, and the server.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/loop/display.h"
#include "hal/loop/record.h"
#include "hal/record/organ_file.h"
#include "hal/score/score.h"

namespace stylet::console {

// The particles that voxels consist of, counted in the order in which voxels name them first.
struct Lattice {
  std::vector<stylet::Vec3> rest_m;
  std::vector<std::uint32_t> corners;    // 8 for each voxel
  std::vector<std::uint32_t> of_kernel;  // number of each in the kernel
};
Lattice make_lattice(const Organ& organ, const Kernel& kernel);

struct ShownNeedle {
  std::string device;
  float length_m = 0, outer_radius_m = 0;
  hal::Course course = {};
  float max_force_n = 0;
};

struct SceneView {
  std::string scene;                // its name, without folders
  std::vector<std::string> scenes;  // to choose from
  float period_s = 0;
  std::uint64_t recording_ticks = 0;  // 0: live, not a recording
  std::shared_ptr<const hal::OrganFile> organ;
  Lattice lattice;
  std::vector<ShownNeedle> needles;
  std::vector<ObstacleConfig> obstacles;
  std::vector<hal::Target> targets;
  std::shared_ptr<hal::Display> display;
};

// The results of an attempt.
struct ScoredAttempt {
  std::uint32_t attempt = 0;
  std::string trainee, began, recording;  // who, when (ISO 8601), file name without folders
  hal::Score score;
};

enum class Verb {
  kStart,
  kPause,
  kResume,
  kReset,
  kEnd,
  kChoose,
  kSeek,
  kPlay,
  kMark,
  kAcknowledge,
};

struct Order {
  Verb verb;
  std::string text = {};  // trainee, scene, mark or fault
  std::uint64_t tick = 0;
  float speed = 0;
  std::uint32_t needle = 0;
  std::uint32_t fault_number = 0;
  std::int64_t seen_ns = 0;  // time of the frame that showed the fault
};

}  // namespace stylet::console
