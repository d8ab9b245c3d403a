// SPDX-License-Identifier: Apache-2.0
// The device fails for good, in every way it can, at every tick of an insertion: 25 ms of virtual
// time later the force is zero, on the way it only falls, and the fault has the right name.
//
// One good session is advanced tick by tick. Before each tick everything is copied, the copy has
// the fault, and the session goes on from where it was.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "rig.h"
#include "vectors.h"

namespace stylet::hal {
namespace {

constexpr double kZeroForceS = 25e-3;

using test::size;

// What the loop sees from the tick of the fault onwards. `good` is the sample that the device would
// have given.
struct Failure {
  const char* name;
  Fault latched;
  std::function<bool(const Sample& last, Sample& good)> spoil;  // false: no answer
};

Failure bad_number(const char* name, int field, float value) {
  return {name, Fault::kStaleSamples, [field, value](const Sample&, Sample& good) {
            float* fields[] = {&good.pose.position_m.x, &good.pose.position_m.y,
                               &good.pose.position_m.z, &good.pose.rotation.w,
                               &good.pose.rotation.x,   &good.pose.rotation.y,
                               &good.pose.rotation.z};
            *fields[field] = value;
            return true;
          }};
}

std::vector<Failure> failures() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  std::vector<Failure> all = {
      {"silent", Fault::kDeviceSilent, [](const Sample&, Sample&) { return false; }},
      {"stuck", Fault::kStaleSamples,
       [](const Sample& last, Sample& good) {
         good = last;
         return true;
       }},
      {"stuck sequence", Fault::kStaleSamples,
       [](const Sample& last, Sample& good) {
         good.seq = last.seq;
         return true;
       }},
      {"sequence from zero", Fault::kStaleSamples,
       [](const Sample&, Sample& good) {
         good.seq = 0;
         return true;
       }},
      {"late", Fault::kStaleSamples,
       [](const Sample&, Sample& good) {
         good.t_ns -= 100'000'000;
         return true;
       }},
      {"no rotation", Fault::kStaleSamples,
       [](const Sample&, Sample& good) {
         good.pose.rotation = {0, 0, 0, 0};
         return true;
       }},
  };
  all.push_back({"jump that stays", Fault::kTooFast, [](const Sample&, Sample& good) {
                   good.pose.position_m.x += 0.3F;
                   return true;
                 }});
  all.push_back({"runs away at 6 m/s", Fault::kTooFast, [](const Sample& last, Sample& good) {
                   good.pose.position_m.z += 6e-9F * static_cast<float>(good.t_ns - last.t_ns);
                   return true;
                 }});
  // Not a fault, but to be answered as fast: the hand releases the dead man's button.
  all.push_back({"button released", Fault::kNone, [](const Sample&, Sample& good) {
                   good.buttons = 0;
                   return true;
                 }});
  for (int field = 0; field < 7; ++field) all.push_back(bad_number("NaN", field, kNan));
  all.push_back(bad_number("infinite", 2, -kInf));
  all.push_back(bad_number("1e30", 0, 1e30F));
  return all;
}

// The simulated hand until the fault; from then on the failure.
struct FailingDevice {
  SimulatedHand* hand;
  const Failure* failure = nullptr;  // none yet
  Sample last = {};
  Vec3 written = {};
};

bool read_failing(void* self, std::int64_t now_ns, Sample& sample_out) {
  FailingDevice& device = *static_cast<FailingDevice*>(self);
  const Device hand = simulated_hand_device(*device.hand, {});
  Sample sample = {};
  if (!hand.read(hand.self, now_ns, sample)) return false;
  sample.buttons = sample.seq > 1 ? 1 : 0;  // seen released, then held
  if (device.failure != nullptr && !device.failure->spoil(device.last, sample)) return false;
  if (device.failure == nullptr) device.last = sample;
  sample_out = sample;
  return true;
}

void write_failing(void* self, const Command& command) {
  FailingDevice& device = *static_cast<FailingDevice*>(self);
  device.written = command.force_n;
}

// One tick of the loop on the state of a hand; returns the force sent.
struct Stepper {
  Rig& rig;
  FailingDevice device;

  TickRecord step(HandState& hand) {
    LoopState state;
    state.hand[0] = hand;
    LoopConfig config = rig.config;
    config.ticks = 1;
    config.lets_go = false;
    const Device one = {&device, rig.scene.hands[0].limits, read_failing, write_failing,
                        [](void*) {}};
    run_loop(config, rig.instance->kernel, std::span(&one, 1), virtual_clock(rig.time),
             {&rig.records}, state);
    hand = state.hand[0];
    TickRecord record = {};
    EXPECT_TRUE(rig.records.pop(record));
    return record;
  }
};

// A session as it is before a tick.
struct Moment {
  std::vector<std::byte> kernel;
  SimulatedHand hand;
  HandState state;
  VirtualTime time;
  FailingDevice device;
};

// Fails the device and follows the force down.
void expect_zero_in_time(Stepper& stepper, HandState hand, const Failure& failure,
                         std::uint64_t at) {
  const double period_s = static_cast<double>(stepper.rig.config.hand[0].guard.period_s);
  const auto most = static_cast<int>(kZeroForceS / period_s + 1e-6);
  stepper.device.failure = &failure;
  double before = std::numeric_limits<double>::infinity();
  for (int tick = 1; tick <= most + 5; ++tick) {
    const TickRecord record = stepper.step(hand);
    const double force = size(record.command_n);
    ASSERT_TRUE(std::isfinite(force)) << failure.name << " at " << at;
    if (record.mode != GuardMode::kRamp && record.mode != GuardMode::kLive) {
      ASSERT_LE(force, before) << failure.name << " at " << at << ", tick " << tick;
      before = force;
    }
    if (tick < most) continue;
    ASSERT_EQ(force, 0) << failure.name << " at " << at << ", tick " << tick;
  }
  ASSERT_EQ(hand.guard.fault, failure.latched) << failure.name << " at " << at;
  const std::uint64_t faults = failure.latched == Fault::kNone ? 0 : 1;
  ASSERT_EQ(hand.guard.counters.faults, faults) << failure.name << " at " << at;
}

// The slowest watchdog that a scene may ask for, a button, motors that get warm, and a device whose
// energy is observed.
GuardConfig all_nets(GuardConfig guard, float period_s) {
  guard.period_s = period_s;
  guard.watchdog_s = 5e-3F;
  guard.dead_man_button = 0;
  guard.continuous_force_n = 0.1F;
  guard.thermal_s = 1;
  guard.passivity_damping_n_s_per_m = 2;
  return guard;
}

// Each failure at every tick of the session, or at every `stride`-th.
void fail_everywhere(float period_s, std::uint64_t stride) {
  Rig rig;
  rig.config.period_ns = std::llround(static_cast<double>(period_s) * 1e9);
  rig.scene.config.period_s = period_s;
  rig.config.hand[0].guard = all_nets(rig.config.hand[0].guard, period_s);
  rig.hand.period_s = static_cast<double>(period_s);
  rig.instance = std::make_unique<KernelInstance>(rig.organ, rig.scene.config);
  Kernel& kernel = rig.instance->kernel;
  Stepper stepper{rig, {&rig.hand}};
  const std::vector<Failure> all = failures();
  Moment moment;
  moment.kernel.resize(snapshot_bytes(kernel));
  HandState hand;
  double largest_n = 0;
  const std::uint64_t ticks = script_ticks(rig.hand.script, static_cast<double>(period_s));
  for (std::uint64_t at = 1; at <= ticks; ++at) {
    for (std::size_t i = 0; at > 1 && at % stride == 0 && i < all.size(); ++i) {
      ASSERT_EQ(snapshot(kernel, moment.kernel), Status::kOk);
      moment.hand = rig.hand;
      moment.state = hand;
      moment.time = rig.time;
      moment.device = stepper.device;
      expect_zero_in_time(stepper, hand, all[i], at);
      if (testing::Test::HasFatalFailure()) return;
      ASSERT_EQ(restore(kernel, moment.kernel), Status::kOk);
      rig.hand = moment.hand;
      rig.time = moment.time;
      stepper.device = moment.device;
    }
    largest_n = std::max(largest_n, size(stepper.step(hand).command_n));
    ASSERT_EQ(hand.guard.fault, Fault::kNone) << "the session itself is good, tick " << at;
  }
  EXPECT_GT(hand.guard.counters.force_warm, 0U) << "the motors were warm";
  EXPECT_GT(largest_n, 0.2) << "there was a force to take away";
}

TEST(DeviceFaults, EveryKindAtSomeTicks) {
  fail_everywhere(1e-3F, 16);
  fail_everywhere(0.25e-3F, 64);
}

TEST(DeviceFaultsExhaustive, EveryKindAtEveryTick) {
  for (const float period_s : {1e-3F, 0.5e-3F, 2e-3F}) fail_everywhere(period_s, 1);
}

}  // namespace
}  // namespace stylet::hal
