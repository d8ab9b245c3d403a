// SPDX-License-Identifier: Apache-2.0
// A whole random session, given by a seed: organ, materials, needles, obstacles, breathing, hands
// and what goes wrong with their devices.
//
// Promise: the same seed gives the same scenario. Ranges are wider than those of any anatomy or
// needle, but organ_open, create and the scene reader accept all of them.
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
  double bad_share = 0;      // fraction of samples that are spoiled
  double release_share = 0;  // fraction of samples that release the dead man's button
  double dead_from_s = 1e9;  // the device is silent from here on
};

// Largest speeds of a gentle hand: a person who takes care.
constexpr double kGentleMPerS = 0.02;

struct Scenario {
  std::uint64_t seed = 0;
  bool gentle = false;  // hands that move slowly and devices that work
  std::unique_ptr<OpenOrgan> organ;
  Config config;
  std::vector<ObstacleConfig> obstacles;
  std::vector<HandPlan> hands;
  double late_share = 0;  // fraction of ticks for which the loop wakes up too late
  std::uint64_t ticks = 0;
};

// What a session has besides: tissues that stiffen with their strain; tissues whose forces follow
// from a toughness, and which are cut sideways; membranes across the layers; parts that slide.
struct Further {
  bool stiffening = false, toughness = false, membranes = false, sliding = false;
};
Scenario draw_scenario(std::uint64_t seed, Further further = {});
// What a hand does on purpose: every needle goes in, rests, moves sideways and back, goes deeper
// (more often than not towards bone) and comes out.
Scenario draw_procedure(std::uint64_t seed, Further further = {});

}  // namespace stylet::test
