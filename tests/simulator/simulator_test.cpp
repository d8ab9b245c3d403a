// SPDX-License-Identifier: Apache-2.0
// The simulator notices what it is made for: each promise is broken once, from inside.
#include "simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "set_speed.h"
#include "state/layout.h"

namespace stylet::test {
namespace {

constexpr std::uint64_t kSeed = 6;  // a session that reaches the tissue

std::string verdict_of(const Tamper& tamper) {
  const Verdict verdict = simulate(draw_scenario(kSeed), tamper);
  return verdict.broken != nullptr ? verdict.broken : "held";
}

State state_of(Kernel& kernel) {
  return view_of(kernel).state;
}

TEST(Simulator, SameSeedSameSession) {
  const Verdict a = simulate(draw_scenario(kSeed)), b = simulate(draw_scenario(kSeed));
  EXPECT_EQ(a.broken, nullptr) << a.broken;
  EXPECT_EQ(a.ticks, b.ticks);
  EXPECT_EQ(a.observer_min_j, b.observer_min_j);
  EXPECT_EQ(a.busiest_tick, b.busiest_tick);
  EXPECT_GT(a.busiest_load, 3U) << "the needle goes in";
}

// The last particle that can move.
std::uint32_t moving(Kernel& kernel) {
  View view = view_of(kernel);
  std::uint32_t i = view.model.head->counts.particles;
  while (!(view.model.step_per_mass[i - 1] > 0)) --i;
  return i - 1;
}

TEST(Simulator, SeesTissueThatIsNotFinite) {
  EXPECT_EQ(verdict_of([](Kernel& kernel, std::uint64_t tick) {
              const float nan = std::numeric_limits<float>::quiet_NaN();
              if (tick == 500) state_of(kernel).ux[moving(kernel)] = nan;
            }),
            "more energy comes out of the tissue than went in");
}

TEST(Simulator, SeesAForceThatIsNotTheSumOfItsParticles) {
  EXPECT_EQ(verdict_of([](Kernel& kernel, std::uint64_t) {
              State state = state_of(kernel);
              if (state.needle->shaft_count > 2) state.shaft[1].force_n.y += 1e-4F;
            }),
            "force is not the sum over its particles");
}

TEST(Simulator, SeesEnergyFromNowhere) {
  EXPECT_EQ(verdict_of([](Kernel& kernel, std::uint64_t tick) {
              View view = view_of(kernel);
              if (tick != 300) return;
              for (std::uint32_t i = 0; i < view.model.head->counts.particles; ++i) {
                if (view.model.step_per_mass[i] > 0) set_speed(view, i, {0.5F, 0, 0});
              }
            }),
            "more energy comes out of the tissue than went in");
}

TEST(Simulator, SeesAPoolThatIsTooFull) {
  EXPECT_EQ(verdict_of([](Kernel& kernel, std::uint64_t tick) {
              if (tick == 100) state_of(kernel).head->coupled_max = 1U << 30U;
            }),
            "a pool held more than there is room for");
}

TEST(Simulator, SeesTissueThatDoesNotComeToRest) {
  EXPECT_EQ(verdict_of(
                [](Kernel& kernel, std::uint64_t) { state_of(kernel).ux[moving(kernel)] = 5e-6F; }),
            "the tissue does not come back to rest");
}

TEST(Simulator, SeesALatchedFault) {
  EXPECT_EQ(verdict_of([](Kernel& kernel, std::uint64_t tick) {
              if (tick == 200) ++state_of(kernel).head->fault_count;
            }),
            "the kernel latched a fault");
}

}  // namespace
}  // namespace stylet::test
