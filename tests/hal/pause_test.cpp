// SPDX-License-Identifier: Apache-2.0
// A paused loop: no bit of the kernel changes, nothing is recorded, the guard goes on, and the hand
// feels its force fade and come back.
#include <gtest/gtest.h>

#include <cmath>

#include "rig.h"
#include "vectors.h"

namespace stylet::hal {
namespace {

// Pauses the loop for some of its rounds.
struct Pauses {
  VirtualTime time;
  LoopState* state;
  std::uint64_t from, to, round = 0;

  static std::int64_t now(void* self) { return static_cast<Pauses*>(self)->time.now_ns; }
  static void sleep(void* self, std::int64_t t_ns) {
    Pauses& p = *static_cast<Pauses*>(self);
    p.time.now_ns = std::max(p.time.now_ns, t_ns);
    ++p.round;
    p.state->paused.store(p.round > p.from && p.round <= p.to);
  }
  Clock clock() { return {this, now, sleep}; }
};

// Passes everything on, and keeps what was written.
struct Listening {
  Device device;
  std::vector<Vec3> written;
  std::vector<bool> answers;  // by round; later ones are true
  std::size_t reads = 0;

  static bool read(void* self, std::int64_t now_ns, Sample& sample) {
    Listening& l = *static_cast<Listening*>(self);
    const bool there = l.device.read(l.device.self, now_ns, sample);
    const std::size_t round = l.reads++;
    return there && (round >= l.answers.size() || l.answers[round]);
  }
  static void write(void* self, const Command& command) {
    Listening& l = *static_cast<Listening*>(self);
    l.written.push_back(command.force_n);
    l.device.write(l.device.self, command);
  }
  static void close(void* /*self*/) {}
  Device as_device() { return {this, device.info, read, write, close}; }
};

std::vector<TickRecord> run(Rig& rig, const Device& device, std::uint64_t from, std::uint64_t to) {
  Pauses pauses = {{}, &rig.state, from, to};
  run_loop(rig.config, rig.instance->kernel, std::span(&device, 1), pauses.clock(),
           {&rig.records, &rig.events, rig.display.get()}, rig.state);
  std::vector<TickRecord> all;
  for (TickRecord record; rig.records.pop(record);) all.push_back(record);
  return all;
}

using test::size;

TEST(Pause, AScriptGoesOnAsIfThereHadBeenNoPause) {
  Rig plain, held;
  plain.config.hand[0].scripted = held.config.hand[0].scripted = true;
  const auto expected = run(plain, plain.device(), 0, 0);
  const auto records = run(held, held.device(), 120, 420);
  ASSERT_EQ(records.size(), expected.size());
  EXPECT_EQ(held.state.ticks, plain.state.ticks);
  EXPECT_EQ(hash(held.instance->kernel), hash(plain.instance->kernel));
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].output.tick, i + 1);
    EXPECT_EQ(records[i].command_n.z, expected[i].command_n.z);
  }
}

TEST(Pause, AHandFeelsTheForceFadeAndTheNeedleWaits) {
  Rig rig;
  rig.config.hand[0].grip.enabled = true;
  Listening hand = {rig.device(), {}, {}};
  const auto records = run(rig, hand.as_device(), 150, 300);
  ASSERT_EQ(records.size(), rig.config.ticks);  // without the ticks of the pause
  // The force at the end of the run fades, too.
  ASSERT_GT(hand.written.size(), rig.config.ticks + 150);
  ASSERT_LE(hand.written.size(), rig.config.ticks + 150 + 21);
  EXPECT_EQ(size(hand.written.back()), 0);
  EXPECT_GT(size(hand.written[149]), 0.1F);  // it was felt
  const auto fade = static_cast<std::size_t>(std::ceil(kLetGoS / 1e-3F)) + 1;
  for (std::size_t i = 150 + fade; i < 300; ++i) EXPECT_EQ(size(hand.written[i]), 0) << i;
  const float most_n = rig.config.hand[0].guard.max_slew_n_per_s * 1e-3F * 1.0001F;
  for (std::size_t i = 1; i < hand.written.size(); ++i) {
    const Vec3 a = hand.written[i - 1], b = hand.written[i];
    EXPECT_LE(size({b.x - a.x, b.y - a.y, b.z - a.z}), most_n) << i;
  }
  // The hand moved meanwhile; the needle goes on from where it was.
  const Vec3 before = records[149].input.handle.position_m;
  const Vec3 after = records[150].input.handle.position_m;
  EXPECT_LT(size({after.x - before.x, after.y - before.y, after.z - before.z}), 2e-4F);
  EXPECT_EQ(rig.state.hand[0].guard.counters.samples_used, rig.config.ticks + 150);
}

TEST(Pause, TheGuardLatchesAndIsRearmedDuringIt) {
  Rig rig;
  rig.config.hand[0].grip.enabled = true;
  Listening hand = {rig.device(), {}, std::vector<bool>(210, true)};
  for (std::size_t i = 200; i < 210; ++i) hand.answers[i] = false;
  Pauses pauses = {{}, &rig.state, 150, 400};
  const Device device = hand.as_device();
  // Somebody acknowledges again and again, which counts as soon as the fault is latched.
  struct Asks {
    Pauses* pauses;
    static std::int64_t now(void* self) { return Pauses::now(static_cast<Asks*>(self)->pauses); }
    static void sleep(void* self, std::int64_t t_ns) {
      Pauses& p = *static_cast<Asks*>(self)->pauses;
      Pauses::sleep(&p, t_ns);
      if (p.round == 260) p.state->mailbox[0].seen.store({Fault::kDeviceSilent, 1});
    }
  } asks = {&pauses};
  run_loop(rig.config, rig.instance->kernel, std::span(&device, 1), {&asks, Asks::now, Asks::sleep},
           {&rig.records, &rig.events}, rig.state);
  EXPECT_EQ(rig.state.hand[0].guard.counters.faults, 1U);
  EXPECT_EQ(rig.state.hand[0].guard.counters.rearms, 1U);
  EXPECT_EQ(rig.state.hand[0].guard.fault, Fault::kNone);
}

}  // namespace
}  // namespace stylet::hal
