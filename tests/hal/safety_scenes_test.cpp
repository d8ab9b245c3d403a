// SPDX-License-Identifier: Apache-2.0
// Four scenes with a device's own dynamics, each with a bar: the force when the dead man's button
// is pressed in the tissue, buzzing against bone, loss of the cable, a loop that stalls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "rig.h"

namespace stylet::hal {
namespace {

double size(Vec3 v) {
  return std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
}

// A simulated device of this name in a light grip, in front of bone of 20 N/mm.
struct Bench {
  Rig rig;
  std::unique_ptr<KernelInstance> instance;
  Device inner;
  std::function<bool(std::uint64_t, Sample&)> change = [](std::uint64_t, Sample&) { return true; };
  std::function<void(std::uint64_t)> before_tick = [](std::uint64_t) {};
  std::uint64_t reads = 0;
  double fastest_m_per_s = 0;  // of the hand since it was last set to zero

  explicit Bench(const char* name, bool coupled = true) {
    const DeviceModel& model = *find_device_model(name);
    Scene& scene = rig.scene;
    GuardConfig& guard = rig.config.hand[0].guard;
    guard = {};
    guard.max_force_n = model.max_force_n;
    guard.max_slew_n_per_s = model.max_slew_n_per_s;
    guard.buzz_n = 0.1F * model.max_force_n;
    guard.device = model.motion;
    guard.passivity_damping_n_s_per_m = 0.5F * model.max_damping_n_s_per_m;
    if (coupled) {
      rig.config.hand[0].coupling = {
          static_cast<float>(kCouplingShare) * model.max_stiffness_n_per_m, model.max_force_n};
    }
    rig.hand.config = {0.05F, 300, 3, model.motion};
    rig.config.ticks = 2000;
    go({{.travel_m = 0.008F, .speed_m_per_s = 0.02F, .hold_s = 2}});
    ObstacleConfig bone;
    make_box(bone, {0.01F, 0.05F, 0.05F});
    bone.pose.position_m = place_needle(scene, rig.organ).course.entry_m;
    bone.pose.position_m.x += 0.01F;
    bone.stiffness_n_per_m = 20e3F;
    bone.largest_force_n = 100;
    instance = std::make_unique<KernelInstance>(rig.organ, scene.config, std::span(&bone, 1));
    inner = simulated_hand_device(rig.hand, {});
  }

  void go(const std::vector<Waypoint>& way) { rig.hand.script = make_script(way, 0.001F); }

  static bool read(void* self, std::int64_t now_ns, Sample& out) {
    Bench& bench = *static_cast<Bench*>(self);
    Sample sample = {};
    (void)bench.inner.read(bench.inner.self, now_ns, sample);
    const double* v = bench.rig.hand.velocity_m_per_s;
    bench.fastest_m_per_s = std::max(bench.fastest_m_per_s, std::fabs(v[2]));
    if (!bench.change(++bench.reads, sample)) return false;
    out = sample;
    return true;
  }

  std::vector<TickRecord> run() {
    const Device device = {this,
                           {},
                           read,
                           [](void* self, const Command& command) {
                             static_cast<Bench*>(self)->rig.hand.force_n = command.force_n;
                           },
                           [](void*) {}};
    const Clock clock = {this,
                         [](void* self) { return static_cast<Bench*>(self)->rig.time.now_ns; },
                         [](void* self, std::int64_t until_ns) {
                           Bench& bench = *static_cast<Bench*>(self);
                           bench.rig.time.now_ns = std::max(bench.rig.time.now_ns, until_ns);
                           bench.before_tick(bench.reads + 1);
                         }};
    run_loop(rig.config, instance->kernel, std::span(&device, 1), clock, {&rig.records}, rig.state);
    std::vector<TickRecord> all;
    for (TickRecord record; rig.records.pop(record);) all.push_back(record);
    return all;
  }
};

// Half of the range of the force about its mean over 50 ms, in the last 0.5 s.
double ripple_n(const std::vector<TickRecord>& records) {
  constexpr std::size_t kWide = 50;
  double low = 0, high = 0;
  for (std::size_t i = records.size() - 500; i + kWide <= records.size(); ++i) {
    double mean = 0;
    for (std::size_t k = i; k < i + kWide; ++k) mean += static_cast<double>(records[k].command_n.z);
    const double rest =
        static_cast<double>(records[i + kWide / 2].command_n.z) - mean / static_cast<double>(kWide);
    low = std::min(low, rest);
    high = std::max(high, rest);
  }
  return 0.5 * (high - low);
}

TEST(SafetyScenes, BoneAtTheDevicesStiffnessLimitDoesNotBuzz) {
  for (const char* name : {"touch", "omega.7"}) {
    Bench bench(name);
    const auto records = bench.run();
    const double pressed = size(records.back().command_n);
    EXPECT_GT(pressed, 0.8) << name;
    EXPECT_LT(ripple_n(records), std::max(0.02, 0.05 * pressed)) << name;
    EXPECT_GE(bench.rig.hand.least_received_j, -1e-6) << name;
    EXPECT_GE(bench.rig.state.hand[0].guard.energy.least_j, -1e-6) << name;
    EXPECT_EQ(bench.rig.state.hand[0].guard.fault, Fault::kNone) << name;
  }
}

TEST(SafetyScenes, BoneWithoutACouplingBuzzesAndTheGuardEndsIt) {
  // A Touch is held still by its friction here.
  for (const char* name : {"omega.7", "delta.6"}) {
    Bench bench(name, false);
    const auto records = bench.run();
    EXPECT_EQ(records.back().fault, Fault::kBuzz) << name;
    const auto latched = std::find_if(records.begin(), records.end(),
                                      [](const TickRecord& r) { return r.fault != Fault::kNone; });
    for (auto each = latched + 25; each < records.end(); ++each)
      ASSERT_EQ(size(each->command_n), 0);
    // It is latched as soon as it is seen to last.
    const auto touched = std::find_if(records.begin(), records.end(),
                                      [](const TickRecord& r) { return size(r.command_n) > 0; });
    EXPECT_LT(latched - touched, 700) << name;
  }
}

// Presses on bone with the button up, then presses the button. Returns the largest speed at which
// that moves the hand.
double speed_after_arming(float ramp_s, std::vector<TickRecord>& records) {
  Bench bench("touch");
  GuardConfig& guard = bench.rig.config.hand[0].guard;
  guard.dead_man_button = 0;
  guard.ramp_s = ramp_s;
  bench.change = [&bench](std::uint64_t tick, Sample& sample) {
    if (tick == 1000) bench.fastest_m_per_s = 0;
    sample.buttons = tick >= 1000 ? 1 : 0;
    return true;
  };
  records = bench.run();
  EXPECT_EQ(records.back().fault, Fault::kNone);
  EXPECT_EQ(records.back().mode, GuardMode::kLive);
  EXPECT_GT(size(records.back().command_n), 0.8);
  return bench.fastest_m_per_s;
}

TEST(SafetyScenes, ForceAtEngagementIsNoKick) {
  std::vector<TickRecord> records;
  const double speed = speed_after_arming(0.5F, records);
  for (std::size_t i = 1; i < records.size(); ++i) {
    const Vec3 a = records[i - 1].command_n, b = records[i].command_n;
    if (i < 999) {
      ASSERT_EQ(size(b), 0) << i;
    }
    // What the ramp adds in a tick at the largest force, and what the hand's own motion adds.
    ASSERT_LT(size({b.x - a.x, b.y - a.y, b.z - a.z}), 3.3 / 500 + 400 * 0.055e-3) << i;
  }
  EXPECT_LT(speed, 0.03);
  EXPECT_GT(speed_after_arming(0, records), 2 * speed);  // which is what the ramp is for
}

TEST(SafetyScenes, LossOfTheCableIsZeroInTimeAndStaysSoUntilItIsArmedAgain) {
  for (const char* name : {"touch", "omega.7"}) {
    Bench bench(name);
    bench.change = [](std::uint64_t tick, Sample&) { return tick < 1000 || tick >= 1200; };
    bench.before_tick = [&bench](std::uint64_t tick) {
      GuardState& guard = bench.rig.state.hand[0].guard;
      const bool armed = guard_rearm(guard, Fault::kDeviceSilent);
      EXPECT_EQ(armed, tick == 1201);  // not before it has answered
    };
    const auto records = bench.run();
    double last = size(records[998].command_n);
    EXPECT_GT(last, 0.8);
    for (std::size_t i = 999; i < 1200; ++i) {
      const double now = size(records[i].command_n);
      ASSERT_LE(now, i < 1001 ? last + 0.05 : last) << name << " " << i;
      if (i >= 999 + 25) {
        ASSERT_EQ(now, 0) << name << " " << i;
      }
      last = now;
    }
    EXPECT_EQ(records[1100].fault, Fault::kDeviceSilent);
    EXPECT_EQ(records.back().mode, GuardMode::kLive);
    EXPECT_GT(size(records.back().command_n), 0.8);
  }
}

TEST(SafetyScenes, AStalledLoopDoesNotKick) {
  Bench bench("omega.7");
  // Drawn back slowly, and pushed in while the loop does not run for 60 ms.
  bench.go({{.travel_m = 0.004F, .speed_m_per_s = 0.02F, .hold_s = 0.76F},
            {.travel_m = 0.008F, .speed_m_per_s = 0.1F, .hold_s = 1}});
  bench.before_tick = [&bench](std::uint64_t tick) {
    if (tick != 1001) return;
    bench.rig.time.now_ns += 60'000'000;
    Sample unread = {};
    for (int i = 0; i < 59; ++i) (void)bench.inner.read(bench.inner.self, 0, unread);
  };
  const auto records = bench.run();
  const double before = size(records[999].command_n);
  EXPECT_GT(before, 0.3);
  EXPECT_GT(size(records[1003].output.force_n), 1.3 * before);  // the spring was drawn meanwhile
  for (std::size_t i = 1000; i < records.size(); ++i) {
    ASSERT_LE(size(records[i].command_n), before) << i;
    if (i >= 1000 + 20) {
      ASSERT_EQ(size(records[i].command_n), 0) << i;
    }
  }
  EXPECT_EQ(records.back().fault, Fault::kTooLate);
}

}  // namespace
}  // namespace stylet::hal
