// SPDX-License-Identifier: Apache-2.0
// The whole loop on a virtual clock: kernel, guard, devices that misbehave, recorder and replay.
#include "hal/loop/loop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <vector>

#include "hal/record/recorder.h"
#include "hal/record/recording.h"
#include "hal/record/replay.h"
#include "hal/record/replay_device.h"
#include "rig.h"
#include "vectors.h"

namespace stylet::hal {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

using test::minus;
using test::size;

// Stands between the loop and a good device, and spoils the samples that pass.
struct Spoiler {
  Device inner;
  std::function<bool(std::uint64_t, Sample&)> spoil;  // ticks count from 1; false: no answer
  std::uint64_t tick = 0;
  Vec3 written = {};
};

Device spoiled(Spoiler& spoiler) {
  const auto read = [](void* self, std::int64_t now_ns, Sample& out) {
    Spoiler& s = *static_cast<Spoiler*>(self);
    Sample sample{};
    bool answered = s.inner.read(s.inner.self, now_ns, sample);
    answered = s.spoil(++s.tick, sample) && answered;
    if (answered) out = sample;
    return answered;
  };
  const auto write = [](void* self, const Command& command) {
    Spoiler& s = *static_cast<Spoiler*>(self);
    s.written = command.force_n;
    s.inner.write(s.inner.self, command);
  };
  return {&spoiler, spoiler.inner.info, read, write, [](void*) {}};
}

void expect_safe(const std::vector<TickRecord>& records, const GuardConfig& guard) {
  Vec3 last{};
  const double max_change =
      static_cast<double>(guard.max_slew_n_per_s) * static_cast<double>(guard.period_s);
  for (const TickRecord& record : records) {
    const Vec3 force = record.command_n;
    ASSERT_TRUE(std::isfinite(size(force))) << record.output.tick;
    ASSERT_LE(size(force), static_cast<double>(guard.max_force_n) * (1 + 1e-6));
    ASSERT_LE(size(minus(force, last)), max_change * (1 + 1e-5)) << record.output.tick;
    ASSERT_TRUE(std::isfinite(size(record.output.force_n)));
    last = force;
  }
}

TEST(Loop, ForcePushesTheHandBack) {
  Rig rig, without;
  rig.config.ticks = without.config.ticks = 1500;  // until everything is at rest
  const auto felt = rig.run(rig.device());
  Spoiler numb{without.device(), [](std::uint64_t, Sample&) { return true; }};
  Device deaf = spoiled(numb);
  deaf.write = [](void*, const Command&) {};
  const auto unfelt = without.run(deaf);
  ASSERT_EQ(felt.size(), rig.config.ticks);
  double peak = 0;
  for (const TickRecord& record : felt) peak = std::max(peak, size(record.command_n));
  EXPECT_GT(peak, 0.15);
  // The tissue pushes the hand back from its target, by force over stiffness.
  const double lag = static_cast<double>(felt.back().sample.pose.position_m.z) -
                     static_cast<double>(unfelt.back().sample.pose.position_m.z);
  EXPECT_NEAR(lag, size(felt.back().command_n) / 2000, 1e-7);
  expect_safe(felt, rig.config.hand[0].guard);
}

TEST(Loop, PublishesTheNewestAndEveryEvent) {
  Rig rig;
  const auto records = rig.run(rig.device());
  const DisplayState* shown = rig.display->take();
  ASSERT_NE(shown, nullptr);
  EXPECT_EQ(shown->hand[0].output.tick, records.back().output.tick);
  std::uint32_t count = 0;
  for (Event event; rig.events.pop(event);) ++count;
  EXPECT_GT(count, 0U);
  EXPECT_EQ(count, records.back().output.events);
}

TEST(Loop, AFullRingIsCountedNotWaitedFor) {
  Rig rig;
  Ring<TickRecord> small(10);
  const Device device = rig.device();
  run_loop(rig.config, rig.instance->kernel, std::span(&device, 1), virtual_clock(rig.time),
           {&small, nullptr, nullptr}, rig.state);
  EXPECT_EQ(rig.state.ticks, rig.config.ticks);
  EXPECT_EQ(rig.state.lost_records, rig.config.ticks - 10);
}

TEST(Loop, StopEndsItAfterTheTickWithZeroForce) {
  Rig rig;
  Spoiler spoiler{rig.device(), [&rig](std::uint64_t tick, Sample&) {
                    if (tick == 50) rig.state.stop = true;
                    return true;
                  }};
  EXPECT_EQ(rig.run(spoiled(spoiler)).size(), 50U);
  EXPECT_EQ(size(spoiler.written), 0);
}

// ---- late ticks
// ------------------------------------------------------------------------------------

// The mailbox: an acknowledgement counts if it names the present fault and the device answers.
TEST(Acknowledged, ByNameWhileTheDeviceAnswersAndNotForLaterFaults) {
  Rig rig;
  rig.config.ticks = 600;
  bool silent = false;
  std::function<void(std::uint64_t)> people;
  Spoiler spoiler{rig.device(), [&](std::uint64_t tick, Sample&) {
                    people(tick);
                    return !silent;
                  }};
  FaultMailbox& mailbox = rig.state.mailbox[0];
  std::vector<Fault> latched;
  people = [&](std::uint64_t tick) {
    latched.push_back(mailbox.latched.load().fault);
    silent = tick >= 100 && tick < 300;
    if (tick == 200) mailbox.seen = {Fault::kDeviceSilent, 1};  // too early: no answer yet
    if (tick == 320) mailbox.seen = {Fault::kBuzz, 1};          // another fault
    if (tick == 330) mailbox.seen = {Fault::kDeviceSilent, 2};  // a fault that is still to come
    if (tick == 340) mailbox.seen = {Fault::kDeviceSilent, 1};
    // The next fault of the same kind; an acknowledgement of the first one comes too late.
    if (tick == 450 || tick == 560) guard_trip(rig.state.hand[0].guard, Fault::kDeviceSilent);
    if (tick == 500) mailbox.seen = {Fault::kDeviceSilent, 1};
    if (tick == 520) mailbox.seen = {Fault::kDeviceSilent, 2};
  };
  (void)rig.run(spoiled(spoiler));
  EXPECT_EQ(latched[98], Fault::kNone);
  EXPECT_EQ(latched[110], Fault::kDeviceSilent);
  EXPECT_EQ(latched[319], Fault::kDeviceSilent);
  EXPECT_EQ(latched[339], Fault::kDeviceSilent);
  EXPECT_EQ(latched[340], Fault::kNone);
  EXPECT_EQ(latched[440], Fault::kNone);
  EXPECT_EQ(latched[519], Fault::kDeviceSilent);
  EXPECT_EQ(latched[525], Fault::kNone);
  EXPECT_EQ(latched[599], Fault::kDeviceSilent);
  EXPECT_EQ(rig.state.hand[0].guard.counters.rearms, 2U);
}

// Somebody moved the device while it did not answer: the needle goes on from where it was.
TEST(Acknowledged, DeviceThatComesBackElsewhereDoesNotMoveTheNeedle) {
  Rig rig;
  rig.config.ticks = 600;
  rig.config.hand[0].grip.enabled = true;
  Spoiler spoiler{rig.device(), [&](std::uint64_t tick, Sample& sample) {
                    if (tick >= 300) sample.pose.position_m.x += 0.05F;
                    if (tick == 400)
                      rig.state.mailbox[0].seen = LatchedFault{Fault::kDeviceSilent, 1};
                    return tick < 200 || tick >= 300;
                  }};
  const std::vector<TickRecord> records = rig.run(spoiled(spoiler));
  for (std::size_t i = 1; i < records.size(); ++i) {
    const Vec3 &a = records[i - 1].input.handle.position_m, &b = records[i].input.handle.position_m;
    ASSERT_LT(size(minus(b, a)), 1e-3) << i;
  }
  EXPECT_EQ(records[350].input.valid, 1U);
  EXPECT_EQ(records.back().fault, Fault::kNone);
  expect_safe(records, rig.config.hand[0].guard);
}

// An acknowledgement that comes while the force still fades is kept until the fade is over.
TEST(Acknowledged, DuringTheFadeItWaitsForItsEnd) {
  Rig rig;
  rig.config.ticks = 400;
  Spoiler spoiler{rig.device(), [&](std::uint64_t tick, Sample& sample) {
                    if (tick == 200) sample.pose.position_m.x = kNan;
                    if (tick == 200) guard_trip(rig.state.hand[0].guard, Fault::kBuzz);
                    if (tick == 205) rig.state.mailbox[0].seen = LatchedFault{Fault::kBuzz, 1};
                    return true;
                  }};
  const std::vector<TickRecord> records = rig.run(spoiled(spoiler));
  EXPECT_GT(size(records[205].command_n), 0);
  EXPECT_EQ(records[215].fault, Fault::kBuzz);
  EXPECT_EQ(records[230].fault, Fault::kNone);
}

TEST(LateTicks, AreSkippedOnTheGridAndChangeNoBit) {
  Rig rig, late;
  const auto expected = rig.run(rig.device());
  std::vector<std::int64_t> reads;
  Spoiler spoiler{late.device(), [&](std::uint64_t tick, Sample&) {
                    reads.push_back(late.time.now_ns);
                    if (tick % 10 == 0) late.time.now_ns += 3'500'000;
                    return true;
                  }};
  const auto records = late.run(spoiled(spoiler));
  EXPECT_EQ(late.state.missed_ticks, 3 * (late.config.ticks / 10));
  EXPECT_EQ(late.state.hand[0].guard.fault, Fault::kNone);
  for (std::size_t i = 1; i < reads.size(); ++i) {
    const std::int64_t gap = reads[i] - reads[i - 1];
    EXPECT_EQ(gap, i % 10 == 0 ? 4'000'000 : 1'000'000);
  }
  ASSERT_EQ(records.size(), expected.size());
  EXPECT_EQ(hash(late.instance->kernel), hash(rig.instance->kernel));
  EXPECT_EQ(records.back().output.force_n.x, expected.back().output.force_n.x);
}

TEST(LateTicks, TwentyInARowLatch) {
  for (const int late_ticks : {19, 20}) {
    Rig rig;
    Spoiler spoiler{rig.device(), [&](std::uint64_t tick, Sample&) {
                      const bool late =
                          tick > 100 && tick <= 100U + static_cast<unsigned>(late_ticks);
                      if (late) rig.time.now_ns += 1'500'000;
                      return true;
                    }};
    const auto records = rig.run(spoiled(spoiler));
    EXPECT_EQ(rig.state.hand[0].guard.fault, late_ticks == 20 ? Fault::kTooLate : Fault::kNone);
    expect_safe(records, rig.config.hand[0].guard);
    if (late_ticks == 20) {
      EXPECT_EQ(size(records.back().command_n), 0);
    }
  }
}

// Loads that an independent check used: for seconds, 17 ms busy and 1.5 ms free, or 8.5 ms busy of
// 11. Within three rounds 20 ms are lost, less what the ticks in between make up for.
TEST(LateTicks, RepeatedOnesAddUpToAFault) {
  struct Load {
    double busy_ms, free_ms;
    bool latches;
  };
  for (const Load& load : {Load{17, 1.5, true}, Load{8.5, 2.5, true}, Load{4.2, 3.8, true},
                           Load{3.5, 12.5, false}, Load{10.2, 30, false}}) {
    Rig rig;
    const auto busy_ns = static_cast<std::int64_t>(load.busy_ms * 1e6);
    const auto round_ns = busy_ns + static_cast<std::int64_t>(load.free_ms * 1e6);
    const std::int64_t start_ns = 100'000'000;
    std::int64_t next_ns = start_ns, latched_ns = 0;
    Spoiler spoiler{rig.device(), [&](std::uint64_t, Sample&) {
                      std::int64_t& now_ns = rig.time.now_ns;
                      const bool faulted = rig.state.hand[0].guard.fault != Fault::kNone;
                      if (faulted && latched_ns == 0) latched_ns = now_ns;
                      if (now_ns < next_ns) return true;
                      now_ns += busy_ns;
                      next_ns += round_ns;
                      return true;
                    }};
    const auto records = rig.run(spoiled(spoiler));
    expect_safe(records, rig.config.hand[0].guard);
    EXPECT_EQ(rig.state.hand[0].guard.fault, load.latches ? Fault::kTooLate : Fault::kNone)
        << load.busy_ms << " of " << load.busy_ms + load.free_ms;
    if (!load.latches) continue;
    const double lost_a_round_ms = load.busy_ms - 1 - 0.5 * (load.free_ms + 1);
    const double rounds = std::ceil(20 / lost_a_round_ms) + 1;
    EXPECT_LE(static_cast<double>(latched_ns - start_ns), rounds * static_cast<double>(round_ns))
        << load.busy_ms << " of " << load.busy_ms + load.free_ms;
  }
}

TEST(LateTicks, AreInTheHistogram) {
  Histogram histogram;
  for (int i = 0; i < 990; ++i) histogram_add(histogram, 10'500);
  for (int i = 0; i < 9; ++i) histogram_add(histogram, 200'000);
  histogram_add(histogram, 80'000'000);
  histogram_add(histogram, -5);
  EXPECT_EQ(histogram.total, 1001U);
  EXPECT_EQ(histogram_quantile_us(histogram, 0.5), 11);
  EXPECT_EQ(histogram_quantile_us(histogram, 0.995), 201);
  EXPECT_EQ(histogram_quantile_us(histogram, 1), 80'000);
}

// ---- devices that misbehave
// --------------------------------------------------------------------------

using Spoil = std::function<bool(Sample&)>;

std::vector<Spoil> single_faults() {
  std::vector<Spoil> faults;
  for (const float bad : {kNan, kInf, -kInf, 1e30F, -1e30F}) {
    for (const int field : {0, 1, 2, 3, 4, 5, 6}) {
      faults.push_back([bad, field](Sample& s) {
        float* fields[] = {&s.pose.position_m.x, &s.pose.position_m.y, &s.pose.position_m.z,
                           &s.pose.rotation.w,   &s.pose.rotation.x,   &s.pose.rotation.y,
                           &s.pose.rotation.z};
        *fields[field] = bad;
        return true;
      });
    }
  }
  faults.push_back([](Sample&) { return false; });
  faults.push_back([](Sample& s) {
    --s.seq;
    return true;
  });
  faults.push_back([](Sample& s) {
    s.seq = 0;
    return true;
  });
  faults.push_back([](Sample& s) {
    s.t_ns -= 1'000'000'000;
    return true;
  });
  return faults;
}

TEST(BadDevice, OneBadSampleAtAnyTickIsCountedAndHarmless) {
  const std::vector<Spoil> faults = single_faults();
  for (std::uint64_t at = 1; at <= 240; ++at) {
    Rig rig;
    const Spoil& fault = faults[at % faults.size()];
    Spoiler spoiler{rig.device(), [&](std::uint64_t tick, Sample& sample) {
                      return tick == at ? fault(sample) : true;
                    }};
    const auto records = rig.run(spoiled(spoiler));
    expect_safe(records, rig.config.hand[0].guard);
    const GuardCounters& count = rig.state.hand[0].guard.counters;
    EXPECT_EQ(count.samples_missing + count.samples_repeated + count.samples_old +
                  count.samples_not_finite + count.samples_absurd,
              1U)
        << at;
    EXPECT_EQ(rig.state.hand[0].guard.fault, Fault::kNone) << at;
    EXPECT_EQ(stats(rig.instance->kernel).input_missing, 1U) << at;
  }
}

TEST(BadDevice, AJumpOf300MmIsBoundedAndCounted) {
  for (const std::uint64_t at : {2U, 20U, 60U, 100U, 150U, 200U}) {
    Rig rig;
    Spoiler spoiler{rig.device(), [&](std::uint64_t tick, Sample& sample) {
                      if (tick >= at) sample.pose.position_m.x += 0.3F;
                      return true;
                    }};
    const auto records = rig.run(spoiled(spoiler));
    expect_safe(records, rig.config.hand[0].guard);
    EXPECT_GT(stats(rig.instance->kernel).input_clamped, 0U) << at;
  }
}

TEST(BadDevice, LossAtAnyTickIsZeroForceWithin25Milliseconds) {
  const std::vector<Spoil> faults = single_faults();
  std::size_t next = 0;
  for (std::uint64_t at = 1; at + 26 < 240; ++at) {
    Rig rig;
    const Spoil& fault = faults[next++ % faults.size()];
    std::uint64_t stuck = 0;
    Spoiler spoiler{rig.device(), [&](std::uint64_t tick, Sample& sample) {
                      if (tick < at) {
                        stuck = sample.seq;
                        return true;
                      }
                      const bool answered = fault(sample);
                      sample.seq = std::min(sample.seq, std::max<std::uint64_t>(stuck, 1));
                      return answered && tick > 1;
                    }};
    const auto records = rig.run(spoiled(spoiler));
    expect_safe(records, rig.config.hand[0].guard);
    EXPECT_NE(rig.state.hand[0].guard.fault, Fault::kNone) << at;
    for (std::uint64_t tick = at + 25; tick <= records.size(); ++tick) {
      ASSERT_EQ(size(records[tick - 1].command_n), 0) << at << " " << tick;
    }
  }
}

TEST(BadDevice, TissueComesToRestAfterTheStorm) {
  Rig rig;
  rig.config.ticks = 6000;
  Spoiler spoiler{rig.device(), [&](std::uint64_t tick, Sample& sample) {
                    if (tick < 200) {
                      sample.pose.position_m.z += tick % 2 == 0 ? 0.3F : -0.3F;
                    } else {
                      sample.pose.position_m.z = 0.15F;  // far outside
                    }
                    return true;
                  }};
  expect_safe(rig.run(spoiled(spoiler)), rig.config.hand[0].guard);
  std::vector<Vec3> now(rig.organ.vertices.size()), rest(rig.organ.vertices.size());
  ASSERT_EQ(surface(rig.instance->kernel, now), now.size());
  reset(rig.instance->kernel);
  ASSERT_EQ(surface(rig.instance->kernel, rest), rest.size());
  for (std::size_t i = 0; i < now.size(); ++i) EXPECT_LT(size(minus(now[i], rest[i])), 1e-6) << i;
}

// ---- recording and replay
// ----------------------------------------------------------------------------

class ReplayTest : public testing::Test {
 protected:
  void SetUp() override {
    path_ = (std::filesystem::temp_directory_path() /
             ("stylet-loop-" + std::to_string(getpid()) + ".h5"))
                .string();
    RecordingInfo info;
    info.config = rig_.scene.config;
    RecordingWriter writer(path_, info);
    rig_.config.hash_every_ticks = 50;
    {
      const Course course = {{}, {1, 0, 0}};
      Recorder recorder(rig_.records, rig_.events, &writer, std::span(&course, 1));
      const Device device = rig_.device();
      run_loop(rig_.config, rig_.instance->kernel, std::span(&device, 1), virtual_clock(rig_.time),
               {&rig_.records, &rig_.events, nullptr, true}, rig_.state);
      recorder.stop();
      EXPECT_EQ(recorder.error(), "");
      EXPECT_EQ(recorder.track().size(), rig_.config.ticks);
    }
    writer.finish(hash(rig_.instance->kernel), 0);
  }
  void TearDown() override { std::filesystem::remove(path_); }

  Rig rig_;
  std::string path_;
};

TEST_F(ReplayTest, GivesTheSameBits) {
  const RecordingReader recording(path_);
  Rig fresh;
  const ReplayResult result = replay(recording, fresh.instance->kernel);
  EXPECT_TRUE(result.same) << result.field << " at tick " << result.tick;
  EXPECT_EQ(result.ticks, rig_.config.ticks);
  EXPECT_EQ(result.state_hash, hash(rig_.instance->kernel));
}

TEST_F(ReplayTest, NamesTheFirstTickAndFieldThatDiffer) {
  const RecordingReader recording(path_);
  Rig other;
  for (int i = 0; i < 3; ++i) (void)tick(other.instance->kernel, {{}, 0});  // it has ticked already
  const ReplayResult result = replay(recording, other.instance->kernel);
  EXPECT_FALSE(result.same);
  EXPECT_EQ(result.tick, 1U);
  EXPECT_EQ(result.field, "output/tick");
  EXPECT_EQ(result.recorded, "1");
  EXPECT_EQ(result.replayed, "4");
}

TEST_F(ReplayTest, RecordedDeviceGivesTheSameRun) {
  const RecordingReader recording(path_);
  ReplayDevice replayed{read_samples(recording)};
  Rig fresh;
  const auto records = fresh.run(replay_device(replayed, fresh.scene.hands[0].limits));
  ASSERT_EQ(records.size(), recording.ticks());
  EXPECT_EQ(hash(fresh.instance->kernel), hash(rig_.instance->kernel));
  EXPECT_EQ(fresh.state.hand[0].guard.fault, Fault::kNone);
}

TEST_F(ReplayTest, MissingOrganIsNamed) {
  RecordingInfo info;
  // It is also looked for beside the recording, where other users may have it.
  info.organ_file = "/nowhere/" + std::to_string(getpid()) + ".organ";
  EXPECT_THROW((void)find_recorded_organ(path_, info, ""), LoadError);
  EXPECT_EQ(find_recorded_organ(path_, info, "given.organ"), "given.organ");
}

// ---- two needles in one tissue
// -------------------------------------------------------------------------

// The rig's needle, and another one from below, each with its own hand.
struct Pair {
  Rig rig;
  std::unique_ptr<KernelInstance> instance;
  SimulatedHand second;
  std::array<Device, 2> devices;
  std::array<Course, 2> courses;

  Pair() {
    Scene& scene = rig.scene;
    scene.config.needle_count = 2;
    scene.hands.push_back(scene.hands[0]);
    scene.hands[1].approach.direction = {0, 0, 1};
    scene.hands[1].approach.through_m = Vec3{0.005F, 0.01F, 0.01F};
    scene.hands[1].waypoints[0].travel_m = 0.012F;
    instance = std::make_unique<KernelInstance>(rig.organ, scene.config);
    for (std::uint32_t i = 0; i < 2; ++i) {
      const Placement placement = place_needle(scene, rig.organ, i);
      rig.config.hand[i] = {placement.mapping, scene.hands[i].guard, {}};
      courses[i] = placement.course;
    }
    second.script = make_script(scene.hands[1].waypoints, scene.hands[1].approach.start_m);
    devices = {rig.device(), simulated_hand_device(second, scene.hands[1].limits)};
  }

  std::array<std::vector<TickRecord>, 2> run() {
    run_loop(rig.config, instance->kernel, devices, virtual_clock(rig.time),
             {&rig.records, &rig.events, rig.display.get()}, rig.state);
    std::array<std::vector<TickRecord>, 2> all;
    for (TickRecord record; rig.records.pop(record);) all[record.needle].push_back(record);
    return all;
  }
};

TEST(TwoNeedles, EachFeelsItsOwnForceAndEventsNameTheNeedle) {
  Pair pair;
  const auto records = pair.run();
  ASSERT_EQ(records[0].size(), pair.rig.config.ticks);
  ASSERT_EQ(records[1].size(), pair.rig.config.ticks);
  for (const auto& each : records) {
    expect_safe(each, pair.rig.config.hand[0].guard);
    EXPECT_EQ(each.back().output.phase, Phase::kInserted);
    EXPECT_GT(size(each.back().command_n), 0.01);
    // Each is pushed back along its own device's axis.
    EXPECT_GT(each.back().command_n.z, 0);
  }
  std::array<int, 2> punctures = {};
  for (Event event; pair.rig.events.pop(event);) {
    if (event.kind == EventKind::kPuncture) ++punctures.at(event.needle);
  }
  EXPECT_EQ(punctures[0], 1);
  EXPECT_EQ(punctures[1], 1);
}

TEST(TwoNeedles, AFaultOfOneHandLeavesTheOther) {
  Pair pair;
  Spoiler spoiler{pair.devices[1], [](std::uint64_t tick, Sample&) { return tick < 100; }};
  pair.devices[1] = spoiled(spoiler);
  const auto records = pair.run();
  EXPECT_EQ(records[1].back().fault, Fault::kDeviceSilent);
  EXPECT_EQ(size(records[1].back().command_n), 0);
  EXPECT_EQ(records[0].back().fault, Fault::kNone);
  EXPECT_GT(size(records[0].back().command_n), 0.01);
}

TEST(TwoNeedles, ReplayGivesTheSameBitsAndNamesTheNeedleThatDiffers) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("stylet-pair-" + std::to_string(getpid()) + ".h5"))
          .string();
  Pair pair;
  RecordingInfo info;
  info.config = pair.rig.scene.config;
  RecordingWriter writer(path, info);
  {
    Recorder recorder(pair.rig.records, pair.rig.events, &writer, pair.courses);
    run_loop(pair.rig.config, pair.instance->kernel, pair.devices, virtual_clock(pair.rig.time),
             {&pair.rig.records, &pair.rig.events, nullptr, true}, pair.rig.state);
    recorder.stop();
    EXPECT_EQ(recorder.track(1).size(), pair.rig.config.ticks);
    EXPECT_GT(recorder.track(1).back().travel_m, 0.005F);
  }
  writer.finish(hash(pair.instance->kernel), 0);
  const RecordingReader recording(path);
  Pair same;
  const ReplayResult result = replay(recording, same.instance->kernel);
  EXPECT_TRUE(result.same) << result.field << " at tick " << result.tick;
  Pair other;
  other.rig.scene.config.needle[1].length_m += 1e-3F;
  const KernelInstance changed(other.rig.organ, other.rig.scene.config);
  Kernel kernel = changed.kernel;
  EXPECT_EQ(replay(recording, kernel).field.substr(0, 8), "needle1/");
  ReplayDevice replayed{read_samples(recording, 1)};
  ASSERT_EQ(replayed.samples.size(), pair.rig.config.ticks);
  EXPECT_EQ(replayed.samples.back().sample.pose.position_m.z,
            static_cast<float>(pair.second.position_m[2]));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace stylet::hal
