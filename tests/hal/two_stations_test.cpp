// SPDX-License-Identifier: Apache-2.0
// Two machines, one tissue: the second hand joins over a network that loses, doubles, reorders and
// stalls packets. In virtual time, determined by a seed, without a socket.
#include <deque>
#include <random>

#include "hal/device/drivers/peer.h"
#include "hal/loop/station.h"
#include "rig.h"

namespace stylet::hal {
namespace {

constexpr std::int64_t kMs = 1'000'000;

struct Weather {
  double loss = 0, twice = 0;
  std::int64_t delay_ns = 0, jitter_ns = 0;      // jitter: out of order
  std::int64_t stall_from_ns = 0, stall_ns = 0;  // packets sent in the stall come at its end
};

// One direction of the network, on the clock of the test.
struct Pipe {
  const std::int64_t* now_ns;
  Weather weather;
  std::mt19937 random;
  struct Packet {
    std::int64_t due_ns;
    std::vector<std::byte> bytes;
  };
  std::vector<Packet> under_way;

  void send(std::span<const std::byte> bytes) {
    std::uniform_real_distribution<double> chance(0, 1);
    if (chance(random) < weather.loss) return;
    const int copies = chance(random) < weather.twice ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      std::int64_t due =
          *now_ns + weather.delay_ns +
          static_cast<std::int64_t>(chance(random) * static_cast<double>(weather.jitter_ns));
      const std::int64_t end = weather.stall_from_ns + weather.stall_ns;
      if (*now_ns >= weather.stall_from_ns && due < end) due = end;
      under_way.push_back({due, {bytes.begin(), bytes.end()}});
    }
  }
  std::optional<std::size_t> receive(std::span<std::byte> room) {
    for (std::size_t i = 0; i < under_way.size(); ++i) {
      if (under_way[i].due_ns > *now_ns) continue;
      const std::vector<std::byte> bytes = under_way[i].bytes;
      under_way.erase(under_way.begin() + static_cast<std::ptrdiff_t>(i));
      std::copy(bytes.begin(), bytes.end(), room.begin());
      return bytes.size();
    }
    return std::nullopt;
  }
};

struct End {
  Pipe* out;
  Pipe* in;
};
Link link_of(End& end) {
  return {&end,
          [](void* self, std::span<const std::byte> packet) {
            static_cast<End*>(self)->out->send(packet);
          },
          [](void* self, std::span<std::byte> room) {
            return static_cast<End*>(self)->in->receive(room);
          },
          nullptr, [](void*) {}};
}

// The second machine's clock is unrelated to the first's.
constexpr std::int64_t kOtherClockNs = 987'654'321'000;

// A hand at the station pushes the needle of the rig's tissue, over the network.
struct TwoStations {
  Rig rig;  // its hand is the one at the station
  std::int64_t now_ns = 1000 * kMs;
  Pipe to_stylet, to_station;
  End near{&to_station, &to_stylet}, far{&to_stylet, &to_station};
  PeerDevice peer;
  StationConfig config;
  StationState station = station_start(5);
  Device hand;
  struct Tick {
    Vec3 force_n;         // on the hand
    std::int64_t age_ns;  // age of its model: since the sample that it answers
    Vec3 stylet_n;        // what the first machine's guard let through
    Fault fault;
  };
  std::vector<Tick> ticks;

  TwoStations(const Weather& weather, unsigned seed, float coupling_n_per_m = 400)
      : to_stylet{&now_ns, weather, std::mt19937(seed), {}},
        to_station{&now_ns, weather, std::mt19937(seed + 1), {}} {
    peer.link = link_of(near);
    peer.clock = {this, [](void* self) { return static_cast<TwoStations*>(self)->now_ns; },
                  nullptr};
    rig.hand.script =
        make_script({Waypoint{.travel_m = 0.018F, .speed_m_per_s = 0.03F, .hold_s = 0.5F}}, 0.001F);
    hand = rig.device();
    rig.config.hand[0].coupling.stiffness_n_per_m = coupling_n_per_m;
    rig.config.hand[0].guard.watchdog_s = 0.015F;
    config.guard = rig.config.hand[0].guard;
    config.max_torque_nm = 0.05F;
  }

  void run(int count) {
    for (int i = 0; i < count; ++i) {
      now_ns += kMs;
      station_tick(config, station, hand, link_of(far), now_ns + kOtherClockNs);
      tick_stylet();
      ticks.push_back({station.force_n, now_ns + kOtherClockNs - station.obeyed.newest.echo_t_ns,
                       rig.state.hand[0].guard.force_n, rig.state.hand[0].guard.fault});
    }
  }

  // One tick of the first machine's loop.
  void tick_stylet() {
    const Device device = peer_device(peer);
    rig.config.ticks = rig.state.ticks + 1;
    rig.time.now_ns = now_ns - kMs;
    rig.config.lets_go = false;
    run_loop(rig.config, rig.instance->kernel, std::span(&device, 1), virtual_clock(rig.time), {},
             rig.state);
  }
};

double of(Vec3 v) {
  return std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
}

double mean_force(const std::vector<TwoStations::Tick>& ticks, std::size_t from) {
  double sum = 0;
  for (std::size_t i = from; i < ticks.size(); ++i) sum += of(ticks[i].force_n);
  return sum / static_cast<double>(ticks.size() - from);
}

// No force on the hand is older than the life of a force.
void expect_nothing_stale(const std::vector<TwoStations::Tick>& ticks) {
  for (const auto& tick : ticks) {
    if (tick.age_ns >= kForceLifeNs) {
      EXPECT_EQ(of(tick.force_n), 0);
    }
  }
}

TEST(TwoStations, HandFeelsTheTissueOfTheOtherMachine) {
  TwoStations both({.delay_ns = 300'000}, 1);
  both.run(1000);
  EXPECT_EQ(both.rig.state.hand[0].guard.fault, Fault::kNone);
  EXPECT_GT(mean_force(both.ticks, 600), 0.05);
  EXPECT_NEAR(mean_force(both.ticks, 900), of(both.ticks.back().stylet_n), 0.02);
  EXPECT_GT(both.rig.state.events_seen, 0U);
}

// The torque is set here, since the rig's needle asks for hardly any.
TEST(TwoStations, TorqueOfTheOtherMachineIsRenderedGuardedAndEndsWithTheForce) {
  TwoStations both({.delay_ns = 300'000}, 1);
  const Device device = peer_device(both.peer);
  const auto exchange = [&](Vec3 torque_nm, bool answers) {
    both.now_ns += kMs;
    station_tick(both.config, both.station, both.hand, link_of(both.far),
                 both.now_ns + kOtherClockNs);
    Sample sample = {};
    (void)device.read(device.self, both.now_ns, sample);
    if (answers)
      device.write(device.self, {.force_n = {}, .torque_nm = torque_nm, .max_force_n = 1});
  };
  for (int i = 0; i < 300; ++i) exchange({0.01F, -0.02F, 0.03F}, true);
  EXPECT_NEAR(of(both.station.torque_nm), of({0.01F, -0.02F, 0.03F}), 1e-6);
  EXPECT_EQ(both.station.torque_nm.y, -0.02F);
  for (int i = 0; i < 300; ++i) exchange({0, 1, 0}, true);
  EXPECT_NEAR(both.station.torque_nm.y, 0.05F, 1e-6F);
  for (int i = 0; i < 21; ++i) exchange({}, false);
  EXPECT_EQ(of(both.station.torque_nm), 0);
}

// Whatever another maker's program asks for, a force that the guard cuts off must not outlive its
// model.
TEST(TwoStations, ForceBeyondTheDevicesLimitEndsWithItsModelToo) {
  TwoStations both({.delay_ns = 300'000}, 1);
  both.config = station_config({"a Touch", 3, 100});
  const Device device = peer_device(both.peer);
  for (int i = 0; i < 600; ++i) {
    both.now_ns += kMs;
    station_tick(both.config, both.station, both.hand, link_of(both.far),
                 both.now_ns + kOtherClockNs);
    Sample sample = {};
    (void)device.read(device.self, both.now_ns, sample);
    if (i < 500) device.write(device.self, {.force_n = {0, 50, 0}, .max_force_n = 50});
    if (i == 499) {
      EXPECT_NEAR(of(both.station.force_n), 3, 1e-3);
    }
    if (i >= 521) {
      ASSERT_EQ(of(both.station.force_n), 0) << i;
    }
  }
}

// A fault of the station shows as silence. After it is acknowledged there and then at the first
// machine, the hand feels again.
TEST(TwoStations, AcknowledgedFaultOfTheStationLetsItSendAgain) {
  TwoStations both({.delay_ns = 300'000}, 3);
  both.run(700);
  guard_trip(both.station.guard, Fault::kTooLate);
  both.run(100);
  ASSERT_EQ(both.rig.state.hand[0].guard.fault, Fault::kDeviceSilent);
  FaultMailbox mailbox;
  mailbox.seen = LatchedFault{Fault::kTooLate, 1};
  exchange_mail(mailbox, both.station.guard);
  EXPECT_EQ(mailbox.latched.load(), LatchedFault{});
  both.run(50);
  EXPECT_EQ(of(both.station.force_n), 0);
  both.rig.state.mailbox[0].seen = LatchedFault{Fault::kDeviceSilent, 1};
  both.run(200);
  EXPECT_EQ(both.rig.state.hand[0].guard.fault, Fault::kNone);
  EXPECT_GT(of(both.ticks.back().force_n), 0.05);
}

// The first machine keeps the limits of the session with which it began.
TEST(TwoStations, ADeviceWithOtherLimitsDoesNotReplaceTheFirst) {
  TwoStations both({}, 1);
  both.run(50);
  both.station = station_start(6);
  both.config.limits.max_stiffness_n_per_m = 400;
  both.run(300);
  EXPECT_EQ(both.peer.newest.session, 5U);
  const Device device = peer_device(both.peer);
  EXPECT_NE(device.trouble(device.self).find("another device"), std::string::npos);
}

TEST(TwoStations, StationKeepsToItsDevicesLimitsAndReportsThem) {
  const DeviceInfo touch = {.name = "a Touch",
                            .max_force_n = 3,
                            .max_slew_n_per_s = 100,
                            .max_stiffness_n_per_m = 400,
                            .max_torque_nm = 0.1F,
                            .continuous_force_n = 0.88F};
  const StationConfig config = station_config(touch);
  EXPECT_EQ(config.guard.max_force_n, 3);
  EXPECT_EQ(config.guard.continuous_force_n, 0.88F);
  EXPECT_GE(config.guard.max_slew_n_per_s * kDecayS, 3) << "a fault could not fade in time";
  EXPECT_EQ(config.max_torque_nm, 0.1F);
  EXPECT_EQ(config.limits, (RenderLimits{3, 400, 0.88F, 0.1F}));
  const StationConfig mouse = station_config({"a mouse", 0, 0});
  EXPECT_EQ(mouse.limits.max_torque_nm, 0);
  EXPECT_EQ(mouse.guard.watchdog_s, 5e-3F);
  const DeviceInfo packets = {
      .name = "a peer", .max_force_n = 3, .max_slew_n_per_s = 100, .force_life_s = 20e-3F};
  EXPECT_EQ(station_config(packets).guard.watchdog_s, 15e-3F);
}

TEST(TwoStations, LossReorderAndDuplicatesAreNotFelt) {
  TwoStations calm({.delay_ns = kMs}, 1);
  calm.run(1000);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    TwoStations rough({.loss = 0.1, .twice = 0.2, .delay_ns = kMs, .jitter_ns = 3 * kMs}, seed);
    rough.run(1000);
    EXPECT_EQ(rough.rig.state.hand[0].guard.fault, Fault::kNone) << seed;
    EXPECT_EQ(rough.station.guard.fault, Fault::kNone) << seed;
    EXPECT_GT(rough.station.refused, 100U) << seed;
    expect_nothing_stale(rough.ticks);
    EXPECT_NEAR(mean_force(rough.ticks, 600), mean_force(calm.ticks, 600), 0.03) << seed;
    // Between two ticks the force changes as tissue and spring change it, without a jump.
    for (std::size_t i = 101; i < rough.ticks.size(); ++i) {
      const Vec3 &a = rough.ticks[i - 1].force_n, &b = rough.ticks[i].force_n;
      EXPECT_LT(of({b.x - a.x, b.y - a.y, b.z - a.z}), 0.2) << seed << " tick " << i;
    }
  }
}

// All packets of 50 ms come at once, at the end of this stall. Whenever it begins, the force is
// gone when the life of the last packet is over, and does not come back before somebody
// acknowledges.
TEST(TwoStations, StallEndsTheForceAndIsLatched) {
  for (int from = 400; from < 900; from += 7) {
    TwoStations both({.loss = 0.05,
                      .delay_ns = 300'000,
                      .jitter_ns = 2 * kMs,
                      .stall_from_ns = (1000 + from) * kMs,
                      .stall_ns = 50 * kMs},
                     static_cast<unsigned>(from));
    both.run(from + 150);
    expect_nothing_stale(both.ticks);
    EXPECT_EQ(both.rig.state.hand[0].guard.fault, Fault::kDeviceSilent) << from;
    for (std::size_t i = static_cast<std::size_t>(from) + 21; i < both.ticks.size(); ++i) {
      ASSERT_EQ(of(both.ticks[i].force_n), 0) << from << " tick " << i;
    }
  }
}

TEST(TwoStations, AcknowledgedStallFadesBackIn) {
  TwoStations both({.delay_ns = 300'000, .stall_from_ns = 1700 * kMs, .stall_ns = 50 * kMs}, 3);
  both.run(900);
  ASSERT_EQ(both.rig.state.hand[0].guard.fault, Fault::kDeviceSilent);
  ASSERT_TRUE(guard_rearm(both.rig.state.hand[0].guard, Fault::kDeviceSilent));
  both.run(200);
  EXPECT_GT(of(both.ticks.back().force_n), 0.05);
  EXPECT_EQ(both.rig.state.hand[0].guard.fault, Fault::kNone);
}

// The peer's clock is another one and drifts: the guard sees how old a sample is, not the drift.
TEST(TwoStations, SampleHeldUpOnTheWayIsOld) {
  TwoStations both({.delay_ns = kMs}, 1);
  both.run(100);
  const Device device = peer_device(both.peer);
  SamplePacket late;
  late.session = 5;
  late.seq = both.peer.newest.seq + 1;
  late.t_ns = both.now_ns + kOtherClockNs - 30 * kMs;
  both.to_stylet.under_way = {{both.now_ns, {}}};
  const auto bytes = encode(late);
  both.to_stylet.under_way[0].bytes.assign(bytes.begin(), bytes.end());
  Sample sample = {};
  ASSERT_TRUE(device.read(device.self, both.now_ns, sample));
  EXPECT_NEAR(static_cast<double>(both.now_ns - sample.t_ns), 29e6, 0.5e6);
}

TEST(TwoStations, NewSessionIsAcceptedWhenTheOldOneIsSilent) {
  TwoStations both({}, 1);
  both.run(50);
  const std::uint64_t before = both.peer.seq;
  both.station = station_start(6);  // started again: its seq begins at 1
  both.run(90);
  EXPECT_EQ(both.peer.newest.session, 5U);
  both.run(50);
  EXPECT_EQ(both.peer.newest.session, 6U);
  EXPECT_GT(both.peer.seq, before);
}

// The station's program dies while a force is under way: the hand is free when the life of that
// force is over. So it is if the first machine dies.
TEST(TwoStations, EitherMachineMayDie) {
  TwoStations both({.delay_ns = 300'000}, 2);
  both.run(800);
  ASSERT_GT(of(both.ticks.back().force_n), 0.05);
  for (int i = 0; i < 60; ++i) {
    both.now_ns += kMs;
    station_tick(both.config, both.station, both.hand, link_of(both.far),
                 both.now_ns + kOtherClockNs);
    if (i < 20) continue;
    EXPECT_EQ(of(both.station.force_n), 0) << i;
  }
}

}  // namespace
}  // namespace stylet::hal
