// SPDX-License-Identifier: Apache-2.0
// A whole session drawn from a seed: organ, materials, needles, obstacles, breathing, hands and
// what goes wrong with their devices.
//
// Promise: the same seed gives the same scenario. Ranges are wider than any anatomy or needle, but
// each is one that organ_open, create and the scene reader accept.
// Units: SI. Frame: world; needles come from +z.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "draw.h"
#include "hal/device/drivers/simulated_hand.h"
#include "hal/guard/guard.h"
#include "hal/loop/mapping.h"
#include "session.h"

namespace stylet::test {

// A hand and its device.
struct HandPlan {
  hal::Mapping mapping;
  hal::GuardConfig guard;
  hal::DeviceInfo limits;
  hal::SimulatedHandConfig hand;
  std::vector<hal::Waypoint> waypoints;
  float start_m = 0;         // tip outside the surface
  Vec3 turn_per_s = {};      // of the handle, as the vector part of a quaternion
  double bad_share = 0;      // of samples that are spoiled
  double release_share = 0;  // of samples in which the dead man's button is released, if held
  double dead_from_s = 1e9;  // the device is silent from here on
};

// The fastest of a gentle hand: a person who takes care.
constexpr double kGentleMPerS = 0.02;

struct Scenario {
  std::uint64_t seed = 0;
  bool gentle = false;  // hands that move slowly and devices that work
  std::unique_ptr<OpenOrgan> organ;
  Config config;
  std::vector<ObstacleConfig> obstacles;
  std::vector<HandPlan> hands;
  double late_share = 0;  // of ticks that the loop wakes up too late for
  std::uint64_t ticks = 0;
};

// `stiffening`: of tissues that stiffen with their strain.
Scenario draw_scenario(std::uint64_t seed, bool stiffening = false);
// What a hand does on purpose: every needle goes in, rests, moves sideways and back, goes deeper,
// more often than not towards bone on its way, and comes out.
Scenario draw_procedure(std::uint64_t seed, bool stiffening = false);

}  // namespace stylet::test
