// SPDX-License-Identifier: Apache-2.0
// The loop in another program: the simulated hand, or the device of a URI, pushes a needle 8 mm
// into an organ, with the guard between it and the tissue. Links stylet_hal and nothing else.
#include "hal/loop/loop.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include "hal/base/clock.h"
#include "hal/device/devices.h"
#include "hal/device/drivers/simulated_hand.h"
#include "hal/guard/guard.h"
#include "hal/loop/instance.h"

namespace hal = stylet::hal;
int main(int argc, char** argv) try {
  std::ifstream file(argc > 1 ? argv[1] : "", std::ios::binary);
  const std::vector<char> text((std::istreambuf_iterator<char>(file)), {});
  stylet::Organ organ;
  if (organ_open(std::as_bytes(std::span(text)), organ) != stylet::Status::kOk) {
    return std::fprintf(stderr, "usage: stylet_example_loop ORGAN [URI]\n"), 1;
  }
  hal::KernelInstance instance(organ, stylet::Config{});  // the organ's bytes must outlive it

  // Straight down through the middle of the lattice: the tip starts 1 mm above the skin.
  stylet::Vec3 at{organ.origin_m.x + organ.voxel_edge_m * organ.size_x / 2,
                  organ.origin_m.y + organ.voxel_edge_m * organ.size_y / 2, organ.origin_m.z + 1};
  float to_skin = 1;
  (void)organ_raycast(organ, at, {0, 0, -1}, to_skin);
  at.z += 1e-3F + stylet::NeedleConfig{}.length_m - to_skin;

  hal::SimulatedHand hand;
  hand.script = hal::make_script({{.travel_m = 8e-3F, .speed_m_per_s = 0.02F}}, 1e-3F);
  const hal::Device device = argc > 2 ? hal::open_device(argv[2])
                                      : hal::simulated_hand_device(hand, {"a hand", 3.3F, 2000});

  hal::LoopConfig config;
  config.ticks = script_ticks(hand.script, 1e-3);
  config.hand[0].mapping.origin_m = at;
  config.hand[0].guard.max_force_n = device.info.max_force_n;
  hal::VirtualTime time;  // use monotonic_clock() for a real device
  hal::Ring<hal::TickRecord> records(config.ticks);
  static hal::LoopState state;
  run_loop(config, instance.kernel, std::span(&device, 1), virtual_clock(time),
           {.records = &records}, state);
  if (device.close != nullptr) device.close(device.self);

  float most_n = 0;
  for (hal::TickRecord each; records.pop(each);) most_n = std::max(most_n, each.command_n.z);
  std::printf("%s: %zu ticks, at most %.3f N on the hand, %s\n", device.info.name,
              static_cast<std::size_t>(state.ticks), static_cast<double>(most_n),
              hal::fault_name(state.hand[0].guard.fault));
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
