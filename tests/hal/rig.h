// SPDX-License-Identifier: Apache-2.0
// A loop with everything around it: a stiff little block, held at its far side, a needle that
// starts at its surface, the simulated hand, and the rings.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "hal/device/drivers/simulated_hand.h"
#include "hal/loop/instance.h"
#include "hal/loop/loop.h"
#include "hal/scene/scene.h"
#include "tiny_organ.h"

namespace stylet::hal {

struct Rig {
  std::vector<std::byte> bytes;
  Organ organ;
  Scene scene;
  std::unique_ptr<KernelInstance> instance;
  SimulatedHand hand;
  LoopConfig config;
  LoopState state;
  Ring<TickRecord> records{4096};
  Ring<Event> events{64};
  std::unique_ptr<Display> display;
  VirtualTime time;

  Rig() {
    test::TinyOrgan tiny;
    tiny.nx = tiny.ny = tiny.nz = 4;
    tiny.fixed_faces = test::kHighX;
    tiny.materials[0].youngs_modulus_pa = 20000;
    tiny.materials[0].puncture_force_n = 0.2F;
    bytes = test::tiny_organ(tiny);
    EXPECT_EQ(organ_open(bytes, organ), Status::kOk);
    scene.hands[0].approach.start_m = 0.001F;
    scene.hands[0].guard.ramp_s = 0;
    scene.hands[0].guard.max_force_n = 2;
    scene.hands[0].guard.max_slew_n_per_s = 200;
    scene.hands[0].waypoints = {
        Waypoint{.travel_m = 0.018F, .speed_m_per_s = 0.1F, .hold_s = 0.05F}};
    const Placement placement = place_needle(scene, organ);
    instance = std::make_unique<KernelInstance>(organ, scene.config);
    display = std::make_unique<Display>(instance->kernel);
    config.hand[0].mapping = placement.mapping;
    config.hand[0].guard = scene.hands[0].guard;
    hand.script = make_script(scene.hands[0].waypoints, scene.hands[0].approach.start_m);
    config.ticks = script_ticks(hand.script, 1e-3);
  }

  std::vector<TickRecord> run(const Device& device) {
    run_loop(config, instance->kernel, std::span(&device, 1), virtual_clock(time),
             {&records, &events, display.get()}, state);
    std::vector<TickRecord> all;
    for (TickRecord record; records.pop(record);) all.push_back(record);
    return all;
  }

  Device device() { return simulated_hand_device(hand, scene.hands[0].limits); }
};

}  // namespace stylet::hal
