// SPDX-License-Identifier: Apache-2.0
// What is special about a peer. On a real socket: what it says of itself, and packets of other
// senders. In virtual time: how its clock and its packets are judged.
#include "hal/device/drivers/peer.h"

#include <deque>
#include <random>

#include "device_bench.h"
#include "hal/device/link.h"
#include "hal/device/packet.h"

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

TEST(Peer, LimitsAreThoseItReportsAndNonsenseIsIgnored) {
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

TEST(Peer, SilenceAndAnotherVersionHaveDifferentMessages) {
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

TEST(Peer, PortZeroIsRefused) {
  try {
    const Device device = open_device("udp:0", 0.01);
    device.close(device.self);
    FAIL() << "opened";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("udp:0: expected a port"), std::string::npos);
  }
}

// A link into which the test puts packets, and a clock that the test sets.
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
  static std::optional<std::size_t> receive(void* self, std::span<std::byte> room) {
    Wire& wire = *static_cast<Wire*>(self);
    ++wire.received;
    if (wire.to_us.empty()) return std::nullopt;
    const std::vector<std::byte> packet = wire.to_us.front();
    if (!wire.endless) wire.to_us.pop_front();
    std::copy(packet.begin(), packet.end(), room.begin());
    return packet.size();
  }
};

// Ten minutes of a sender whose clock began at another time and runs faster or slower. Every eighth
// packet takes 0.2 ms, the others up to 7 ms more. The time of a sample is right, except for the
// shortest delay and for the drift of the clocks until the next packet with that delay.
TEST(Peer, TimeOfASampleIsWhenItWasTakenWhateverTheDelay) {
  for (const double drift : {-800e-6, -50e-6, 50e-6, 800e-6}) {
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
      if (i < 16) continue;  // no packet with the shortest delay has come
      worst_late_s = std::max(worst_late_s, late_s);
      worst_early_s = std::max(worst_early_s, -late_s);
    }
    EXPECT_LT(worst_late_s, 0.2e-3 + 0.08 * (1.0 / kDriftPart + std::fabs(drift)) + 1e-6) << drift;
    EXPECT_LT(worst_early_s, 0.01e-3) << drift;
  }
}

// A peer of 1 kHz in the same thread, whose samples and forces are delayed on the way.
struct Walk {
  Wire wire;
  std::mt19937_64 random;
  bool echoes = true;
  std::int64_t clock_ns = 0;                              // the peer's clock less ours
  std::int64_t way_ns = 200'000, more_ns = 1'500'000;     // delay each way
  std::deque<std::pair<std::int64_t, SamplePacket>> out;  // time of arrival
  std::deque<std::pair<std::int64_t, std::uint64_t>> back;
  std::deque<std::int64_t> taken_ns;  // time of each sample, by its number
  std::uint64_t seen = 0;             // the newest force that the peer has
  std::int64_t t_ns = 1'000'000'000'000;
  double worst_late_s = 0, worst_early_s = 0;  // of the samples of this tick

  explicit Walk(std::uint64_t seed) : random(seed) {}
  std::int64_t draw(std::int64_t most) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(most + 1));
  }
  std::int64_t due() { return t_ns + way_ns + draw(more_ns); }
  // True if a sample came.
  bool tick(std::int64_t sample_ahead_ns = 0) {
    t_ns += 1'000'000;
    while (!back.empty() && back.front().first <= t_ns) {
      seen = std::max(seen, back.front().second);
      back.pop_front();
    }
    SamplePacket packet;
    packet.session = 5;
    taken_ns.push_back(t_ns);
    packet.seq = taken_ns.size();
    packet.t_ns = t_ns + clock_ns + sample_ahead_ns;
    packet.echo = echoes ? seen : 0;
    out.emplace_back(due(), packet);
    wire.now_ns = t_ns + 300'000;
    for (auto at = out.begin(); at != out.end();) {
      const bool comes = at->first <= wire.now_ns;
      if (comes) {
        const auto bytes = encode(at->second);
        wire.to_us.emplace_back(bytes.begin(), bytes.end());
      }
      at = comes ? out.erase(at) : at + 1;
    }
    Sample sample;
    const bool came = wire.read(sample);
    worst_late_s = worst_early_s = 0;
    if (came) {
      const std::int64_t true_ns = taken_ns.at(wire.peer.newest.seq - 1);
      worst_late_s = 1e-9 * static_cast<double>(sample.t_ns - true_ns);
      worst_early_s = -worst_late_s;
    }
    wire.device.write(wire.device.self, {.force_n = {}});
    if (!wire.from_us.empty()) back.emplace_back(due(), wire.from_us.back().seq);
    return came;
  }
};

constexpr double kWayS = 2.7e-3;  // the longest delay, and the time until the next look
// An error that no packet can show: the delay there and back, and the slack that peers are allowed.
constexpr double kHiddenS = 2 * kWayS + 1e-9 * static_cast<double>(kClockSlackNs);

// Clocks are set by a millisecond to a day, to and fro, with an echo and without. No sample is ever
// taken for younger than it is, and after the promised time none for older.
TEST(Peer, AClockThatIsSetIsRecognisedWithinThePromisedTime) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 60; ++round) {
    Walk walk(random());
    walk.echoes = round % 3 != 0;
    walk.clock_ns = walk.draw(2'000'000'000'000'000) - 1'000'000'000'000'000;
    for (int i = 0; i < 500; ++i) walk.tick();
    for (int set = 0; set < 3; ++set) {
      const double by_s = std::pow(10, -3 + 8 * 1e-6 * static_cast<double>(walk.draw(1'000'000)));
      const auto by_ns = static_cast<std::int64_t>(1e9 * by_s);
      walk.clock_ns += random() % 2 == 0 ? by_ns : -by_ns;
      for (int i = 0; i < 400; ++i) {
        if (!walk.tick()) continue;
        ASSERT_LE(walk.worst_late_s, kWayS) << round << " " << by_s << " " << i;
        const bool known = i > kClockDoubtNs / 1'000'000 + 5;
        if (!known) continue;
        ASSERT_LE(walk.worst_early_s, kHiddenS) << round << " " << by_s;
      }
    }
  }
}

// A single sample has a time in the future, by little or by hours.
TEST(Peer, OneSampleFromTheFutureDoesNoHarm) {
  for (const bool echoes : {true, false}) {
    for (const double ahead_s : {0.02, 10.0, 40'000.0}) {
      Walk walk(9);
      walk.echoes = echoes;
      for (int i = 0; i < 500; ++i) walk.tick();
      walk.tick(static_cast<std::int64_t>(1e9 * ahead_s));
      int usable = 0;
      for (int i = 0; i < 300; ++i) {
        const bool came = walk.tick() && walk.worst_early_s < 15e-3;
        usable += i >= 110 && came ? 1 : 0;
      }
      EXPECT_EQ(usable, 190) << ahead_s;
      EXPECT_LE(walk.worst_early_s, kHiddenS) << ahead_s;
    }
  }
}

// A network holds everything up for seconds, in any order: old samples stay old.
TEST(Peer, ASampleThatTheNetworkHeldUpIsNeverFresh) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 40; ++round) {
    Walk walk(random());
    walk.echoes = round % 3 != 0;
    for (int i = 0; i < 500; ++i) walk.tick();
    walk.way_ns = walk.draw(400'000'000);
    walk.more_ns = 1'500'000 + walk.draw(100'000'000);
    for (int i = 0; i < 3000; ++i) {
      if (i == 2000) walk.way_ns = 200'000;  // all that was held up now comes at once
      const bool came = walk.tick();
      ASSERT_TRUE(!came || walk.worst_late_s <= kWayS) << round << " " << i;
    }
    EXPECT_EQ(walk.wire.peer.clock_sets, 0U) << round;
  }
}

TEST(Peer, NumbersGoOnOverSessionsAndOldSessionsAreIgnored) {
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

TEST(Peer, ReadsNoMorePacketsInATickThanItsLimit) {
  Wire wire;
  Sample sample;
  wire.come(5, 1, 0);
  ASSERT_TRUE(wire.read(sample));
  EXPECT_EQ(wire.received, 2);  // the packet, and the answer that there is no other
  wire.endless = true;
  wire.come(5, 2, 0);
  ASSERT_TRUE(wire.read(sample));
  EXPECT_EQ(wire.received, 2 + kMostPerRead);
}

// A packet that is empty or from another sender does not end the reading.
TEST(Peer, UselessPacketsDoNotHideOthers) {
  Wire wire;
  Sample sample;
  for (std::uint64_t i = 1; i <= 20; ++i) {
    for (std::uint64_t k = 0; k < 10 * i; ++k) wire.to_us.emplace_back(k % 3);
    wire.come(5, i, 0);
    ASSERT_TRUE(wire.read(sample));
    EXPECT_EQ(sample.seq, i);
  }
}

TEST(Peer, AForceHasItsStiffnessInAllDirectionsAndIsNotSentBeforeASample) {
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

// A fade takes 20 ms, and then the network fails. 25 ms after it began no force may be felt.
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

// A station's order ends at its time, even if the station's own device is a peer.
TEST(Peer, NoForceOutlivesTheEndOfItsOrder) {
  constexpr std::int64_t kMs = 1'000'000;
  Wire wire;
  Sample sample;
  wire.now_ns = 1000 * kMs;
  for (std::int64_t left_ms = -5; left_ms <= 30; ++left_ms) {
    wire.now_ns += kMs;
    wire.come(5, static_cast<std::uint64_t>(left_ms + 6), wire.now_ns);
    ASSERT_TRUE(wire.read(sample));
    wire.device.write(wire.device.self, {.force_n = {0, 1, 0},
                                         .max_force_n = 4,
                                         .arming = 3,
                                         .end_ns = wire.now_ns + left_ms * kMs});
    EXPECT_EQ(wire.from_us.back().life_ns, std::clamp<std::int64_t>(left_ms, 0, 20) * kMs);
  }
}

// The hand reports to the guard which force it has; if it does not, the force is taken from the
// model.
TEST(Peer, ReportsTheForceThatTheHandHasAndItsEnd) {
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
    wire.told.pose.position_m = {0, -0.01F, 0};  // the spring is stretched by 1 N
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
