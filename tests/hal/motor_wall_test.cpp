// SPDX-License-Identifier: Apache-2.0
// The force that a hand gets from the whole chain, in real time: the sessions of
// motor_backends_test.cpp with the threads, sleeps and preemptions of this machine, which virtual
// time cannot have. Stalls of the loop, calls of the vendor that do not return, failures and
// reopenings are random. Another thread looks at the motors ten thousand times a second.
//
// A machine that runs tests does not keep time. Linux knows who waits for a processor (schedstat):
// if a promise of time is broken while one of our threads waited, that says nothing about the code;
// it is reported, but is no failure.
#include <gmock/gmock.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>
#include <ostream>
#include <thread>

#include "device_bench.h"
#include "hal/device/devices.h"
#include "motor_draw.h"
#include "rig.h"

namespace stylet::hal {
namespace {

constexpr double kZeroMs = 25;    // from any fault to zero force: GUARD.md, R6
constexpr double kSlackMs = 1.2;  // a write each millisecond, and the interval of looks
constexpr double kLateMs = 1.5;   // a longer wait for a processor is the machine's stall

double ms(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

// A thread that calls something again and again, until it is destroyed.
class Beside {
 public:
  template <typename Work>
  Beside(std::chrono::microseconds every, Work work)
      : thread_([this, every, work] {
          while (!stop_.load()) {
            work();
            std::this_thread::sleep_for(every);
          }
        }) {}
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  ~Beside() {
    stop_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

struct Span {
  std::int64_t from_ns = 0, to_ns = 0;
};

// When threads of this process waited for a processor, or the machine stood still.
class Machine {
 public:
  std::vector<Span> stalls() const {
    const std::lock_guard lock(mutex_);
    return stalls_;
  }
  static bool is_known() { return std::ifstream("/proc/self/schedstat").good(); }

 private:
  void look() {
    const std::lock_guard lock(mutex_);
    const std::int64_t now_ns = monotonic_now_ns();
    const auto late = [&](std::int64_t waited_ns) {
      if (ms(waited_ns) > kLateMs) stalls_.push_back({now_ns - waited_ns - kMs, now_ns});
    };
    if (looked_ns_ != 0) late(now_ns - looked_ns_ - kMs);
    looked_ns_ = now_ns;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
      std::int64_t ran_ns = 0, waited_ns = 0;
      std::ifstream(task.path() / "schedstat") >> ran_ns >> waited_ns;
      const auto [known, is_new] = waited_ns_.emplace(task.path().filename(), waited_ns);
      if (!is_new) late(waited_ns - known->second);
      known->second = waited_ns;
    }
  }

  mutable std::mutex mutex_;
  std::vector<Span> stalls_;
  std::map<std::string, std::int64_t> waited_ns_;
  std::int64_t looked_ns_ = 0;
  Beside beside_{std::chrono::microseconds(1000), [this] { look(); }};
};

struct Complaint {
  std::int64_t t_ns;
  std::string what;
};

// Looks at the motors from outside. The loop's thread announces a force before it gives it, so that
// this thread never sees a force before its announcement.
struct Judge {
  explicit Judge(Bench& of) : bench(of) {}
  Bench& bench;
  double most_n = 0, slew_n_per_s = 0;
  std::atomic<std::int64_t> ordered_ns = 0, fault_ns = 0, trouble_ns = 0;  // 0: none
  std::atomic<int> acknowledgements = 0;
  std::atomic<bool> forced = false;

  std::vector<Complaint> complaints;
  std::int64_t looked_ns = 0, before_write_ns = 0;  // no later than the newest write
  Vec3 last_n = {};
  int last_writes = 0, acknowledged_then = 0;
  bool over = false;
  double strongest_n = 0;

  void fail(std::int64_t t_ns, const std::string& what) {
    constexpr std::size_t kMost = 1000;
    if (complaints.size() < kMost) complaints.push_back({t_ns, what});
  }

  void look() {
    const int acknowledged = acknowledgements.load();
    const std::int64_t before_ns = monotonic_now_ns();
    const int writes = bench.writes();
    const Vec3 force = bench.felt();
    if (bench.writes() != writes || size(minus(force, bench.felt())) > 0) return;  // half written
    const std::int64_t fault = fault_ns.load(), ordered = ordered_ns.load();
    const double force_size_n = size(force), change = size(minus(force, last_n));
    strongest_n = std::max(strongest_n, force_size_n);
    if (force_size_n > 0) forced = true;
    if (!std::isfinite(force_size_n)) fail(before_ns, "not finite");
    if (force_size_n > most_n * (1 + 1e-4))
      fail(before_ns, "over the limit: " + std::to_string(force_size_n));
    judge_step(change, force_size_n, writes != last_writes);
    if (acknowledged != acknowledged_then) over = false;
    acknowledged_then = acknowledged;
    const bool late = ordered != 0 && ms(before_ns - ordered) > kZeroMs + kSlackMs;
    const bool faulty = fault != 0 && ms(before_ns - fault) > kZeroMs + kSlackMs;
    if (force_size_n > 0 && (late || faulty)) {
      fail(before_ns, std::to_string(force_size_n) + " N " +
                          std::to_string(ms(before_ns - (faulty ? fault : ordered))) +
                          (faulty ? " ms after a fault" : " ms after the newest order"));
    }
    if (force_size_n > 0 && over && acknowledgements.load() == acknowledged) {
      fail(before_ns, "force before somebody acknowledged");
    }
    over = over || late;
    if (writes != last_writes || change > 0) before_write_ns = looked_ns;
    looked_ns = before_ns;
    last_writes = writes;
    last_n = force;
  }

  // A write that this look sees may have come just after the look before. So it may be as large as
  // the slew limit allows for the time since the look before that one.
  void judge_step(double change, double size, bool wrote) {
    const std::int64_t now_ns = monotonic_now_ns();
    const double passed_ms = before_write_ns == 0 ? 1e9 : ms(now_ns - before_write_ns);
    const bool cut = size == 0 && (now_ns < trouble_ns.load() || passed_ms > 9.9);
    if (change <= slew_n_per_s * 1e-3 * passed_ms * (1 + 1e-4) + 1e-5 || cut) return;
    fail(now_ns, "a step of " + std::to_string(change) + " N in " + std::to_string(passed_ms) +
                     (wrote ? " ms" : " ms, without a write"));
  }
};

enum class Kind { kHd, kDhd };
const char* name_of(Kind kind) {
  return kind == Kind::kHd ? "hd" : "dhd";
}
void PrintTo(Kind kind, std::ostream* out) {
  *out << name_of(kind);
}

struct Session {
  Draw draw;
  Rig rig;
  std::unique_ptr<Bench> bench;
  Judge judge;
  Device device = {}, seen = {};
  Stalls loop, driver;
  double trouble = 0, hand_hz = 1;
  std::int64_t upset_until_ns = 0;
  std::uint32_t arming = 1;
  bool armed_anew = false;  // armed again, but no order has come yet

  Session(std::uint64_t seed, Kind kind)
      : draw(seed), bench(kind == Kind::kHd ? hd_bench() : dhd_bench()), judge(*bench) {
    loop = Stalls::drawn(draw);
    driver = Stalls::drawn(draw);
    trouble = draw.chance(0.5) ? 0 : draw.between(0, 0.002);
    hand_hz = draw.between(0.5, 8);
    move_hand();
    device = open_lasting_device(bench->uri());
    seen = {this, device.info, read, write, nullptr, nullptr, nullptr, motor};
    configure();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() {
    bench->hang(test::Hang::kNone);
    device.close(device.self);
  }

  void configure() {
    HandConfig& hand = rig.config.hand[0];
    GuardConfig& guard = hand.guard;
    guard.max_force_n = static_cast<float>(
        std::min(draw.between(0.5, 12), static_cast<double>(device.info.max_force_n)));
    guard.max_slew_n_per_s = std::max(device.info.max_slew_n_per_s, guard.max_force_n / kDecayS);
    guard.ramp_s = draw.chance(0.3) ? 0 : static_cast<float>(draw.between(0, 0.1));
    guard.watchdog_s = watchdog_of(device.info, static_cast<float>(draw.between(3e-3, 5e-3)));
    guard.max_speed_m_per_s = 5;
    guard.stored_energy_j = 1e6F;
    guard.buzz_n = 100;
    guard.continuous_force_n = guard.max_force_n;
    hand.grip.enabled = true;
    hand.grip.force_scale = static_cast<float>(draw.between(5, 60));
    judge.most_n = static_cast<double>(guard.max_force_n);
    judge.slew_n_per_s = static_cast<double>(device.info.max_slew_n_per_s);
  }

  // ---- the loop's side

  static bool read(void* self, std::int64_t tick_ns, Sample& out) {
    Session& s = *static_cast<Session*>(self);
    return s.device.read(s.device.self, tick_ns, out);
  }
  static void write(void* self, const Command& command) {
    Session& s = *static_cast<Session*>(self);
    // Before there was any force, a fault that is over needs no acknowledgement.
    if (command.arming != s.arming && !s.judge.forced.load()) s.acknowledged();
    s.arming = command.arming;
    // With the next order forces may come again.
    if (s.armed_anew) ++s.judge.acknowledgements;
    s.armed_anew = false;
    s.judge.ordered_ns = monotonic_now_ns();
    s.device.write(s.device.self, command);
    s.note_fault();
  }
  static bool motor(void* self, MotorReport& out) {
    Session& s = *static_cast<Session*>(self);
    return s.device.motor(s.device.self, out);
  }

  GuardState& guard() { return rig.state.hand[0].guard; }
  void fault() {
    if (judge.fault_ns.load() == 0) judge.fault_ns = monotonic_now_ns();
  }
  void note_fault() {
    if (guard().fault != Fault::kNone) fault();
  }
  void acknowledged() {
    judge.fault_ns = 0;
    armed_anew = true;
  }
  void stall(std::int64_t until_ns) { monotonic_clock().sleep_until_ns(nullptr, until_ns); }

  // Time until the loop's next tick.
  void sleep_until(std::int64_t t_ns) {
    note_fault();
    if (guard().fault != Fault::kNone && draw.chance(0.02) && guard_rearm(guard(), guard().fault)) {
      acknowledged();
    }
    upset();
    stall(t_ns);
    if (loop.busy(draw, t_ns)) stall(loop.until_ns);
    move_hand();
  }

  void move_hand() {
    const double t = ms(monotonic_now_ns()) * 1e-3;
    const double way_m = -0.004 + 0.008 * std::sin(6.283 * hand_hz * t);
    bench->move({{0, 0, static_cast<float>(way_m)}, {1, 0, 0, 0}});
  }

  // A vendor's call that does not return for a while, or fails.
  void upset() {
    const std::int64_t now_ns = monotonic_now_ns();
    if (now_ns < upset_until_ns) return;
    bench->hang(test::Hang::kNone);
    bench->trouble(test::Trouble::kNone);
    if (driver.busy(draw, now_ns)) {
      upset_until_ns = driver.until_ns;
      judge.trouble_ns = upset_until_ns + 100 * kMs;
      bench->hang(test::Hang::kRead);
    } else if (draw.chance(trouble)) {
      upset_until_ns = now_ns + draw.ms(5, 100);
      judge.trouble_ns = upset_until_ns + 100 * kMs;
      bench->trouble(test::Trouble::kNoAnswer);
    }
  }

  // ---- the session

  void run() {
    const Clock clock = {
        this, [](void*) { return monotonic_now_ns(); },
        [](void* self, std::int64_t t_ns) { static_cast<Session*>(self)->sleep_until(t_ns); }};
    const Beside looks(std::chrono::microseconds(50), [this] { judge.look(); });
    for (int attempt = 0; attempt < 2; ++attempt) {
      if (attempt > 0) resume();
      rig.config.ticks = static_cast<std::uint64_t>(draw.between(300, 1200));
      run_loop(rig.config, rig.instance->kernel, std::span(&seen, 1), clock, {}, rig.state);
      note_fault();
    }
    fault();  // the end of a run: the force ends in time, and for good
    stall(monotonic_now_ns() + draw.ms(30, 60));
  }

  // Reset and Start, as motor_backends_test.cpp does it.
  void resume() {
    fault();
    const std::int64_t idle_ns = draw.ms(0, 100);
    stall(monotonic_now_ns() + idle_ns);
    const bool had = guard().fault != Fault::kNone;
    const HandState left = rig.state.hand[0];
    std::destroy_at(&rig.state);
    std::construct_at(&rig.state);
    reset(rig.instance->kernel);
    guard() = left.guard;
    rig.state.hand[0].torque_guard = left.torque_guard;
    guard_resume(rig.config.hand[0].guard, guard(), idle_ns);
    guard_resume(rig.config.hand[0].guard, rig.state.hand[0].torque_guard, idle_ns);
    EXPECT_EQ(guard().fault != Fault::kNone, had) << "a latched fault was forgotten";
    if (!had) acknowledged();
  }
};

class MotorWall : public testing::TestWithParam<Kind> {};

TEST_P(MotorWall, GivesTheHandNoForceThatTheRulesForbid) {
  if (!Machine::is_known()) GTEST_SKIP() << "no /proc/self/schedstat: who waits cannot be told";
  const int first = number_from("STYLET_MOTOR_FIRST", 1);
  const int count = number_from("STYLET_MOTOR_SESSIONS", 4);
  double strongest_n = 0;
  int acknowledgements = 0;
  std::size_t named = 0;
  double stalled_ms = 0, longest_ms = 0;
  const std::int64_t began_ns = monotonic_now_ns();
  for (int i = 0; i < count; ++i) {
    const Machine machine;
    Session session(static_cast<std::uint64_t>(first + i), GetParam());
    session.run();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));  // so that waits are over
    const std::vector<Span> stalls = machine.stalls();
    for (const Span& each : stalls) {
      stalled_ms += ms(each.to_ns - each.from_ns);
      longest_ms = std::max(longest_ms, ms(each.to_ns - each.from_ns));
    }
    // A stall of the machine excuses a broken promise if it lies within the time that the promise
    // spans.
    constexpr std::int64_t kSpanNs = static_cast<std::int64_t>((kZeroMs + kSlackMs) * 1e6);
    for (const Complaint& each : session.judge.complaints) {
      const bool machines = std::any_of(stalls.begin(), stalls.end(), [&](const Span& span) {
        return span.from_ns <= each.t_ns && span.to_ns >= each.t_ns - kSpanNs;
      });
      named += machines ? 1 : 0;
      EXPECT_TRUE(machines) << name_of(GetParam()) << " seed " << first + i << ": " << each.what;
      if (!machines) break;  // the first one is enough
    }
    strongest_n = std::max(strongest_n, session.judge.strongest_n);
    acknowledgements += session.judge.acknowledgements.load();
  }
  std::printf(
      "%d sessions, %.1f s, up to %.2f N, %d acknowledgements; the machine held threads up "
      "for %.0f ms, up to %.1f ms, in which %zu looks are not counted\n",
      count, ms(monotonic_now_ns() - began_ns) * 1e-3, strongest_n, acknowledgements, stalled_ms,
      longest_ms, named);
  EXPECT_GT(strongest_n, 0.4) << "there was a force to judge";
  EXPECT_GT(acknowledgements, count / 4) << "and faults that were acknowledged";
}

INSTANTIATE_TEST_SUITE_P(All, MotorWall, testing::Values(Kind::kHd, Kind::kDhd),
                         [](const auto& each) { return name_of(each.param); });

}  // namespace
}  // namespace stylet::hal
