// SPDX-License-Identifier: Apache-2.0
// Two hands at once, in a process in virtual time: two `hd:` devices, which share one servo of
// their library, two `dhd:` devices, and one of each, on their stand-ins, each opened again when it
// fails. In random sessions each hand is judged by itself, as in motor_backends_test.cpp: it feels
// its own device's force, and after a stall of everything both are back as soon as they are
// acknowledged.
#include <array>
#include <deque>
#include <ostream>

#include "device_bench.h"
#include "motor_judge.h"
#include "rig.h"
#include "virtual_process.h"

namespace stylet::hal {
namespace {

enum class Pair { kTwoHd, kTwoDhd, kHdAndDhd };
const char* name_of(Pair pair) {
  constexpr const char* kNames[] = {"two_hd", "two_dhd", "hd_and_dhd"};
  return kNames[static_cast<int>(pair)];
}
void PrintTo(Pair pair, std::ostream* out) {
  *out << name_of(pair);
}

constexpr std::size_t kHands = 2;
// The motors have a force within what was asked of them in this time, or none.
constexpr std::int64_t kAskedNs = 60 * kMs;

// By then all devices that failed together are back: each hand tries at least every 4 s
// (kLongestTryS), and then somebody acknowledges.
constexpr std::uint64_t kBackTicks = 9000;

struct Asked {
  std::int64_t t_ns;
  Vec3 force_n;
};

struct OneHand {
  std::unique_ptr<Bench> bench;
  Device device = {}, seen = {};
  GuardState* guard = nullptr;
  Judge judge;
  Stalls stalls;                // of the vendor's calls
  std::int64_t until_ns = 0;    // device in trouble until then
  double hz = 1, middle_m = 0;  // of the hand's way
  float x_m = 0;                // where only this hand is
  std::int64_t tick_ns = 0;
  std::uint32_t arming = 1;
  bool forced = false;  // since the last look
  std::deque<Asked> asked;

  static bool read(void* self, std::int64_t tick_ns, Sample& out) {
    OneHand& hand = *static_cast<OneHand*>(self);
    hand.tick_ns = tick_ns;
    const bool answered = hand.device.read(hand.device.self, tick_ns, out);
    if (answered && out.pose.position_m.x != hand.x_m) hand.judge.fail("the other's place");
    return answered;
  }
  static void write(void* self, const Command& command) {
    OneHand& hand = *static_cast<OneHand*>(self);
    hand.asked.push_back({test::virtual_now_ns(), command.force_n});
    hand.device.write(hand.device.self, command);
    if (command.arming != hand.arming && hand.judge.strongest_n == 0) hand.judge.acknowledged();
    hand.arming = command.arming;
    hand.judge.ordered(hand.tick_ns);
    hand.note_fault();
  }
  static bool motor(void* self, MotorReport& out) {
    OneHand& hand = *static_cast<OneHand*>(self);
    return hand.device.motor(hand.device.self, out);
  }

  void note_fault() {
    if (guard->fault != Fault::kNone) judge.fault();
  }
  bool acknowledge() {
    if (guard->fault == Fault::kNone || !guard_rearm(*guard, guard->fault)) return false;
    judge.acknowledged();
    return true;
  }

  // On each axis the force lies between the smallest and the largest that were asked.
  void look() {
    judge.look();
    const std::int64_t now_ns = test::virtual_now_ns();
    while (asked.size() > 1 && now_ns - asked.front().t_ns > kAskedNs) asked.pop_front();
    const Vec3 felt = bench->felt();
    forced = forced || size(felt) > 0;
    for (float Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      float least = 0, most = 0;
      for (const Asked& each : asked) {
        least = std::min(least, each.force_n.*axis);
        most = std::max(most, each.force_n.*axis);
      }
      if (felt.*axis < least - 1e-4F || felt.*axis > most + 1e-4F) judge.fail("the other's force");
    }
  }

  void move() {
    const double t = ms(test::virtual_now_ns()) * 1e-3;
    const double way_m = -middle_m + 0.008 * std::sin(6.283 * hz * t);
    bench->move({{x_m, 0, static_cast<float>(way_m)}, {1, 0, 0, 0}});
  }
};

struct Session {
  Rig rig;
  Draw draw;
  std::array<OneHand, kHands> hand;
  Stalls loop;
  double trouble = 0;
  Pair pair;
  bool calm = false;

  Session(std::uint64_t seed, Pair of) : draw(seed), pair(of) {
    loop = Stalls::drawn(draw);
    trouble = draw.chance(0.5) ? 0 : draw.between(0, 0.002);
    rig.scene.config.needle_count = kHands;
    rig.instance = std::make_unique<KernelInstance>(rig.organ, rig.scene.config);
    for (std::size_t i = 0; i < kHands; ++i) open(i);
  }

  void open(std::size_t i) {
    OneHand& one = hand[i];
    const int unit = static_cast<int>(i);
    const bool is_hd = pair == Pair::kTwoHd || (pair == Pair::kHdAndDhd && i == 0);
    one.bench = is_hd ? hd_bench_of(unit) : dhd_bench_of(unit);
    one.x_m = static_cast<float>(draw.between(-0.002, 0.002));
    one.hz = draw.between(0.5, 4);
    one.middle_m = draw.between(0.002, 0.006);
    one.stalls = Stalls::drawn(draw);
    if (!is_hd) one.bench->refuse_watchdog(draw.chance(0.5));
    one.move();
    one.device = open_lasting_device(one.bench->uri());
    one.seen = {&one,    one.device.info, OneHand::read, OneHand::write,
                nullptr, nullptr,         nullptr,       OneHand::motor};
    one.guard = &rig.state.hand[i].guard;
    configure(one, rig.config.hand[i], i);
  }

  void configure(OneHand& one, HandConfig& config, std::size_t i) {
    config.mapping = rig.config.hand[0].mapping;
    if (i > 0) config.mapping.origin_m.y += 0.005F;  // beside the other needle
    config.guard.max_force_n = static_cast<float>(
        std::min(draw.between(0.5, 12), static_cast<double>(one.device.info.max_force_n)));
    config.guard.max_slew_n_per_s =
        std::max(one.device.info.max_slew_n_per_s, config.guard.max_force_n / kDecayS);
    config.guard.ramp_s = draw.chance(0.3) ? 0 : static_cast<float>(draw.between(0, 0.1));
    config.guard.watchdog_s = static_cast<float>(draw.between(3e-3, 5e-3));
    config.guard.max_speed_m_per_s = 5;
    config.guard.stored_energy_j = 1e6F;
    config.guard.buzz_n = 100;
    config.guard.continuous_force_n = config.guard.max_force_n;
    config.grip.enabled = true;
    config.grip.force_scale = static_cast<float>(draw.between(5, 60));
    one.judge.most_n = static_cast<double>(config.guard.max_force_n);
    one.judge.slew_n_per_s = static_cast<double>(one.device.info.max_slew_n_per_s);
    one.judge.felt = [&one] { return one.bench->felt(); };
    one.judge.writes = [&one] { return one.bench->writes(); };
    one.judge.orders_expire = true;
  }

  std::string broken() const {
    return hand[0].judge.broken.empty() ? hand[1].judge.broken : hand[0].judge.broken;
  }

  // ---- what goes wrong

  // Two devices with one servo: a call that holds up one also holds up the other.
  void in_trouble(OneHand& one, std::int64_t until_ns) {
    for (OneHand& each : hand) {
      if (&each != &one && pair != Pair::kTwoHd) continue;
      each.judge.trouble_ns = std::max(each.judge.trouble_ns, until_ns + 100 * kMs);
    }
    one.until_ns = until_ns;
  }
  void stall(OneHand& one, std::int64_t until_ns) {
    one.judge.writes_hang = draw.chance(0.5);
    one.bench->hang(one.judge.writes_hang ? test::Hang::kWrite : test::Hang::kRead);
    in_trouble(one, until_ns);
  }
  void upset(OneHand& one) {
    const std::int64_t now_ns = test::virtual_now_ns();
    if (now_ns < one.until_ns) return;
    one.bench->hang(test::Hang::kNone);
    one.bench->trouble(test::Trouble::kNone);
    if (calm) return;
    if (one.stalls.busy(draw, now_ns)) {
      stall(one, one.stalls.until_ns);
    } else if (draw.chance(trouble)) {
      one.bench->trouble(draw.chance(0.5) ? test::Trouble::kNoAnswer : test::Trouble::kSilent);
      in_trouble(one, now_ns + draw.ms(5, 100));
    }
  }

  // ---- the session

  void sleep_until(std::int64_t t_ns) {
    for (OneHand& each : hand) {
      each.note_fault();
      if (draw.chance(0.02)) (void)each.acknowledge();
      upset(each);
    }
    test::sleep_until_virtual(t_ns);
    if (!calm && loop.busy(draw, t_ns)) test::sleep_until_virtual(loop.until_ns);
    for (OneHand& each : hand) each.move();
    if (!broken().empty()) rig.state.stop = true;
  }

  void run_ticks(std::uint64_t more) {
    const Clock clock = {
        this, [](void*) { return test::virtual_now_ns(); },
        [](void* self, std::int64_t t_ns) { static_cast<Session*>(self)->sleep_until(t_ns); }};
    const std::array devices = {hand[0].seen, hand[1].seen};
    rig.config.ticks = rig.state.ticks + more;
    rig.config.lets_go = false;
    run_loop(rig.config, rig.instance->kernel, devices, clock, {}, rig.state);
  }

  // From now on nothing goes wrong, except that everything stands still once: in the end both hands
  // are back.
  void recover() {
    calm = true;
    run_ticks(400);
    const std::int64_t until_ns = test::virtual_now_ns() + draw.ms(30, 150);
    for (OneHand& each : hand) stall(each, until_ns);
    run_ticks(200);
    for (OneHand& each : hand) each.forced = false;
    run_ticks(kBackTicks);
    for (std::size_t i = 0; i < kHands && broken().empty(); ++i) {
      const std::string left = trouble_of(hand[i].device);
      if (!left.empty()) hand[i].judge.fail("not back: " + left);
      if (hand[i].guard->fault != Fault::kNone) hand[i].judge.fail("not armed");
    }
  }

  void run() {
    run_ticks(static_cast<std::uint64_t>(draw.between(500, 2500)));
    recover();
    for (OneHand& each : hand) each.judge.fault();  // the end: the force ends in time, and for good
    test::sleep_until_virtual(test::virtual_now_ns() + draw.ms(30, 60));
  }
};

// How many hands had a force after both devices were back.
int run_session(std::uint64_t seed, Pair pair) {
  test::VirtualProcess& process = test::enter_virtual_time();
  process = {};
  Session session(seed, pair);
  process.look = [&session] {
    for (OneHand& each : session.hand) each.look();
  };
  session.run();
  process = {};
  for (OneHand& each : session.hand) each.bench->hang(test::Hang::kNone);
  for (OneHand& each : session.hand) each.device.close(each.device.self);
  for (std::size_t i = 0; i < kHands; ++i) {
    EXPECT_EQ(session.hand[i].judge.broken, "")
        << name_of(pair) << " seed " << seed << " hand " << i << ", alone: " << alone(seed);
  }
  return (session.hand[0].forced ? 1 : 0) + (session.hand[1].forced ? 1 : 0);
}

class MotorPairs : public testing::TestWithParam<Pair> {};

TEST_P(MotorPairs, GiveNeitherHandAForceThatTheRulesForbid) {
  const int first = number_from("STYLET_MOTOR_FIRST", 1);
  const int count = number_from("STYLET_MOTOR_SESSIONS", 5);
  int forced = 0;
  for (int i = 0; i < count && !HasFailure(); ++i) {
    forced += run_session(static_cast<std::uint64_t>(first + i), GetParam());
  }
  EXPECT_GT(forced, 0) << "there was a force after both were back";
}

INSTANTIATE_TEST_SUITE_P(All, MotorPairs,
                         testing::Values(Pair::kTwoHd, Pair::kTwoDhd, Pair::kHdAndDhd),
                         [](const auto& each) { return name_of(each.param); });

}  // namespace
}  // namespace stylet::hal
