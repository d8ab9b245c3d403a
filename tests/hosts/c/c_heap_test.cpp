// SPDX-License-Identifier: Apache-2.0
// A simulation of the C interface does not use the heap after its creation.
#include "allocation_trap.h"
#include "c_support.h"

namespace stylet::test {
namespace {

TEST(CSimulation, TicksDoNotAllocate) {
  const auto opened = block_organ(4, 4, 4);
  const OrganHandle organ = c_organ(*opened);
  Draw draw(6);
  const DrawnConfig config = drawn_config(draw);
  const SimulationHandle simulation = c_simulation(organ.get(), config);
  const std::uint32_t needles = config.cpp.needle_count;
  std::vector<std::vector<stylet_input>> inputs(1000);
  for (std::uint64_t i = 0; i < inputs.size(); ++i) {
    for (const Input& each : inputs_at(opened->organ, config.cpp, i)) {
      inputs[i].push_back(test::to_c(each));
    }
  }
  std::array<stylet_output, kMaxNeedles> out = {};
  out[0].struct_bytes = sizeof out[0];
  std::vector<stylet_vec3> places(opened->organ.vertices.size());
  arm_allocation_trap();
  stylet_simulation* copy = nullptr;
  (void)stylet_simulation_clone(simulation.get(), &copy);
  EXPECT_GT(disarm_allocation_trap(), 0U);  // the trap sees requests of the library
  stylet_simulation_free(copy);
  arm_allocation_trap();
  for (const auto& each : inputs) {
    (void)stylet_simulation_tick(simulation.get(), each.data(), needles, out.data(), needles);
    (void)stylet_simulation_surface(simulation.get(), places.data(),
                                    static_cast<std::uint32_t>(places.size()));
  }
  (void)stylet_simulation_reset(simulation.get());
  const std::uint64_t calls = disarm_allocation_trap();
  EXPECT_EQ(calls, 0U);
}

}  // namespace
}  // namespace stylet::test
