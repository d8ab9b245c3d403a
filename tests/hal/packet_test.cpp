// SPDX-License-Identifier: Apache-2.0
#include "hal/device/packet.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <vector>

namespace stylet::hal {
namespace {

template <typename T>
T at(std::span<const std::byte> bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

ForcePacket some_force() {
  ForcePacket packet;
  packet.seq = 7;
  packet.echo = 5;
  packet.echo_t_ns = 1'000'000'000;
  packet.life_ns = 20'000'000;
  packet.model.force_n = {1, 0, 0};
  packet.model.torque_nm = {0.01F, 0, 0};
  packet.model.at_m = {0.1F, 0.2F, 0.3F};
  packet.model.stiffness_n_per_m = {100, 0, 0, 0, 200, 0, 0, 0, 300};
  packet.model.radius_m = 0.02F;
  packet.model.max_force_n = 4;
  packet.arming = 6;
  return packet;
}

// The layout that hal/device/packets.md gives to others.
TEST(Packet, FieldsLieWhereTheLayoutSays) {
  SamplePacket sample;
  sample.session = 11;
  sample.buttons = 12;
  sample.seq = 13;
  sample.t_ns = 14;
  sample.echo = 15;
  sample.pose = {{1, 2, 3}, {4, 5, 6, 7}};
  sample.limits = {16, 17, 18, 19};
  sample.arming = 20;
  sample.stopped = 1;
  sample.force_n = {21, 22, 23};
  const auto s = encode(sample);
  EXPECT_EQ(std::memcmp(s.data(), "STYS", 4), 0);
  EXPECT_EQ(at<std::uint16_t>(s, 4), 3);
  EXPECT_EQ(at<std::uint16_t>(s, 6), 108);
  EXPECT_EQ(at<std::uint32_t>(s, 8), 11U);
  EXPECT_EQ(at<std::uint32_t>(s, 12), 12U);
  EXPECT_EQ(at<std::uint64_t>(s, 16), 13U);
  EXPECT_EQ(at<std::int64_t>(s, 24), 14);
  EXPECT_EQ(at<std::uint64_t>(s, 32), 15U);
  EXPECT_EQ(at<float>(s, 40), 1);
  EXPECT_EQ(at<float>(s, 52), 4);
  EXPECT_EQ(at<float>(s, 64), 7);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(at<float>(s, 68 + 4 * i), 16 + static_cast<float>(i));
  }
  EXPECT_EQ(at<std::uint32_t>(s, 84), 20U);
  EXPECT_EQ(at<std::uint32_t>(s, 88), 1U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(at<float>(s, 92 + 4 * i), 21 + static_cast<float>(i));
  }

  const auto f = encode(some_force());
  EXPECT_EQ(std::memcmp(f.data(), "STYF", 4), 0);
  EXPECT_EQ(at<std::uint16_t>(f, 6), 128);
  EXPECT_EQ(at<std::uint64_t>(f, 8), 7U);
  EXPECT_EQ(at<std::uint64_t>(f, 16), 5U);
  EXPECT_EQ(at<std::int64_t>(f, 24), 1'000'000'000);
  EXPECT_EQ(at<std::int64_t>(f, 32), 20'000'000);
  EXPECT_EQ(at<float>(f, 40), 1);
  EXPECT_EQ(at<float>(f, 52), 0.01F);
  EXPECT_EQ(at<float>(f, 64), 0.1F);
  EXPECT_EQ(at<float>(f, 92), 200);
  EXPECT_EQ(at<float>(f, 112), 0.02F);
  EXPECT_EQ(at<float>(f, 116), 4);
  EXPECT_EQ(at<std::uint32_t>(f, 120), 6U);
}

TEST(Packet, ForceFallsByTheStiffnessRowByRow) {
  ForcePacket packet = some_force();
  packet.model.force_n = {1, 2, 3};
  packet.model.at_m = {};
  packet.model.stiffness_n_per_m = {10, 20, 40, 50, 70, 110, 130, 170, 190};
  packet.model.radius_m = 0;
  packet.model.max_force_n = 1000;
  const auto& k = packet.model.stiffness_n_per_m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3 away = {axis == 0 ? 0.5F : 0, axis == 1 ? 0.5F : 0, axis == 2 ? 0.5F : 0};
    const Vec3 force = force_at(packet.model, away);
    EXPECT_EQ(force.x, 1 - 0.5F * k[axis]);
    EXPECT_EQ(force.y, 2 - 0.5F * k[3 + axis]);
    EXPECT_EQ(force.z, 3 - 0.5F * k[6 + axis]);
  }
}

TEST(Packet, IsReadAsItWasWritten) {
  ForcePacket out;
  ASSERT_TRUE(decode(encode(some_force()), out));
  EXPECT_EQ(encode(out), encode(some_force()));
}

TEST(Packet, AnyDamagedBitOrWrongLengthIsRefused) {
  const auto good = encode(some_force());
  ForcePacket out;
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    auto bad = good;
    bad[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    EXPECT_FALSE(decode(bad, out)) << "bit " << bit;
  }
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_FALSE(decode(std::span(good).first(size), out));
  }
  SamplePacket other;
  EXPECT_FALSE(decode(good, other));
  EXPECT_EQ(out.seq, 0U);
}

TEST(Packet, ForceFollowsTheModel) {
  const ForcePacket packet = some_force();
  const std::int64_t then = packet.echo_t_ns;
  const Vec3 here = force_at(packet, then, packet.model.at_m);
  EXPECT_EQ(here.x, 1);
  const Vec3 beside = force_at(packet, then, {0.105F, 0.205F, 0.3F});
  EXPECT_NEAR(beside.x, 0.5F, 1e-5F);
  EXPECT_NEAR(beside.y, -1, 1e-5F);
  // If too strong, it is shortened; too far away, it is zero.
  const Vec3 strong = force_at(packet, then, {0.1F, 0.2F, 0.281F});
  EXPECT_NEAR(strong.z / strong.x, 5.7F, 1e-2F);
  EXPECT_NEAR(strong.x * strong.x + strong.z * strong.z, 16, 1e-4F);
  EXPECT_EQ(force_at(packet, then, {0.1F, 0.2F, 0.279F}).x, 0);
}

TEST(Packet, ForceDiesAtTheEndOfItsLifeAndIsNotThereBeforeItsSample) {
  const ForcePacket packet = some_force();
  const Vec3 at_m = packet.model.at_m;
  EXPECT_EQ(force_at(packet, packet.echo_t_ns + packet.life_ns - 1, at_m).x, 1);
  EXPECT_EQ(force_at(packet, packet.echo_t_ns + packet.life_ns, at_m).x, 0);
  EXPECT_EQ(force_at(packet, packet.echo_t_ns - 1, at_m).x, 0);
}

TEST(Packet, AnyTimesCanBeCompared) {
  ForcePacket packet = some_force();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t then : {kLeast, std::int64_t{0}, kMost}) {
    for (const std::int64_t life : {kLeast, std::int64_t{-1}, kForceLifeNs}) {
      packet.echo_t_ns = then;
      packet.life_ns = life;
      const bool alive = then == 0 && life == kForceLifeNs;
      ObeyedForce obeyed;
      EXPECT_EQ(obey(obeyed, packet, 5), alive) << then << " " << life;
      EXPECT_EQ(force_at(packet, 5, packet.model.at_m).x, alive ? 1 : 0) << then << " " << life;
    }
  }
}

TEST(Packet, AnObeyedForceFadesInTheSecondHalfOfItsLifeAndStaysAway) {
  ForcePacket packet = some_force();
  const std::int64_t then = packet.echo_t_ns, life = packet.life_ns;
  ObeyedForce obeyed;
  EXPECT_EQ(obeyed_fraction(obeyed, then), 0);
  ASSERT_TRUE(obey(obeyed, packet, then));
  EXPECT_EQ(obeyed_fraction(obeyed, then + life / 2), 1);
  EXPECT_NEAR(obeyed_fraction(obeyed, then + life * 3 / 4), 0.5F, 1e-6F);
  packet.seq = 6;
  EXPECT_FALSE(obey(obeyed, packet, then)) << "older";
  packet.seq = 8;
  packet.life_ns = kForceLifeNs + 1;
  EXPECT_FALSE(obey(obeyed, packet, then)) << "lives too long";
  // The newest force is over when the next one comes, even if nobody asked for it meanwhile.
  packet.life_ns = life;
  packet.echo_t_ns = then + 2 * life;
  EXPECT_TRUE(obey(obeyed, packet, then + 2 * life));
  EXPECT_EQ(obeyed_fraction(obeyed, then + 2 * life), 0);
  packet.seq = 9;
  packet.arming = 5;
  EXPECT_FALSE(obey(obeyed, packet, then + 2 * life)) << "an older arming";
  packet.arming = 7;
  EXPECT_TRUE(obey(obeyed, packet, then + 2 * life));
  EXPECT_EQ(obeyed_fraction(obeyed, then + 2 * life), 1);
}

TEST(Packet, TorqueLivesAndEndsWithTheForce) {
  const ForcePacket packet = some_force();
  const Vec3 at_m = packet.model.at_m;
  const std::int64_t then = packet.echo_t_ns;
  EXPECT_EQ(torque_at(packet, then + packet.life_ns - 1, at_m).x, 0.01F);
  EXPECT_EQ(torque_at(packet, then + packet.life_ns, at_m).x, 0);
  EXPECT_EQ(torque_at(packet, then - 1, at_m).x, 0);
  EXPECT_EQ(torque_at(packet, then, {0.1F, 0.2F, 0.279F}).x, 0);
  ForcePacket bad = packet;
  bad.model.torque_nm.y = std::numeric_limits<float>::infinity();
  EXPECT_EQ(torque_at(bad, then, at_m).x, 0);
}

TEST(Packet, AnotherVersionIsRefusedAndNamed) {
  auto bytes = encode(SamplePacket{});
  EXPECT_EQ(packet_version(bytes), kPacketVersion);
  bytes[4] = std::byte{1};
  EXPECT_EQ(packet_version(bytes), 1);
  SamplePacket out;
  EXPECT_FALSE(decode(bytes, out));
  bytes[0] = std::byte{'X'};
  EXPECT_EQ(packet_version(bytes), 0);
  EXPECT_EQ(packet_version(std::span(bytes).first(5)), 0);
}

TEST(Packet, ValuesThatAreNotFiniteGiveNoForce) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  for (const float bad : {kNan, kInf, -kInf}) {
    ForceModel model = some_force().model;
    model.force_n.x = bad;
    EXPECT_EQ(force_at(model, model.at_m).y, 0);
    EXPECT_EQ(force_at(model, model.at_m).x, 0);
    model = some_force().model;
    EXPECT_EQ(force_at(model, {bad, 0, 0}).x, 0);
    model.max_force_n = bad;
    const Vec3 force = force_at(model, model.at_m);
    EXPECT_EQ(force.x, bad == kInf ? 1 : 0) << bad;
  }
}

}  // namespace
}  // namespace stylet::hal
