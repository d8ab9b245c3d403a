// SPDX-License-Identifier: Apache-2.0
// One station by itself, tick by tick: what it accepts, how its force fades, what it counts and
// what it sends.
#include "hal/loop/station.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

namespace stylet::hal {
namespace {

constexpr std::int64_t kMs = 1'000'000;

// A device at rest, and a link without a network.
struct Desk {
  StationConfig config = station_config({.name = "a device",
                                         .max_force_n = 3,
                                         .max_slew_n_per_s = 4000,
                                         .max_torque_nm = 0.1F,
                                         .continuous_force_n = 3});
  StationState state = station_start(4);
  std::deque<std::vector<std::byte>> coming;
  std::vector<SamplePacket> sent;
  Command felt = {};
  bool answers = true;
  float x_m = 0.01F;
  std::uint64_t seq = 0, models = 0;
  std::uint32_t arming = 1;
  std::int64_t now_ns = 5'000 * kMs;

  Desk() { config.guard.ramp_s = 0; }

  void send(const ForcePacket& packet) {
    const auto bytes = encode(packet);
    coming.push_back({bytes.begin(), bytes.end()});
  }
  // A model of a constant force, which answers a sample of this moment.
  ForcePacket model(Vec3 force_n, Vec3 torque_nm = {}) {
    ForcePacket packet;
    packet.seq = ++models;
    packet.echo_t_ns = now_ns;
    packet.life_ns = kForceLifeNs;
    packet.model.force_n = force_n;
    packet.model.torque_nm = torque_nm;
    packet.model.max_force_n = 100;
    packet.arming = arming;
    return packet;
  }
  void tick() {
    const Device device = {this, {}, read, write, [](void*) {}};
    const Link link = {this, take, receive};
    station_tick(config, state, device, link, now_ns);
    now_ns += kMs;
  }

  static bool read(void* self, std::int64_t at_ns, Sample& out) {
    Desk& desk = *static_cast<Desk*>(self);
    if (desk.answers) out = {++desk.seq, at_ns, {{desk.x_m, 0, 0}, {1, 0, 0, 0}}, 5};
    return desk.answers;
  }
  static void write(void* self, const Command& command) {
    static_cast<Desk*>(self)->felt = command;
  }
  static void take(void* self, std::span<const std::byte> bytes) {
    SamplePacket packet;
    ASSERT_TRUE(decode(bytes, packet));
    static_cast<Desk*>(self)->sent.push_back(packet);
  }
  static std::optional<std::size_t> receive(void* self, std::span<std::byte> room) {
    Desk& desk = *static_cast<Desk*>(self);
    if (desk.coming.empty()) return std::nullopt;
    const std::vector<std::byte> bytes = desk.coming.front();
    desk.coming.pop_front();
    std::copy(bytes.begin(), bytes.end(), room.begin());
    return bytes.size();
  }
};

TEST(Station, ModelFadesInOverATenthOfASecondAndOutInTheSecondHalfOfItsLife) {
  Desk desk;
  for (int round = 0; round < 2; ++round) {  // each time from zero
    for (int tick = 1; tick <= 120; ++tick) {
      desk.send(desk.model({0, 1, 0}, {0.05F, 0, 0}));
      desk.tick();
      const float share = static_cast<float>(std::min(tick, 100)) / 100;
      ASSERT_NEAR(desk.felt.force_n.y, share, 1e-5F) << tick;
      ASSERT_NEAR(desk.felt.torque_nm.x, 0.05F * share, 1e-6F) << tick;
    }
    for (int age = 1; age <= 30; ++age) {
      desk.tick();
      const float share = static_cast<float>(std::clamp(20 - age, 0, 10)) / 10;
      ASSERT_NEAR(desk.felt.force_n.y, share, 1e-5F) << age;
      ASSERT_NEAR(desk.felt.torque_nm.x, 0.05F * share, 1e-6F) << age;
    }
    EXPECT_EQ(desk.state.starved, 11U * static_cast<unsigned>(round + 1));
    ++desk.arming;  // somebody acknowledged
  }
}

// A station that stood still for 20 ms does not render what the hand did meanwhile; neither does
// one that goes on losing too many ticks.
TEST(Station, LostTicksAreAFault) {
  for (const int lost_ms : {19, 20}) {
    for (const int times : {1, 4}) {
      Desk desk;
      const auto tick = [&desk] {
        desk.send(desk.model({0, 1, 0}));
        desk.tick();
      };
      for (int i = 0; i < 120; ++i) tick();
      ASSERT_NEAR(desk.felt.force_n.y, 1, 1e-5F);
      for (int i = 0; i < times; ++i) {
        desk.now_ns += lost_ms * kMs / times;
        tick();
        for (int k = 1; k < times; ++k) tick();  // each makes up for half a tick
      }
      const bool fault = lost_ms == 20 && times == 1;
      EXPECT_EQ(desk.state.guard.fault, fault ? Fault::kTooLate : Fault::kNone);
      if (fault) {
        EXPECT_NEAR(desk.felt.force_n.y, 0, 0.06F) << "of a stall as long as a fade";
      }
    }
  }
  Desk slow;
  for (int i = 0; i < 200 && slow.state.guard.fault == Fault::kNone; ++i) {
    if (i % 2 == 0) slow.now_ns += kMs;  // 1 ms lost, half a millisecond made up for
    slow.send(slow.model({0, 1, 0}));
    slow.tick();
  }
  EXPECT_EQ(slow.state.guard.fault, Fault::kTooLate);
}

// Also during and after a fade of the station's own guard, the device that renders knows when no
// force may be left.
TEST(Station, ItsOrdersEndWithTheModelsLife) {
  Desk desk;
  for (int tick = 1; tick <= 120; ++tick) {
    ForcePacket model = desk.model({0, 1, 0});
    model.echo_t_ns -= tick % 7 * kMs;
    model.life_ns = kForceLifeNs - tick % 3;
    desk.send(model);
    desk.tick();
    ASSERT_EQ(desk.felt.end_ns, model.echo_t_ns + model.life_ns) << tick;
  }
  const std::int64_t end_ns = desk.felt.end_ns;
  desk.answers = false;
  for (int tick = 0; tick < 10; ++tick) desk.tick();
  EXPECT_NE(desk.state.guard.fault, Fault::kNone);
  EXPECT_EQ(desk.felt.end_ns, end_ns);
}

TEST(Station, ForceBeyondTheLimitIsCutBeforeItFades) {
  Desk desk;
  for (int tick = 1; tick <= 120; ++tick) {
    desk.send(desk.model({0, 30, 40}));
    desk.tick();
  }
  EXPECT_NEAR(desk.felt.force_n.y, 1.8F, 1e-5F);
  EXPECT_NEAR(desk.felt.force_n.z, 2.4F, 1e-5F);
  for (int age = 1; age <= 15; ++age) desk.tick();
  EXPECT_NEAR(desk.felt.force_n.z, 1.2F, 1e-4F);
  EXPECT_EQ(desk.felt.max_force_n, 3);
}

TEST(Station, TakesNewerPacketsAndCountsTheRest) {
  Desk desk;
  const ForcePacket first = desk.model({1, 0, 0}), second = desk.model({2, 0, 0});
  desk.send(second);
  desk.send(second);
  desk.send(first);
  desk.coming.push_back({std::byte{1}});
  desk.tick();
  EXPECT_EQ(desk.state.models, 1U);
  EXPECT_EQ(desk.state.refused, 3U);
  EXPECT_EQ(desk.state.obeyed.newest.seq, second.seq);
}

TEST(Station, AFloodOfPacketsDoesNotHoldUpATick) {
  Desk desk;
  for (int i = 0; i < 70; ++i) desk.send(desk.model({1, 0, 0}));
  desk.tick();
  EXPECT_EQ(desk.coming.size(), 6U);
}

TEST(Station, SendsEachUsableSampleAndNothingWhileAFaultIsLatched) {
  Desk desk;
  desk.send(desk.model({1, 0, 0}));
  for (int i = 0; i < 3; ++i) desk.tick();
  ASSERT_EQ(desk.sent.size(), 3U);
  const SamplePacket& last = desk.sent.back();
  EXPECT_EQ(last.session, 4U);
  EXPECT_EQ(last.seq, 3U);
  EXPECT_EQ(last.t_ns, desk.now_ns - kMs);
  EXPECT_EQ(last.echo, 1U);
  EXPECT_EQ(last.buttons, 5U);
  EXPECT_EQ(last.pose.position_m.x, 0.01F);
  EXPECT_EQ(last.limits, (RenderLimits{3, 0, 3, 0.1F}));
  EXPECT_EQ(last.arming, 1U);
  EXPECT_EQ(last.stopped, 0U);
  EXPECT_EQ(last.force_n.x, desk.felt.force_n.x) << "what the hand has";
  EXPECT_GT(last.force_n.x, 0);
  desk.answers = false;
  desk.tick();
  EXPECT_EQ(desk.sent.size(), 3U);
  desk.answers = true;
  desk.tick();
  EXPECT_EQ(desk.sent.size(), 4U);
  guard_trip(desk.state.guard, Fault::kBuzz);
  desk.tick();
  EXPECT_EQ(desk.sent.size(), 4U);
}

TEST(Station, KeepsToWeakDevicesAndToTheFadeOfAModel) {
  const StationConfig weak = station_config({"a weak one", 0.5F, 100});
  EXPECT_EQ(weak.guard.max_force_n, 0.5F);
  EXPECT_EQ(weak.guard.max_slew_n_per_s, 100);
  EXPECT_EQ(weak.guard.continuous_force_n, GuardConfig{}.continuous_force_n);  // not known
  const StationConfig slow = station_config({"a slow one", 3, 100});
  EXPECT_FLOAT_EQ(slow.guard.max_slew_n_per_s, 300);  // 3 N in 10 ms
  EXPECT_EQ(station_config({"without a limit", 0, 100}).guard.max_force_n,
            GuardConfig{}.max_force_n);
}

// The position of a refused sample is not used: the force is that at the newest position that was.
TEST(Station, ARefusedSampleDoesNotCutTheForce) {
  Desk desk;
  const auto tick_in = [&desk](float x_m) {
    desk.x_m = x_m;
    ForcePacket packet = desk.model({0, 1, 0});
    packet.model.at_m = {0.01F, 0, 0};
    packet.model.radius_m = 0.02F;
    desk.send(packet);
    desk.tick();
  };
  for (int i = 0; i < 120; ++i) tick_in(0.01F);
  ASSERT_NEAR(desk.felt.force_n.y, 1, 1e-5F);
  for (const float x_m : {11.0F, std::numeric_limits<float>::quiet_NaN(), 0.5F}) {
    const std::size_t sent = desk.sent.size();
    tick_in(x_m);
    EXPECT_NEAR(desk.felt.force_n.y, 1, 1e-5F) << x_m;
    EXPECT_EQ(desk.felt.place_m.x, 0.01F) << x_m;
    EXPECT_EQ(desk.sent.size(), sent) << x_m;
    tick_in(0.01F);
  }
}

// If a loop was late before there was any force, nobody has to acknowledge that.
TEST(Station, AStationThatWasLateBeforeAnyForceSendsSamplesAgain) {
  Desk desk;
  for (int i = 0; i < 5; ++i) desk.tick();
  desk.answers = false;
  for (int i = 0; i < 40; ++i) desk.tick();
  EXPECT_EQ(desk.state.guard.fault, Fault::kDeviceSilent);
  desk.answers = true;
  const std::size_t sent = desk.sent.size();
  for (int i = 0; i < 5; ++i) desk.tick();
  EXPECT_EQ(desk.sent.size(), sent + 5);
}

// Somebody must acknowledge on the other machine. Until then the samples say that the force has
// ended.
TEST(Station, AForceWhoseLifeIsOverComesBackWithANewerArmingOnly) {
  Desk desk;
  desk.arming = 8;
  const auto felt_after = [&desk](std::uint32_t arming) {
    desk.arming = arming;
    for (int i = 0; i < 60; ++i) {
      desk.send(desk.model({1, 0, 0}));
      desk.tick();
    }
    return desk.felt.force_n.x;
  };
  EXPECT_GT(felt_after(8), 0.5F);
  for (int i = 0; i < 20; ++i) desk.tick();
  EXPECT_EQ(desk.felt.force_n.x, 0);
  for (const std::uint32_t not_newer : {8U, 7U, 0U, 0xFFFFFFFFU}) {
    EXPECT_EQ(felt_after(not_newer), 0) << not_newer;
    EXPECT_EQ(desk.sent.back().stopped, 1U);
    EXPECT_EQ(desk.sent.back().arming, 8U);
    EXPECT_EQ(desk.sent.back().force_n.x, 0);
  }
  EXPECT_GT(felt_after(9), 0.5F);
  EXPECT_EQ(desk.sent.back().stopped, 0U);
  EXPECT_EQ(felt_after(8), 0) << "an older arming is not obeyed, and the newer one's life ends";
}

// A packet that an independent check forged: with a life of years, a force was held long after its
// sender had ended.
TEST(Station, ForcesThatClaimToLiveLongAreRefused) {
  Desk desk;
  for (int i = 0; i < 200; ++i) {
    desk.send(desk.model({1, 0, 0}));
    desk.tick();
  }
  EXPECT_GT(desk.felt.force_n.x, 0.5F);
  ForcePacket forged = desk.model({2.9F, 0, 0});
  forged.life_ns = 100'000'000'000'000'000;
  desk.send(forged);
  ForcePacket early = desk.model({2.9F, 0, 0});
  early.echo_t_ns = desk.now_ns + 1000 * kMs;
  desk.send(early);
  const std::uint64_t refused = desk.state.refused;
  for (int i = 0; i < 25; ++i) desk.tick();
  EXPECT_EQ(desk.state.refused, refused + 2);
  EXPECT_EQ(desk.felt.force_n.x, 0);
}

}  // namespace
}  // namespace stylet::hal
