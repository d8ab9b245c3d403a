// SPDX-License-Identifier: Apache-2.0
// The force that a hand feels after each kind of fault: for every backend that renders force, in a
// process in virtual time, from the moment at which the fault is seen until half a second later.
// What is measured is the table "Forces after a fault" in hal/guard/GUARD.md; this test compares
// them, and writes the table anew if STYLET_WRITE is set.
//
// The guard lets 2 N through when the trouble begins, and from then on the kernel asks for 3 N, the
// largest force: what could be more than before is the worst that a kernel can do.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "motor_backends.h"
#include "motor_judge.h"
#include "peer_hand.h"
#include "virtual_process.h"

namespace stylet::hal {
namespace {

constexpr float kBeforeN = 2, kMostN = 3;
constexpr std::int64_t kBeforeNs = 300 * kMs, kAfterNs = 650 * kMs;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A link that can be cut.
struct Cable {
  Link inner;
  bool cut = false;

  Link link() {
    return {this,
            [](void* self, std::span<const std::byte> packet) {
              Cable& cable = *static_cast<Cable*>(self);
              if (!cable.cut) cable.inner.send(cable.inner.self, packet);
            },
            [](void* self, std::span<std::byte> room) -> std::optional<std::size_t> {
              Cable& cable = *static_cast<Cable*>(self);
              const auto got = cable.inner.receive(cable.inner.self, room);
              return cable.cut && got ? std::optional<std::size_t>(0) : got;
            },
            nullptr,
            [](void* self) {
              Cable& cable = *static_cast<Cable*>(self);
              cable.inner.close(cable.inner.self);
            }};
  }
};

// A backend with everything around it, and the force on its hand.
struct Chain {
  Backend backend;
  Cable cable;
  std::unique_ptr<Bench> bench;
  std::unique_ptr<PeerHand> peer;
  std::unique_ptr<StationHand> station;
  std::unique_ptr<Ticker> ticker;
  float asked_n = kBeforeN;
  // Since the fault was seen.
  std::int64_t seen_ns = 0, zero_ns = 0;
  double last_n = 0, peak_n = 0;
  bool grew = false;

  explicit Chain(const Backend& of) : backend(of) {
    const std::string port = test_port();
    if (backend.bench != nullptr) bench = backend.bench();
    const std::string uri = backend.uri != nullptr ? backend.uri + port : bench->uri();
    if (uri.starts_with("shm:")) std::ofstream("/dev/shm/stylet." + uri.substr(4));
    if (backend.link != nullptr) cable.inner = backend.link(port);
    if (backend.motors == Motors::kPeer) {
      peer = std::make_unique<PeerHand>(weather(), Stalls{}, 0);
    }
    if (backend.motors == Motors::kStation) {
      station = std::make_unique<StationHand>(weather(), Stalls{}, open_device(bench->uri()));
      station->acknowledges = false;
    }
    ticker = std::make_unique<Ticker>(open_device(uri), 3e-3F);
    GuardConfig& guard = ticker->guard;
    guard.max_force_n = guard.continuous_force_n = kMostN;
    guard.max_slew_n_per_s = std::max(ticker->device.info.max_slew_n_per_s, kMostN / kDecayS);
    guard.max_speed_m_per_s = 2;
    guard.stored_energy_j = 0.1F;
    guard.passivity_damping_n_s_per_m = 1;  // without any, energy is only observed
    guard.buzz_n = 0.1F * kMostN;
  }
  ~Chain() {
    test::enter_virtual_time() = {};
    if (bench != nullptr) bench->hang(test::Hang::kNone);
    ticker.reset();
    peer.reset();
    station.reset();
  }
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;

  Weather weather() {
    Weather out;
    out.inner = cable.link();
    return out;
  }
  Vec3 felt() const { return peer != nullptr ? peer->force_n : bench->felt(); }
  void move(const Pose& pose) {
    if (bench != nullptr) bench->move(pose);
    if (peer != nullptr) peer->pose = pose;
  }
  void move_to(float z_m) { move({{0, 0, z_m}, {1, 0, 0, 0}}); }
  void tick() { ticker->tick({0, 0, asked_n}); }
  Fault fault() const {
    const Fault here = ticker->state.fault;
    return here == Fault::kNone && station != nullptr ? station->state.guard.fault : here;
  }

  // Called whenever a thread begins to wait.
  void look() {
    if (seen_ns == 0) return;
    const double now_n = size(felt());
    const std::int64_t now_ns = test::virtual_now_ns();
    // The force of an order that was under way may come through.
    const double lag_ms = backend.motors == Motors::kLibrary ? 2 : kZeroMs;
    if (ms(now_ns - seen_ns) > lag_ms) grew = grew || now_n > last_n + 1e-5;
    peak_n = std::max(peak_n, now_n);
    if (now_n == 0 && last_n > 0) zero_ns = now_ns;
    last_n = now_n;
  }
  void see() {
    if (seen_ns != 0) return;
    seen_ns = zero_ns = test::virtual_now_ns();
    last_n = peak_n = size(felt());
  }
};

struct Cause {
  const char* what;
  void (*begin)(Chain& chain) = [](Chain&) {};
  // Instead of a tick, `passed_ms` after the trouble has begun.
  void (*tick)(Chain& chain, double passed_ms) = [](Chain& chain, double) { chain.tick(); };
  bool (*fits)(const Backend& backend) = [](const Backend&) { return true; };
  bool nobody_sees = false;  // the loop stands still: what follows counts from the last tick
};

void sleep_virtual(double for_ms) {
  test::sleep_until_virtual(test::virtual_now_ns() + static_cast<std::int64_t>(for_ms * 1e6));
}

bool has_vendor(const Backend& backend) {
  return backend.bench != nullptr;
}

const Cause kCauses[] = {
    {.what = "the kernel asks for NaN", .begin = [](Chain& chain) { chain.asked_n = kNan; }},
    {.what = "the measured position is NaN", .begin = [](Chain& chain) { chain.move_to(kNan); }},
    {.what = "the device is there, but measures nothing new",
     .begin = [](Chain& chain) { chain.bench->trouble(test::Trouble::kSilent); },
     .fits = has_vendor},
    {.what = "the device is unplugged",
     .begin = [](Chain& chain) { chain.bench->trouble(test::Trouble::kNoAnswer); },
     .fits = has_vendor},
    {.what = "the network is cut, or nothing comes through shared memory",
     .begin = [](Chain& chain) { chain.cable.cut = true; },
     .fits = [](const Backend& backend) { return backend.link != nullptr; }},
    {.what = "a call into the vendor's library does not return",
     .begin = [](Chain& chain) { chain.bench->hang(test::Hang::kWrite); },
     .fits =
         [](const Backend& backend) {
           return has_vendor(backend) && backend.motors != Motors::kService && backend.may_hang;
         }},
    {.what = "the loop loses 8 of every 11 ticks",
     .tick =
         [](Chain& chain, double passed_ms) {
           if (std::fmod(passed_ms, 11) < 1) sleep_virtual(8);
           chain.tick();
         }},
    {.what = "the loop stops for 100 ms",
     .tick =
         [](Chain& chain, double passed_ms) {
           if (passed_ms < 1) sleep_virtual(100);
           chain.tick();
         },
     .nobody_sees = true},
    {.what = "the kernel reports a fault",
     .begin = [](Chain& chain) { guard_trip(chain.ticker->state, Fault::kKernelFault); }},
    {.what = "the measured position jumps by 50 mm and stays",
     .begin = [](Chain& chain) { chain.move_to(0.05F); }},
    {.what = "the force goes to and fro, 40 times a second",
     .tick =
         [](Chain& chain, double passed_ms) {
           chain.asked_n = std::fmod(passed_ms, 25) < 12.5 ? kMostN : 1;
           chain.tick();
         }},
    {.what = "the force drives the hand at 0.2 m/s",
     .tick =
         [](Chain& chain, double passed_ms) {
           chain.move_to(static_cast<float>(2e-4 * passed_ms));
           chain.tick();
         }},
};

// A cell of the table, such as "3: 15 ms, 0.80 N, 3 ms".
std::string measured(const Backend& backend, const Cause& cause) {
  if (!cause.fits(backend)) return "";
  test::VirtualProcess& process = test::enter_virtual_time();
  process = {};
  Chain chain(backend);
  chain.move_to(0);
  for (const std::int64_t end_ns = test::virtual_now_ns() + kBeforeNs;
       test::virtual_now_ns() < end_ns;) {
    chain.tick();
  }
  EXPECT_EQ(chain.fault(), Fault::kNone) << backend.name << ", " << cause.what;
  EXPECT_NEAR(size(chain.felt()), static_cast<double>(kBeforeN), 1e-3)
      << backend.name << ", " << cause.what;
  process.look = [&chain] { chain.look(); };
  const std::int64_t cause_ns = test::virtual_now_ns();
  chain.asked_n = kMostN;
  cause.begin(chain);
  if (cause.nobody_sees) chain.see();
  while (test::virtual_now_ns() < cause_ns + kAfterNs) {
    cause.tick(chain, ms(test::virtual_now_ns() - cause_ns));
    if (chain.fault() != Fault::kNone) chain.see();
  }
  const std::string where = std::string(backend.name) + ", " + cause.what;
  EXPECT_NE(chain.seen_ns, 0) << where << ": nobody saw a fault";
  EXPECT_NE(chain.fault(), Fault::kNone) << where;
  EXPECT_FALSE(chain.grew) << where << ": the force grew";
  EXPECT_LE(chain.peak_n, static_cast<double>(kMostN) * (1 + 1e-4)) << where;
  // R6; Haply's service keeps a force for as long as it stands still, 21 ms at most.
  const double held_ms = backend.motors == Motors::kService ? 21 : 0;
  const double zero_ms = ms(chain.zero_ns - chain.seen_ns);
  EXPECT_LE(zero_ms, kZeroMs + kSlackMs + held_ms) << where;
  EXPECT_EQ(size(chain.felt()), 0) << where << ": a force that nobody acknowledged";
  const std::string seen =
      cause.nobody_sees ? "–" : fmt::format("{:.0f} ms", ms(chain.seen_ns - cause_ns));
  return fmt::format("{}: {}, {:.2f} N, {:.0f} ms", static_cast<int>(chain.fault()), seen,
                     chain.peak_n, zero_ms);
}

std::string measured_table() {
  const std::vector<Backend> backends = all_backends();
  std::string head = "| cause |", rule = "| --- |", rows;
  for (const Backend& backend : backends) {
    head += fmt::format(" `{}` |", backend.name);
    rule += " --- |";
  }
  for (const Cause& cause : kCauses) {
    rows += fmt::format("| {} |", cause.what);
    for (const Backend& backend : backends) {
      const std::string cell = measured(backend, cause);
      rows += cell.empty() ? " |" : " " + cell + " |";
    }
    rows += "\n";
  }
  return head + "\n" + rule + "\n" + rows;
}

TEST(FaultForces, AreThoseOfTheTable) {
  const std::string begin = "<!-- from tests/hal/fault_forces_test.cpp -->\n", end = "<!-- end -->";
  std::ifstream page(STYLET_GUARD_PAGE);
  std::stringstream read;
  read << page.rdbuf();
  const std::string text = read.str();
  const std::size_t from = text.find(begin), to = text.find(end, from);
  ASSERT_NE(to, std::string::npos) << STYLET_GUARD_PAGE << " has no such table";
  const std::size_t start = from + begin.size();
  const std::string table = measured_table();
  if (std::getenv("STYLET_WRITE") != nullptr && !HasFailure()) {
    std::ofstream(STYLET_GUARD_PAGE) << text.substr(0, start) << table << text.substr(to);
    return;
  }
  EXPECT_EQ(text.substr(start, to - start), table)
      << "if that is meant: STYLET_WRITE=1 build/release/bin/hal_motor_backends "
         "--gtest_filter=FaultForces.*";
}

}  // namespace
}  // namespace stylet::hal
