// SPDX-License-Identifier: Apache-2.0
// Two stations through real sockets of this machine. A relay between them loses, doubles, delays
// and reorders packets by a seed, and stalls when it is told to.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <mutex>
#include <random>
#include <vector>

#include "device_bench.h"
#include "hal/device/link.h"
#include "hal/loop/station.h"

namespace stylet::hal {
namespace {

constexpr std::int64_t kMs = 1'000'000;

// One direction. What happens to a packet depends only on its number and the seed.
class Weather {
 public:
  explicit Weather(unsigned seed) : random_(seed) {}
  void take(std::span<const std::byte> bytes, std::int64_t now_ns, std::int64_t not_before_ns) {
    std::uniform_real_distribution<double> chance(0, 1);
    const bool lost = chance(random_) < 0.1;
    const int copies = chance(random_) < 0.2 ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      const auto delay_ns = static_cast<std::int64_t>(3e6 * chance(random_));
      if (lost) continue;
      under_way_.push_back(
          {std::max(now_ns + delay_ns, not_before_ns), {bytes.begin(), bytes.end()}});
    }
  }
  template <typename Send>
  void deliver(std::int64_t now_ns, Send&& send) {
    for (std::size_t i = under_way_.size(); i-- > 0;) {  // the newest first: out of order
      if (under_way_[i].due_ns > now_ns) continue;
      send(under_way_[i].bytes);
      under_way_.erase(under_way_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

 private:
  struct Packet {
    std::int64_t due_ns;
    std::vector<std::byte> bytes;
  };
  std::mt19937 random_;
  std::vector<Packet> under_way_;
};

class Relayer {
 public:
  explicit Relayer(unsigned seed) : to_stylet_(seed), to_station_(seed + 1) {
    front_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    back_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in own = address(0);  // any free port
    const sockaddr_in stylet = address(std::stoi(test_port()));
    socklen_t size = sizeof own;
    EXPECT_EQ(bind(front_, reinterpret_cast<const sockaddr*>(&own), size), 0);
    EXPECT_EQ(getsockname(front_, reinterpret_cast<sockaddr*>(&own), &size), 0);
    port_ = ntohs(own.sin_port);
    EXPECT_EQ(connect(back_, reinterpret_cast<const sockaddr*>(&stylet), sizeof stylet), 0);
    thread_ = std::thread([this] {
      while (!stop_) pass();
    });
  }
  ~Relayer() {
    stop_ = true;
    thread_.join();
    close(front_);
    close(back_);
  }
  Relayer(const Relayer&) = delete;
  Relayer& operator=(const Relayer&) = delete;
  int port() const { return port_; }
  void stall(std::int64_t until_ns) { stalled_until_ns_ = until_ns; }

 private:
  static sockaddr_in address(int port) {
    sockaddr_in at = {};
    at.sin_family = AF_INET;
    at.sin_port = htons(static_cast<std::uint16_t>(port));
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return at;
  }
  void pass() {
    pollfd both[] = {{front_, POLLIN, 0}, {back_, POLLIN, 0}};
    (void)::poll(both, 2, 1);
    std::array<std::byte, 256> room;
    const std::int64_t now_ns = monotonic_now_ns();
    socklen_t size = sizeof station_;
    for (ssize_t got = 0; (got = recvfrom(front_, room.data(), room.size(), MSG_DONTWAIT,
                                          reinterpret_cast<sockaddr*>(&station_), &size)) > 0;) {
      to_stylet_.take(std::span(room).first(static_cast<std::size_t>(got)), now_ns,
                      stalled_until_ns_);
    }
    for (ssize_t got = 0; (got = recv(back_, room.data(), room.size(), MSG_DONTWAIT)) > 0;) {
      to_station_.take(std::span(room).first(static_cast<std::size_t>(got)), now_ns,
                       stalled_until_ns_);
    }
    to_stylet_.deliver(now_ns, [&](const auto& bytes) {
      (void)send(back_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    });
    to_station_.deliver(now_ns, [&](const auto& bytes) {
      (void)sendto(front_, bytes.data(), bytes.size(), MSG_NOSIGNAL,
                   reinterpret_cast<const sockaddr*>(&station_), sizeof station_);
    });
  }

  int front_ = -1, back_ = -1, port_ = 0;
  sockaddr_in station_ = {};
  Weather to_stylet_, to_station_;
  std::atomic<std::int64_t> stalled_until_ns_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// The second machine: a device that swings by 10 mm along z, and its station.
class SecondMachine {
 public:
  explicit SecondMachine(int port) : thread_([this, port] { run(port); }) {}
  ~SecondMachine() { stop(); }
  SecondMachine(const SecondMachine&) = delete;
  SecondMachine& operator=(const SecondMachine&) = delete;
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

  struct Tick {
    std::int64_t now_ns, age_ns;  // age of the model that is felt
    double force_n;
    bool punctual;  // as were the last 30 ticks: no busy machine aged the force
  };
  std::vector<Tick> ticks;  // after stop
  std::atomic<double> felt_n{0};
  std::atomic<int> punctual_ticks{0};
  StationState state = station_start(3);

 private:
  static bool read(void*, std::int64_t now_ns, Sample& out) {
    static std::uint64_t seq = 0;
    const double phase = static_cast<double>(now_ns) * 1e-9 * 6.28;
    out = {++seq, now_ns, {{0, 0, static_cast<float>(0.01 * std::sin(phase))}, {1, 0, 0, 0}}, 0};
    return true;
  }
  void run(int port) {
    const Link link = udp_connect("127.0.0.1:" + std::to_string(port));
    const Device device = {
        nullptr, {"swinging", 3, 2000}, read, [](void*, const Command&) {}, [](void*) {}};
    const StationConfig config = station_config(device.info);
    std::int64_t last_ns = monotonic_now_ns();
    int punctual = 0;
    while (!stop_) {
      std::this_thread::sleep_for(std::chrono::microseconds(700));
      const std::int64_t now_ns = monotonic_now_ns();
      punctual = now_ns - last_ns < 2 * kMs ? punctual + 1 : 0;
      last_ns = now_ns;
      station_tick(config, state, device, link, now_ns);
      if (state.guard.fault != Fault::kNone) (void)guard_rearm(state.guard, state.guard.fault);
      felt_n = size(state.force_n);
      ticks.push_back({now_ns, now_ns - state.obeyed.newest.echo_t_ns, felt_n, punctual >= 30});
      if (punctual >= 30) ++punctual_ticks;
    }
    link.close(link.self);
  }

  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// The first machine's tissue: a spring of 200 N/m to the middle, and 1 N sideways.
Vec3 spring(const Sample& sample) {
  return {1, 0, -200 * sample.pose.position_m.z};
}

TEST(Loopback, NothingStaleIsFeltThroughRealSocketsAndAStallIsLatched) {
  Relayer relay(7);
  SecondMachine second(relay.port());
  std::int64_t stalled_ns = 0, latched_ns = 0, acknowledged_ns = 0;
  {
    Ticker first("udp:127.0.0.1:" + test_port());
    EXPECT_EQ(first.device.info.max_force_n, 3);
    // Both fade in. On a busy machine both may latch a fault, when it makes them late.
    const auto comes_to_feel = [&second](Ticker& ticker) {
      for (int i = 0; i < 60; ++i) {
        if (ticker.tick_until({1, 0, 0}, [&] { return second.felt_n > 0.5; })) return true;
      }
      return false;
    };
    ASSERT_TRUE(comes_to_feel(first));
    for (int i = 0; i < 1500 || (i < 30000 && second.punctual_ticks < 200); ++i) {
      first.tick(spring(first.sample));
      if (first.state.fault != Fault::kNone) (void)guard_rearm(first.state, first.state.fault);
    }
    ASSERT_TRUE(comes_to_feel(first));
    relay.stall(monotonic_now_ns() + 50 * kMs);
    stalled_ns = monotonic_now_ns();
    while (monotonic_now_ns() < stalled_ns + 200 * kMs) {
      first.tick({1, 0, 0});
      if (latched_ns == 0 && first.state.fault != Fault::kNone) latched_ns = monotonic_now_ns();
    }
    EXPECT_NE(first.state.fault, Fault::kNone);
    acknowledged_ns = monotonic_now_ns();
    EXPECT_TRUE(comes_to_feel(first));
  }
  second.stop();
  EXPECT_GT(second.state.refused, 100U);  // duplicates, and packets that were overtaken
  int judged = 0;
  for (const auto& tick : second.ticks) {
    if (!tick.punctual) continue;
    ++judged;
    if (tick.age_ns >= kForceLifeNs) {
      EXPECT_EQ(tick.force_n, 0) << "of " << tick.age_ns << " ns";
    }
    if (tick.now_ns > stalled_ns + kForceLifeNs && tick.now_ns < acknowledged_ns) {
      EXPECT_EQ(tick.force_n, 0) << (tick.now_ns - stalled_ns) / kMs << " ms";
    }
  }
  EXPECT_GT(latched_ns, 0);
  if (judged == 0) GTEST_SKIP() << "this machine was never on time for 20 ms: nothing was judged";
}

}  // namespace
}  // namespace stylet::hal
