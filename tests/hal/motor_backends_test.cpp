// SPDX-License-Identifier: Apache-2.0
// The force that a hand gets from the whole chain, in a process in virtual time: the real loop with
// kernel, coupling, grip and guard; every backend that renders force, with its threads and its
// stand-in, opened again when it fails; `udp:` and `shm:` with a program that keeps the rules of
// packets.md; a station with a device of its own. Random sessions are judged where the force is
// felt, by rules that know nothing of the code.
#include "motor_backends.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "hal/device/lasting_device.h"
#include "motor_judge.h"
#include "peer_hand.h"
#include "rig.h"
#include "virtual_process.h"

namespace stylet::hal {
namespace {

struct Session {
  Draw draw;
  Backend backend;
  Rig rig;
  Judge judge;
  std::unique_ptr<Bench> bench;
  std::unique_ptr<PeerHand> peer;
  std::unique_ptr<StationHand> station;
  Device device = {}, seen = {};  // the backend's device, and the one that the loop sees
  Stalls loop, driver, service;
  int driver_thread = -1;
  double trouble = 0;
  std::int64_t service_until_ns = 0;
  double hand_hz = 1, hand_m = 0.008, middle_m = 0.004;

  Session(std::uint64_t seed, const Backend& of) : draw(seed), backend(of) {
    loop = Stalls::drawn(draw);
    driver = Stalls::drawn(draw);
    service = Stalls::drawn(draw);
    trouble = draw.chance(0.5) ? 0 : draw.between(0, 0.004);
    hand_hz = draw.between(0.5, 8);
    open();
    configure();
  }

  Weather weather(const Link& link) {
    Weather out;
    out.inner = link;
    out.draw = Draw(draw.bits());
    out.loss = draw.chance(0.5) ? 0 : draw.between(0, 0.1);
    out.delay_ns = draw.ms(0, 2);
    out.jitter_ns = draw.ms(0, 2);
    out.stalls = Stalls::drawn(draw);
    return out;
  }

  // ---- what takes part

  void open() {
    const std::string port = test_port();
    if (backend.bench != nullptr) bench = backend.bench();
    if (backend.may_refuse_watchdog) bench->refuse_watchdog(draw.chance(0.5));
    const std::string uri = backend.uri != nullptr ? backend.uri + port : bench->uri();
    if (uri.starts_with("shm:")) {
      std::ofstream("/dev/shm/stylet." + uri.substr(4));  // as a run leaves it that was killed
    }
    if (backend.motors == Motors::kPeer) {
      peer = std::make_unique<PeerHand>(weather(backend.link(port)), driver, trouble);
    }
    if (backend.motors == Motors::kStation) {
      const Device own = open_device(bench->uri());
      station = std::make_unique<StationHand>(weather(backend.link(port)), driver, own);
    }
    const auto opened = [this, uri] {
      const Device made = open_device(uri);
      driver_thread = test::newest_virtual_thread();
      return made;
    };
    device = lasting_device(opened(), {.open = opened});
    if (peer != nullptr) peer->begun = true;
    if (station != nullptr) station->begun = true;
    seen = {this, device.info, read, write, nullptr, nullptr, nullptr, motor};
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
    guard.buzz_n = draw.chance(0.5) ? 100 : 0.2F * guard.max_force_n;
    guard.continuous_force_n = guard.max_force_n;
    if (draw.chance(0.5)) hand.coupling.stiffness_n_per_m = 1400;
    hand.grip.enabled = true;
    hand.grip.force_scale = static_cast<float>(draw.between(5, 60));
    judge.most_n = static_cast<double>(guard.max_force_n);
    judge.slew_n_per_s = static_cast<double>(device.info.max_slew_n_per_s);
    judge.felt = [this] { return peer != nullptr ? peer->force_n : bench->felt(); };
    judge.writes = [this] { return peer != nullptr ? peer->steps : bench->writes(); };
    judge.orders_expire = backend.motors == Motors::kLibrary;
    judge.supervised = judge.orders_expire || backend.motors == Motors::kStation;
    if (!judge.orders_expire) judge.lag_ms = kZeroMs;
    judge.drops = backend.motors == Motors::kService;
    if (judge.drops) judge.held_ms = 21;
    // The service reads its socket only every so often, so slew is judged by what leaves our
    // thread.
    if (judge.drops) judge.way_ms = ms(test::kLookNs);
    if (peer != nullptr) judge.slew_n_per_s = static_cast<double>(PeerHand::kSlewNPerS);
    if (station != nullptr) judge.slew_n_per_s = 1000;
  }

  void leave() {
    peer.reset();
    station.reset();
    bench.reset();
  }

  // ---- the loop's side

  static bool read(void* self, std::int64_t tick_ns, Sample& out) {
    Session& s = *static_cast<Session*>(self);
    if (s.draw.chance(s.trouble * 0.2)) s.stall(s.draw.ms(0.5, 40));
    // Motors in this process count from the tick. A peer's motors count from the sample that is
    // answered, which may have been taken after a stall within the tick.
    s.order_ns = s.goes_by_samples() ? test::virtual_now_ns() : tick_ns;
    return s.device.read(s.device.self, tick_ns, out);
  }
  static void write(void* self, const Command& command) {
    Session& s = *static_cast<Session*>(self);
    if (s.draw.chance(s.trouble * 0.2)) s.stall(s.draw.ms(0.5, 40));
    const HandConfig& hand = s.rig.config.hand[0];
    const float stiffest = hand.coupling.stiffness_n_per_m * hand.grip.force_scale;
    if (!(command.stiffness_n_per_m <= stiffest * 1.0001F)) s.judge.fail("too stiff a model");
    s.device.write(s.device.self, command);
    // Before there was any force, a fault that is over needs no acknowledgement.
    if (command.arming != s.arming && s.judge.strongest_n == 0) s.judge.acknowledged();
    s.arming = command.arming;
    s.judge.ordered(s.order_ns);
    s.note_fault();
  }
  static bool motor(void* self, MotorReport& out) {
    Session& s = *static_cast<Session*>(self);
    return s.device.motor(s.device.self, out);
  }
  std::int64_t order_ns = 0;  // time at which the loop's knowledge was taken
  bool goes_by_samples() const { return peer != nullptr || station != nullptr; }
  std::uint32_t arming = 1;

  GuardState& guard() { return rig.state.hand[0].guard; }
  void note_fault() {
    if (guard().fault != Fault::kNone) judge.fault();
  }
  void stall(std::int64_t ns) { test::sleep_until_virtual(test::virtual_now_ns() + ns); }

  // Time until the loop's next tick.
  void sleep_until(std::int64_t t_ns) {
    note_fault();
    operate();
    upset();
    test::sleep_until_virtual(t_ns);
    if (loop.busy(draw, t_ns)) test::sleep_until_virtual(loop.until_ns);
    move_hand();
    if (!judge.broken.empty()) rig.state.stop = true;
  }

  void move_hand() {
    const double t = ms(test::virtual_now_ns()) * 1e-3;
    Pose pose = {{0, 0, static_cast<float>(-middle_m + hand_m * std::sin(6.283 * hand_hz * t))},
                 {1, 0, 0, 0}};
    if (draw.chance(trouble)) {
      pose.position_m.x = draw.chance(0.5) ? std::numeric_limits<float>::quiet_NaN() : 50;
    }
    if (bench != nullptr) bench->move(pose);
    if (peer != nullptr) peer->pose = pose;
    if (peer != nullptr && peer->strange_place) judge.fail("the place of a refused sample");
  }

  void operate() {
    if (guard().fault != Fault::kNone && draw.chance(0.02) && guard_rearm(guard(), guard().fault)) {
      judge.acknowledged();
      ++acknowledgements;
    }
    if (draw.chance(0.001)) rig.state.paused = !rig.state.paused.load();
  }
  int acknowledgements = 0;

  // Devices and services that fail or are silent for a while.
  void upset() {
    if (bench == nullptr) return;
    const std::int64_t now_ns = test::virtual_now_ns();
    if (now_ns < service_until_ns) return;
    if (service_until_ns != 0) {
      service_until_ns = 0;
      bench->trouble(test::Trouble::kNone);
    }
    if (backend.motors == Motors::kService && service.busy(draw, now_ns)) {
      bench->trouble(test::Trouble::kSilent);
      service_until_ns = service.until_ns;
    } else if (draw.chance(trouble * 0.3)) {
      bench->trouble(test::Trouble::kNoAnswer);
      service_until_ns = now_ns + draw.ms(30, 100);
    }
    if (service_until_ns != 0) judge.trouble_ns = service_until_ns + 100 * kMs;
  }

  // ---- the session

  void run() {
    const Clock clock = {
        this, [](void*) { return test::virtual_now_ns(); },
        [](void* self, std::int64_t t_ns) { static_cast<Session*>(self)->sleep_until(t_ns); }};
    const double attempts = draw.between(1, 4);
    for (int i = 0; i < attempts && judge.broken.empty(); ++i) {
      if (i > 0) resume();
      rig.config.ticks = static_cast<std::uint64_t>(draw.between(10, 500));
      run_loop(rig.config, rig.instance->kernel, std::span(&seen, 1), clock, {}, rig.state);
      note_fault();
    }
    judge.fault();  // the end of a run: the force ends in time, and for good
    stall(draw.ms(20, 60));
  }

  // Reset and Start, as the console does it: tissue, coupling and grip begin again, while the
  // guards of a device that stayed open go on. A latched fault stays latched; a guard that ended
  // without a fault is armed again.
  void resume() {
    judge.fault();
    const std::int64_t idle_ns = draw.ms(0, 100);
    stall(idle_ns);
    const bool had = guard().fault != Fault::kNone;
    const HandState left = rig.state.hand[0];
    std::destroy_at(&rig.state);
    std::construct_at(&rig.state);
    reset(rig.instance->kernel);
    guard() = left.guard;
    rig.state.hand[0].torque_guard = left.torque_guard;
    guard_resume(rig.config.hand[0].guard, guard(), idle_ns);
    guard_resume(rig.config.hand[0].guard, rig.state.hand[0].torque_guard, idle_ns);
    if ((guard().fault != Fault::kNone) != had) judge.fail("a latched fault was forgotten");
    if (!had) judge.acknowledged();
  }
};

struct Seen {
  double strongest_n = 0;
  double device_n = 0;  // largest force of the device
  int acknowledgements = 0;
};

Seen run_session(std::uint64_t seed, const Backend& backend) {
  test::VirtualProcess& process = test::enter_virtual_time();
  process = {};
  Session session(seed, backend);
  process.look = [&session] { session.judge.look(); };
  process.wakes = [&session](int thread, std::int64_t wake_ns) {
    const bool stalls = thread == session.driver_thread && session.bench != nullptr &&
                        session.station == nullptr && session.driver.busy(session.draw, wake_ns);
    return stalls ? session.driver.until_ns : wake_ns;
  };
  session.run();
  session.device.close(session.device.self);
  process = {};
  session.leave();
  EXPECT_EQ(session.judge.broken, "")
      << backend.name << " seed " << seed << ", alone: " << alone(seed);
  const auto device_n = static_cast<double>(session.device.info.max_force_n);
  return {session.judge.strongest_n, device_n, session.acknowledgements};
}

class MotorBackends : public testing::TestWithParam<Backend> {};

TEST_P(MotorBackends, GiveTheHandNoForceThatTheRulesForbid) {
  ASSERT_TRUE(GetParam().bench != nullptr || GetParam().link != nullptr)
      << "this driver renders force: its stand-in belongs into kBackends";
  const int first = number_from("STYLET_MOTOR_FIRST", 1);
  const int count =
      number_from("STYLET_MOTOR_SESSIONS", GetParam().motors == Motors::kService ? 10 : 60);
  double strongest_n = 0, judged_n = 1;
  int acknowledgements = 0;
  for (int i = 0; i < count && !HasFailure(); ++i) {
    const Seen seen = run_session(static_cast<std::uint64_t>(first + i), GetParam());
    strongest_n = std::max(strongest_n, seen.strongest_n);
    judged_n = std::min(judged_n, 0.5 * seen.device_n);
    acknowledgements += seen.acknowledgements;
  }
  if (count < 10) return;
  EXPECT_GT(strongest_n, judged_n) << "there was a force to judge";
  EXPECT_GT(acknowledgements, count / 4) << "and faults that were acknowledged";
}

INSTANTIATE_TEST_SUITE_P(All, MotorBackends, testing::ValuesIn(all_backends()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace stylet::hal
