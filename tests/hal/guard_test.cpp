// SPDX-License-Identifier: Apache-2.0
#include "hal/guard/guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>

#include "guard_desk.h"
#include "hal/guard/fault_mailbox.h"
#include "vectors.h"

namespace stylet::hal {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr Quat kUpright = {1, 0, 0, 0};
constexpr std::int64_t kMs = 1'000'000;

using test::minus;

// No ramp, so that a force comes through as it is.
GuardConfig plain() {
  return {1e-3F, 8, 2000, 0, 3e-3F};
}

Sample sample(std::uint64_t seq, std::int64_t t_ns = 0) {
  return {seq, t_ns, {{}, kUpright}, 0};
}

GuardState pushed_to(const GuardConfig& config, Vec3 force) {
  GuardState state = met(config);
  for (int i = 0; i < 100; ++i) (void)next_force(config, state, force);
  return state;
}

TEST(GuardForce, SmallForcesPassUnchanged) {
  GuardState state = met(plain());
  const Vec3 out = guard_force(plain(), state, {0.5F, -0.25F, 1});
  EXPECT_EQ(out.x, 0.5F);
  EXPECT_EQ(out.y, -0.25F);
  EXPECT_EQ(out.z, 1.0F);
  EXPECT_EQ(state.counters.force_limited, 0U);
  EXPECT_EQ(state.counters.slew_limited, 0U);
}

TEST(GuardForce, LargeForcesKeepTheirDirection) {
  const GuardConfig config = plain();
  const GuardState state = pushed_to(config, {30, -40, 0});
  EXPECT_NEAR(size(state.force_n), 8, 1e-5);
  EXPECT_NEAR(static_cast<double>(state.force_n.x), 4.8, 1e-5);
  EXPECT_NEAR(static_cast<double>(state.force_n.y), -6.4, 1e-5);
  EXPECT_EQ(state.counters.force_limited, 100U);
  EXPECT_EQ(state.counters.force_warm, 0U);
}

TEST(GuardForce, JumpsAreSpreadOverTicks) {
  const GuardConfig config = plain();
  GuardState state = met(config);
  for (int tick = 1; tick <= 4; ++tick) {
    EXPECT_NEAR(size(next_force(config, state, {0, 0, 7})), std::min(2 * tick, 7), 1e-5);
  }
  EXPECT_EQ(state.counters.slew_limited, 3U);
}

TEST(GuardForce, RampRisesToOneAndNotBefore) {
  GuardConfig config = plain();
  config.ramp_s = 0.1F;
  GuardState state = met(config);
  for (int tick = 1; tick <= 100; ++tick) {
    EXPECT_NEAR(size(next_force(config, state, {1, 0, 0})), tick / 100.0, 1e-6);
  }
  EXPECT_NEAR(size(next_force(config, state, {1, 0, 0})), 1, 1e-6);
}

TEST(GuardForce, NotANumberIsZeroAtOnceAndLatched) {
  for (const Vec3 bad : {Vec3{kNan, 0, 0}, Vec3{0, kInf, 0}, Vec3{0, 0, -kInf}}) {
    const GuardConfig config = plain();
    GuardState state = pushed_to(config, {5, 0, 0});
    EXPECT_EQ(size(next_force(config, state, bad)), 0);
    EXPECT_EQ(state.fault, Fault::kForceNotFinite);
    EXPECT_EQ(size(next_force(config, state, {5, 0, 0})), 0);
    EXPECT_EQ(state.counters.force_not_finite, 1U);
    EXPECT_EQ(state.counters.faults, 1U);
  }
}

TEST(GuardForce, NotANumberDuringAFadeEndsTheFade) {
  const GuardConfig config = plain();
  GuardState state = pushed_to(config, {5, 0, 0});
  guard_trip(state, Fault::kTooLate);
  EXPECT_GT(size(next_force(config, state, {5, 0, 0})), 4);
  EXPECT_EQ(size(next_force(config, state, {kNan, 0, 0})), 0);
  EXPECT_EQ(size(next_force(config, state, {5, 0, 0})), 0);
  EXPECT_EQ(state.fault, Fault::kTooLate);
}

TEST(GuardForce, FaultFadesStraightToZeroInTwentyMilliseconds) {
  const GuardConfig config = plain();
  GuardState state = pushed_to(config, {0, 8, 0});
  guard_trip(state, Fault::kTooLate);
  for (int tick = 1; tick <= 25; ++tick) {
    EXPECT_NEAR(size(next_force(config, state, {0, 8, 0})), std::max(0.0, 8 - 0.4 * tick), 1e-5);
  }
}

TEST(GuardForce, FadeEndsInTimeForEveryPeriod) {
  for (const float period_s : {1e-5F, 1e-4F, 2.5e-4F, 1e-3F, 7e-3F, 1e-2F}) {
    GuardConfig config = plain();
    config.period_s = period_s;
    GuardState state = pushed_to(config, {0.1F, 0, 0});
    guard_trip(state, Fault::kDeviceSilent);
    const auto ticks = static_cast<int>(0.02 / static_cast<double>(period_s) + 1e-3);
    Vec3 force{};
    for (int i = 0; i < ticks; ++i) force = next_force(config, state, {0.1F, 0, 0});
    EXPECT_EQ(size(force), 0) << period_s;
  }
}

// R5, whatever is asked. (A force ten times too large was once let in in a tenth of the time.)
TEST(GuardForce, TheRampIsThatOfTheLargestForceForAnyForceAsked) {
  GuardConfig config = plain();
  config.ramp_s = 0.1F;
  for (const float asked_n : {4.0F, 10.0F, 50.0F, 1e30F}) {
    GuardState state = met(config);
    for (int tick = 1; tick <= 100; ++tick) {
      const double most_n = std::min(8.0, static_cast<double>(asked_n)) * tick / 100;
      ASSERT_NEAR(size(next_force(config, state, {0, -asked_n, 0})), most_n, 1e-5) << asked_n;
    }
  }
}

// R15: the needle may wait far from the hand. The fade-in begins when the device has answered.
TEST(GuardForce, NothingIsFeltBeforeADeviceHasToldWhereItIs) {
  GuardConfig config = plain();
  config.ramp_s = 0.1F;
  config.passivity_damping_n_s_per_m = 5;
  GuardState state = guard_start(), torque = guard_start();
  std::int64_t now_ns = kMs;
  const auto tick = [&](bool answered, std::uint64_t seq) {
    (void)guard_sample(config, state, answered, sample(seq, now_ns), now_ns);
    now_ns += kMs;
    const double force_n = size(guard_force(config, state, {0, 7, 0}));
    return force_n + size(guard_torque(config, 0.1F, state, torque, {0, 0, 0.09F}));
  };
  for (int i = 0; i < 500; ++i) ASSERT_EQ(tick(false, 0), 0) << i;
  EXPECT_EQ(state.energy.energy_j, 0);
  for (int i = 1; i <= 100; ++i) {
    ASSERT_NEAR(tick(true, static_cast<std::uint64_t>(i)), 7.09 * i / 100, 1e-4) << i;
  }
  EXPECT_EQ(state.counters.rearms, 1U) << "of the silence, which nobody felt";
}

struct SampleCase {
  const char* name;
  Sample sample;
  bool usable;
  std::uint64_t GuardCounters::*counter;
};

TEST(GuardSample, TruthTable) {
  Sample nan_position = sample(6), inf_rotation = sample(6), far = sample(6), flat = sample(6);
  nan_position.pose.position_m.y = kNan;
  inf_rotation.pose.rotation.z = kInf;
  far.pose.position_m.x = 1e30F;
  flat.pose.rotation = {0, 0, 0, 0};
  const SampleCase cases[] = {
      {"next", sample(6), true, &GuardCounters::samples_used},
      {"repeat", sample(5), false, &GuardCounters::samples_repeated},
      {"older", sample(2), false, &GuardCounters::samples_repeated},
      {"gap", sample(9), true, &GuardCounters::samples_used},
      {"late", sample(6, -4 * kMs), false, &GuardCounters::samples_old},
      {"from a late tick's future", sample(6, 20 * kMs), true, &GuardCounters::samples_used},
      {"from the future", sample(6, 20 * kMs + 1), false, &GuardCounters::samples_old},
      {"as far as can be", sample(6, std::numeric_limits<std::int64_t>::max()), false,
       &GuardCounters::samples_old},
      {"NaN", nan_position, false, &GuardCounters::samples_not_finite},
      {"infinite", inf_rotation, false, &GuardCounters::samples_not_finite},
      {"1e30", far, false, &GuardCounters::samples_absurd},
      {"no rotation", flat, false, &GuardCounters::samples_absurd}};
  for (const SampleCase& each : cases) {
    GuardState state = guard_start();
    ASSERT_TRUE(guard_sample(plain(), state, true, sample(5), -kMs));
    const std::uint64_t before = state.counters.*each.counter;
    EXPECT_EQ(guard_sample(plain(), state, true, each.sample, 0), each.usable) << each.name;
    EXPECT_EQ(state.counters.*each.counter, before + 1) << each.name;
    EXPECT_EQ(state.fault, Fault::kNone) << each.name;
  }
}

TEST(GuardSample, GapsAreCounted) {
  GuardState state = guard_start();
  for (const std::int64_t seq : {5, 6, 9, 10, 15}) {
    const std::int64_t now_ns = seq * kMs;
    EXPECT_TRUE(guard_sample(plain(), state, true, sample(static_cast<std::uint64_t>(seq), now_ns),
                             now_ns));
  }
  EXPECT_EQ(state.counters.samples_lost, 2U + 4U);
}

// A device that sends every second tick: which tick is the watchdog's last must not choose the
// name.
TEST(GuardSample, TheNewestNewSampleNamesTheFaultWhateverTheLastTickWas) {
  struct Case {
    Refusal why;
    Fault fault;
    std::function<void(Sample&)> spoil;
  };
  const Case cases[] = {
      {Refusal::kNotFinite, Fault::kStaleSamples, [](Sample& s) { s.pose.position_m.x = kNan; }},
      {Refusal::kAbsurd, Fault::kStaleSamples, [](Sample& s) { s.pose.position_m.x = 11; }},
      {Refusal::kLate, Fault::kStaleSamples, [](Sample& s) { s.t_ns -= 50 * kMs; }},
      {Refusal::kJumped, Fault::kTooFast, [](Sample& s) { s.pose.position_m.x = 0.1F; }},
  };
  for (const Case& each : cases) {
    for (const int first : {1, 2}) {              // the ticks with something new are odd, or even
      for (const bool answers : {false, true}) {  // in the others it is silent, or repeats
        GuardState state = guard_start();
        ASSERT_TRUE(guard_sample(plain(), state, true, sample(1), 0));
        Sample newest = sample(1);
        for (int tick = 1; tick <= 3; ++tick) {
          const bool is_new = tick % 2 == first % 2;
          if (is_new) {
            newest = sample(static_cast<std::uint64_t>(tick) + 1, tick * kMs);
            each.spoil(newest);
          }
          EXPECT_FALSE(guard_sample(plain(), state, is_new || answers, newest, tick * kMs));
        }
        EXPECT_EQ(state.fault, each.fault) << refusal_name(each.why) << first << answers;
        EXPECT_EQ(state.refused.why, each.why) << first << answers;
        EXPECT_EQ(state.refused.allowed_ns, 3 * kMs);
        EXPECT_TRUE(each.why != Refusal::kLate || state.refused.for_ns == 50 * kMs);
        const FaultCause cause = cause_of(state);
        EXPECT_EQ(cause.why, each.why);
        EXPECT_EQ(cause.allowed_us, 3000);
        EXPECT_EQ(cause.clears_itself, each.fault == Fault::kStaleSamples);
      }
    }
  }
}

TEST(GuardSample, ARefusedSampleOfAnEarlierFaultNamesNoLaterOne) {
  GuardState state = guard_start();
  ASSERT_TRUE(guard_sample(plain(), state, true, sample(1), 0));
  state.forced = 1;
  Sample wrong = sample(2, kMs);
  wrong.pose.position_m.x = kNan;
  EXPECT_FALSE(guard_sample(plain(), state, true, wrong, kMs));
  for (int tick = 2; tick <= 3; ++tick) {
    EXPECT_FALSE(guard_sample(plain(), state, false, {}, tick * kMs));
  }
  ASSERT_EQ(state.fault, Fault::kStaleSamples);
  EXPECT_TRUE(guard_sample(plain(), state, true, sample(9, 4 * kMs), 4 * kMs));
  EXPECT_EQ(state.refused.why, Refusal::kNotFinite) << "it can still be read";
  ASSERT_TRUE(guard_rearm(state, Fault::kStaleSamples));
  for (int tick = 5; tick <= 7; ++tick) {
    EXPECT_FALSE(guard_sample(plain(), state, false, {}, tick * kMs));
  }
  EXPECT_EQ(state.fault, Fault::kDeviceSilent);
}

// Motors that stop because their driver failed have not expired: the cable is what to look at.
TEST(GuardSample, MotorsOfAFailedDeviceAreCalledSilent) {
  for (const bool failed : {false, true}) {
    GuardState state = guard_start();
    ASSERT_TRUE(guard_sample(plain(), state, true, sample(1), 0));
    guard_motor(state, {.arming = state.arming, .stopped = true, .failed = failed});
    EXPECT_EQ(state.fault, failed ? Fault::kDeviceSilent : Fault::kForceExpired);
  }
}

TEST(GuardSample, WatchdogNamesWhatIsWrong) {
  for (const bool answered : {false, true}) {
    GuardState state = guard_start();
    ASSERT_TRUE(guard_sample(plain(), state, true, sample(1), 0));
    for (int tick = 1; tick <= 3; ++tick) {
      EXPECT_EQ(state.fault, Fault::kNone);
      EXPECT_FALSE(guard_sample(plain(), state, answered, sample(1), tick * kMs));
    }
    EXPECT_EQ(state.fault, answered ? Fault::kStaleSamples : Fault::kDeviceSilent);
    EXPECT_EQ(state.counters.samples_missing, answered ? 0U : 3U);
  }
}

TEST(GuardSample, OneGoodSampleSatisfiesTheWatchdog) {
  GuardState state = guard_start();
  for (std::int64_t i = 1; i < 100; ++i) {
    const Sample now = sample(static_cast<std::uint64_t>(i), i * kMs);
    EXPECT_EQ(guard_sample(plain(), state, i % 3 == 0, now, i * kMs), i % 3 == 0);
  }
  EXPECT_EQ(state.fault, Fault::kNone);
}

// If samples jump, nobody knows where the hand is, even if every second one is usable.
TEST(GuardSample, JumpsToAndFroAreSoonAFault) {
  std::mt19937 engine(11);
  for (int round = 0; round < 200; ++round) {
    GuardState state = guard_start();
    const auto run = static_cast<int>(1 + engine() % 14);  // usable ones between two that jump
    const float way_m = 0.02F + 1e-3F * static_cast<float>(engine() % 200);
    int tick = 0;
    for (; tick < 5000 && state.fault == Fault::kNone; ++tick) {
      const bool away = tick % (run + 1) == run;
      Sample s = sample(static_cast<std::uint64_t>(tick + 1), (tick + 1) * kMs);
      s.pose.position_m.y = away ? way_m : 0;
      (void)guard_sample(plain(), state, true, s, (tick + 1) * kMs);
    }
    // A jump is made up for by the time of ten usable samples: with so many between jumps nothing
    // adds up.
    EXPECT_EQ(state.fault, run < 10 ? Fault::kTooFast : Fault::kNone) << run;
    if (run < 10) {
      // After k rounds, the sum of k - 1 of these and the jump of the last round is more than 20
      // ms.
      EXPECT_NEAR(tick, (19 / (1 - 0.1 * run) + 1.5) * (run + 1), run + 1) << run;
    }
  }
}

TEST(GuardRearm, OnlyByNameAndOnlyAtZero) {
  GuardConfig config = plain();
  config.ramp_s = 0.1F;
  GuardState state = pushed_to(config, {5, 0, 0});
  EXPECT_FALSE(guard_rearm(state, Fault::kNone));
  guard_trip(state, Fault::kStaleSamples);
  guard_trip(state, Fault::kTooLate);  // the first one stays
  EXPECT_FALSE(guard_rearm(state, Fault::kStaleSamples));
  for (int i = 0; i < 20; ++i) (void)next_force(config, state, {5, 0, 0});
  EXPECT_FALSE(guard_rearm(state, Fault::kTooLate));
  EXPECT_TRUE(guard_rearm(state, Fault::kStaleSamples));
  EXPECT_NEAR(size(next_force(config, state, {5, 0, 0})), 0.05, 1e-6);
  EXPECT_EQ(state.counters.rearms, 1U);
}

TEST(GuardSample, BoundsOfAPlausiblePose) {
  const auto usable = [](Vec3 position_m, float w) {
    GuardState state = guard_start();
    Sample s = sample(1);
    s.pose = {position_m, {w, 0, 0, 0}};
    return guard_sample(plain(), state, true, s, 0);
  };
  EXPECT_TRUE(usable({0, 10, 0}, 1));
  EXPECT_FALSE(usable({0, 10.001F, 0}, 1));
  EXPECT_TRUE(usable({}, std::sqrt(1.09F)));
  EXPECT_FALSE(usable({}, std::sqrt(1.11F)));
  EXPECT_TRUE(usable({}, std::sqrt(0.91F)));
  EXPECT_FALSE(usable({}, std::sqrt(0.89F)));
}

TEST(GuardSample, BlindTicksDoNotStartAgainAfterMonths) {
  GuardState state = guard_start();
  state.blind_ns = 1'000'000'000'000;
  EXPECT_FALSE(guard_sample(plain(), state, false, sample(1), 0));
  EXPECT_EQ(state.blind_ns, 1'000'000'000'000);
}

TEST(GuardForce, AForceAtItsLimitIsNotCountedAsLimited) {
  const GuardState at_most = pushed_to(plain(), {0, 0, 8});
  EXPECT_EQ(at_most.force_n.z, 8.0F);
  EXPECT_EQ(at_most.counters.force_limited, 0U);
  GuardConfig exact = plain();
  exact.period_s = 0x1p-10F;
  exact.max_slew_n_per_s = 0x1p10F;  // 1 N in a tick
  GuardState state = met(exact);
  EXPECT_EQ(next_force(exact, state, {1, 0, 0}).x, 1.0F);
  EXPECT_EQ(state.counters.slew_limited, 0U);
}

TEST(GuardRearm, TheWatchdogStartsAgain) {
  GuardState state = met(plain());
  guard_trip(state, Fault::kDeviceSilent);
  ASSERT_TRUE(guard_rearm(state, Fault::kDeviceSilent));
  for (int tick = 1; tick <= 3; ++tick) {
    EXPECT_EQ(state.fault, Fault::kNone) << tick;
    EXPECT_FALSE(guard_sample(plain(), state, false, sample(1), tick * kMs));
  }
  EXPECT_EQ(state.fault, Fault::kDeviceSilent);
}

TEST(GuardRearm, NotWhileTheDeviceIsSilent) {
  GuardState state = met(plain());
  (void)next_force(plain(), state, {1, 0, 0});  // after a force that was felt
  std::int64_t now_ns = state.now_ns;
  const auto hear = [&](bool answered) {
    now_ns += kMs;
    return guard_sample(plain(), state, answered, sample(state.seq + 1, now_ns), now_ns);
  };
  for (int i = 0; i < 25; ++i) {
    EXPECT_FALSE(hear(false));
    (void)guard_force(plain(), state, {});
  }
  ASSERT_EQ(state.fault, Fault::kDeviceSilent);
  EXPECT_FALSE(guard_rearm(state, Fault::kDeviceSilent));
  EXPECT_TRUE(hear(true));
  EXPECT_FALSE(hear(false));  // it answered once
  EXPECT_FALSE(guard_rearm(state, Fault::kDeviceSilent));
  EXPECT_TRUE(hear(true));
  EXPECT_TRUE(guard_rearm(state, Fault::kDeviceSilent));
}

// Forces and samples are any bits: what comes out keeps every promise.
TEST(Guard, HoldsItsPromisesForAnyBits) {
  std::mt19937 engine(7);
  const auto random = [&engine] { return static_cast<std::uint32_t>(engine()); };
  GuardConfig config = plain();
  config.ramp_s = 0.05F;
  const auto any_float = [&random] {
    const std::uint32_t bits = random();
    float value;
    static_assert(sizeof value == sizeof bits);
    __builtin_memcpy(&value, &bits, sizeof value);
    return value;
  };
  GuardState state = guard_start();
  Vec3 last{};
  std::int64_t now_ns = 0;
  for (int i = 0; i < 200'000; ++i) {
    const std::int64_t passed_ms = random() % 256 != 0 ? 1 : random() % 64;
    now_ns += passed_ms * kMs;
    Sample s = {random() % 1000, static_cast<std::int64_t>(random()), {}, random()};
    s.pose = {{any_float(), any_float(), any_float()},
              {any_float(), any_float(), any_float(), any_float()}};
    (void)guard_sample(config, state, random() % 4 != 0,
                       random() % 2 != 0 ? sample(random(), now_ns) : s, now_ns);
    const bool mild = random() % 8 != 0;
    const Vec3 wanted = mild ? Vec3{static_cast<float>(random() % 20) - 10, 3, -4}
                             : Vec3{any_float(), any_float(), any_float()};
    const bool number =
        std::isfinite(wanted.x) && std::isfinite(wanted.y) && std::isfinite(wanted.z);
    const Vec3 force = guard_force(config, state, wanted);
    ASSERT_TRUE(std::isfinite(size(force)));
    ASSERT_LE(size(force), 8 * (1 + 1e-6));
    if (number) {
      ASSERT_LE(size(minus(force, last)),
                2 * static_cast<double>(std::max<std::int64_t>(passed_ms, 1)) * (1 + 3e-5));
    }
    last = force;
    if (i % 64 != 0) continue;
    now_ns += kMs;
    (void)guard_sample(config, state, true, sample(state.seq + 1, now_ns), now_ns);
    (void)guard_rearm(state, state.fault);
    if (state.seq > 1U << 31) state.have_seq = 0;  // otherwise no number would be new any more
  }
  EXPECT_GT(state.counters.faults, 100U);
  EXPECT_GT(state.counters.force_limited, 100U);
}

}  // namespace
}  // namespace stylet::hal
