// SPDX-License-Identifier: Apache-2.0
// What is particular to a peer: on a real socket, what it says of itself, and who it is not; in
// virtual time, what becomes of its clock and its packets.
#include <deque>

#include "device_bench.h"
#include "stylet/hal/link.h"
#include "stylet/hal/packet.h"
#include "stylet/hal/peer_device.h"

namespace stylet::hal {
namespace {

std::string here() {
  return "127.0.0.1:" + test_port();
}

// Sends `packet` again and again while a device is opened.
class Sender {
 public:
  explicit Sender(std::vector<std::byte> packet)
      : thread_([this, bytes = std::move(packet)] {
          const Link link = udp_connect(here());
          while (!stop_) {
            link.send(link.self, bytes);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
          link.close(link.self);
        }) {}
  ~Sender() {
    stop_ = true;
    thread_.join();
  }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

std::vector<std::byte> bytes_of(const RenderLimits& limits) {
  SamplePacket packet;
  packet.session = 7;
  packet.seq = 1;
  packet.limits = limits;
  const auto bytes = encode(packet);
  return {bytes.begin(), bytes.end()};
}

DeviceInfo info_told(const RenderLimits& limits) {
  const Sender sender(bytes_of(limits));
  const Device device = open_device("udp:" + here(), 5);
  device.close(device.self);
  return device.info;
}

TEST(Peer, LimitsAreThoseItTellsAndNonsenseIsNotBelieved) {
  const DeviceInfo touch = info_told({3.3F, 400, 0.88F, 0.05F});
  EXPECT_EQ(touch.max_force_n, 3.3F);
  EXPECT_EQ(touch.max_stiffness_n_per_m, 400);
  EXPECT_EQ(touch.continuous_force_n, 0.88F);
  EXPECT_EQ(touch.max_torque_nm, 0.05F);
  const DeviceInfo strongest = info_told({100, 1e6F, 100, 10});
  EXPECT_EQ(strongest.max_force_n, 100);
  EXPECT_EQ(strongest.max_stiffness_n_per_m, 1e6F);
  EXPECT_EQ(strongest.continuous_force_n, 100);
  EXPECT_EQ(strongest.max_torque_nm, 10);
  const DeviceInfo boasting = info_told({100.5F, 1.01e6F, 100.5F, 10.5F});
  EXPECT_EQ(boasting.max_force_n, 8);
  EXPECT_EQ(boasting.max_stiffness_n_per_m, 0);
  EXPECT_EQ(boasting.continuous_force_n, 0);
  EXPECT_EQ(boasting.max_torque_nm, 0);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float odd : {0.0F, -1.0F, kNan, std::numeric_limits<float>::infinity()}) {
    const DeviceInfo unknown = info_told({odd, odd, odd, odd});
    EXPECT_EQ(unknown.max_force_n, 8) << odd;
    EXPECT_EQ(unknown.max_stiffness_n_per_m, 0) << odd;
    EXPECT_EQ(unknown.continuous_force_n, 0) << odd;
    EXPECT_EQ(unknown.max_torque_nm, 0) << odd;
  }
}

TEST(Peer, NobodyAndAnotherVersionAreToldApart) {
  const auto refusal = [](double patience_s) {
    try {
      const Device device = open_device("udp:" + here(), patience_s);
      device.close(device.self);
    } catch (const DeviceError& error) {
      return std::string(error.what());
    }
    return std::string("opened");
  };
  EXPECT_NE(refusal(0.05).find("no sample came in 0.05 s: start the program"), std::string::npos);
  std::vector<std::byte> old = bytes_of({});
  old[4] = std::byte{2};
  const Sender sender(old);
  EXPECT_NE(refusal(0.3).find("packets of version 2 came: expected version 3"), std::string::npos);
}

TEST(Peer, ZeroIsNoPort) {
  try {
    const Device device = open_device("udp:0", 0.01);
    device.close(device.self);
    FAIL() << "opened";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("udp:0: expected a port"), std::string::npos);
  }
}

// A link whose packets the test puts there, and a clock that it turns.
struct Wire {
  std::deque<std::vector<std::byte>> to_us;
  std::vector<ForcePacket> from_us;
  int received = 0;
  bool endless = false;
  std::int64_t now_ns = 0;
  PeerDevice peer;
  Device device;

  Wire() {
    peer.link = {this, send, receive, nullptr, [](void*) {}};
    peer.clock = {&now_ns, [](void* self) { return *static_cast<std::int64_t*>(self); }, nullptr};
    device = peer_device(peer);
  }
  SamplePacket told;  // beside
  void come(std::uint32_t session, std::uint64_t seq, std::int64_t t_ns) {
    SamplePacket packet = told;
    packet.session = session;
    packet.seq = seq;
    packet.t_ns = t_ns;
    const auto bytes = encode(packet);
    to_us.emplace_back(bytes.begin(), bytes.end());
  }
  bool read(Sample& sample_out) { return device.read(device.self, 0, sample_out); }

  static void send(void* self, std::span<const std::byte> bytes) {
    ForcePacket packet;
    ASSERT_TRUE(decode(bytes, packet));
    static_cast<Wire*>(self)->from_us.push_back(packet);
  }
  static std::size_t receive(void* self, std::span<std::byte> room) {
    Wire& wire = *static_cast<Wire*>(self);
    ++wire.received;
    if (wire.to_us.empty()) return 0;
    const std::vector<std::byte> packet = wire.to_us.front();
    if (!wire.endless) wire.to_us.pop_front();
    std::copy(packet.begin(), packet.end(), room.begin());
    return packet.size();
  }
};

// Ten minutes of a sender whose clock began elsewhere and goes 50 millionths faster or slower;
// every eighth packet takes 0.2 ms, the others up to 7 ms more. The time of a sample is that of its
// taking, but for the shortest way and what the clocks may drift apart until the next short one.
TEST(Peer, TimeOfASampleIsThatOfItsTakingWhateverTheWay) {
  for (const double drift : {-50e-6, 50e-6}) {
    Wire wire;
    double worst_late_s = 0, worst_early_s = 0;
    for (std::uint64_t i = 1; i <= 60'000; ++i) {
      const auto taken_ns = static_cast<std::int64_t>(i * 10'000'000);
      const auto hers_ns = static_cast<std::int64_t>((1 + drift) * static_cast<double>(taken_ns));
      wire.come(5, i, hers_ns - 1'000'000'000'000);
      wire.now_ns = taken_ns + 200'000 + static_cast<std::int64_t>(i % 8) * 1'000'000;
      Sample sample;
      ASSERT_TRUE(wire.read(sample));
      ASSERT_EQ(sample.seq, i);
      const double late_s = 1e-9 * static_cast<double>(sample.t_ns - taken_ns);
      if (i < 16) continue;  // no packet has come the short way
      worst_late_s = std::max(worst_late_s, late_s);
      worst_early_s = std::max(worst_early_s, -late_s);
    }
    EXPECT_LT(worst_late_s, 0.2e-3 + 0.08 * 1.5 / kDriftPart) << drift;
    EXPECT_LT(worst_early_s, 0.01e-3) << drift;
  }
}

TEST(Peer, NumbersGoOnOverSessionsAndOldOnesAreNotTakenUp) {
  Wire wire;
  Sample sample;
  EXPECT_FALSE(wire.read(sample));
  wire.come(5, 40, 0);
  ASSERT_TRUE(wire.read(sample));
  const std::uint64_t first = sample.seq;
  EXPECT_GT(first, 0U);
  wire.come(5, 43, 0);
  wire.come(5, 41, 0);
  ASSERT_TRUE(wire.read(sample));
  EXPECT_EQ(sample.seq, first + 3);
  wire.now_ns = kSilenceNs + 1;
  wire.come(6, 1, 0);
  ASSERT_TRUE(wire.read(sample));
  EXPECT_EQ(sample.seq, first + 4);
}

TEST(Peer, LooksAtNoMorePacketsThanItSays) {
  Wire wire;
  Sample sample;
  wire.come(5, 1, 0);
  ASSERT_TRUE(wire.read(sample));
  EXPECT_EQ(wire.received, 2);  // the packet, and that there is none
  wire.endless = true;
  wire.come(5, 2, 0);
  ASSERT_TRUE(wire.read(sample));
  EXPECT_EQ(wire.received, 2 + kMostPerRead);
}

TEST(Peer, AForceHasItsStiffnessInAllDirectionsAndGoesToNobodyBeforeASample) {
  Wire wire;
  Command command = {};
  command.force_n = {1, 2, 3};
  command.stiffness_n_per_m = 250;
  command.max_force_n = 4;
  wire.device.write(wire.device.self, command);
  EXPECT_TRUE(wire.from_us.empty());
  Sample sample;
  wire.come(5, 1, 77);
  ASSERT_TRUE(wire.read(sample));
  wire.device.write(wire.device.self, command);
  ASSERT_EQ(wire.from_us.size(), 1U);
  const ForcePacket& packet = wire.from_us[0];
  EXPECT_EQ(packet.echo, 1U);
  EXPECT_EQ(packet.echo_t_ns, 77);
  EXPECT_EQ(packet.model.force_n.z, 3);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(packet.model.stiffness_n_per_m[i], i % 4 == 0 ? 250 : 0) << i;
  }
}

// A fade takes 20 ms; then the network ends. Nothing may be felt 25 ms after it began.
TEST(Peer, LastForcesOfAFadeEndWithIt) {
  Wire wire;
  Sample sample;
  constexpr std::int64_t kBeginNs = 100'000'000, kMs = 1'000'000;
  for (std::uint64_t i = 0; i <= 60; ++i) {
    wire.now_ns = kBeginNs + static_cast<std::int64_t>(i) * kMs;
    wire.come(5, i + 1, wire.now_ns - 7);
    ASSERT_TRUE(wire.read(sample));
    const bool fades = i >= 10 && i < 30;
    wire.device.write(wire.device.self, {.force_n = {0, i < 30 ? 1.0F : 0, 0},
                                         .max_force_n = 4,
                                         .arming = 3,
                                         .falls = fades || i >= 30});
    const ForcePacket& packet = wire.from_us.back();
    const std::int64_t left_ns = packet.echo_t_ns + packet.life_ns - wire.now_ns;
    if (fades) {
      EXPECT_LE(wire.now_ns + left_ns, kBeginNs + 35 * kMs) << i;
    }
    if (fades && i < 15) {
      EXPECT_GE(packet.life_ns, 19 * kMs) << i;
    }
    if (!fades) {
      EXPECT_EQ(packet.life_ns, kForceLifeNs) << i;
    }
  }
}

// The guard hears from the hand what it has; where that cannot be, from the model.
TEST(Peer, TellsWhatTheHandHasAndThatItEnded) {
  Wire wire;
  Sample sample;
  MotorReport report;
  wire.peer.arming_base = 1000;
  wire.come(5, 1, 0);
  ASSERT_TRUE(wire.read(sample));
  EXPECT_FALSE(wire.device.motor(wire.device.self, report)) << "nothing was sent";
  wire.device.write(
      wire.device.self,
      {.force_n = {0, 1, 0}, .stiffness_n_per_m = 100, .max_force_n = 4, .arming = 3});
  EXPECT_EQ(wire.from_us.back().arming, 1003U);
  const auto told = [&](std::uint32_t arming, std::uint32_t stopped, Vec3 force_n) {
    wire.told.arming = arming;
    wire.told.stopped = stopped;
    wire.told.force_n = force_n;
    wire.told.pose.position_m = {0, -0.01F, 0};  // the spring is drawn by 1 N
    wire.now_ns += 1'000'000;
    wire.come(5, wire.peer.newest.seq + 1, wire.now_ns);
    EXPECT_TRUE(wire.read(sample));
    EXPECT_TRUE(wire.device.motor(wire.device.self, report));
    EXPECT_EQ(report.arming, 3U);
    return report;
  };
  EXPECT_EQ(told(1003, 0, {0, 0.4F, 0}).force_n.y, 0.4F);
  EXPECT_FLOAT_EQ(told(0, 0, {0, 0.4F, 0}).force_n.y, 2) << "it does not tell";
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float odd : {kNan, 8.1F, -1e30F, std::numeric_limits<float>::infinity()}) {
    EXPECT_FLOAT_EQ(told(1003, 0, {0, odd, 0}).force_n.y, 2) << odd;
  }
  EXPECT_FALSE(told(1003, 0, {0, 0.4F, 0}).stopped);
  EXPECT_FALSE(told(1002, 1, {0, 0.4F, 0}).stopped) << "of an earlier arming";
  EXPECT_TRUE(told(1003, 1, {0, 0.4F, 0}).stopped);
  EXPECT_EQ(report.force_n.y, 0);
}

}  // namespace
}  // namespace stylet::hal
