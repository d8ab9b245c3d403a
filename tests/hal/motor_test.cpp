// SPDX-License-Identifier: Apache-2.0
// The force that motors get, whatever loop, device and hand do: random sessions of guard, relay and
// motor in virtual time, judged where the force is written, by rules that know nothing of the code.
#include "hal/device/motor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>

#include "guard_desk.h"
#include "hal/device/relay.h"
#include "hal/guard/guard.h"
#include "motor_draw.h"

namespace stylet::hal {
namespace {

constexpr double kZeroMs = 25;  // from any fault to zero force: GUARD.md, R6
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

double apart(Vec3 a, Vec3 b) {
  return size({a.x - b.x, a.y - b.y, a.z - b.z});
}

struct Session {
  Draw draw;
  GuardConfig guard;
  DeviceInfo info;
  std::int64_t device_period_ns = kMs;
  Stalls loop, device;
  double trouble = 0;  // fraction of ticks with trouble
  bool presses_on = false;
  bool ends = false;  // its orders have an end, as those of a station
  std::unique_ptr<Relay> relay = std::make_unique<Relay>();
  GuardState state = guard_start();
  std::int64_t now_ns = 1'000 * kMs, written_ns = 0;
  Vec3 written_n = {};
  // What is known from outside.
  std::int64_t loop_ns = 0;                    // of the newest order
  std::int64_t orders_end_ns = 0;              // the latest end of all orders
  std::int64_t fault_ns = 0;                   // since when the guard has a fault; 0: none
  std::int64_t failed_ns = 0;                  // when the driver took the device for failed
  std::uint64_t acknowledged = 0, needed = 0;  // number of times; the number that a force needs
  std::int64_t needed_ns = 0;                  // since when
  bool ordered = false;                        // since the last acknowledgement
  bool stopped = false;                        // orders were missing for longer than they live
  bool felt = false;                           // there ever was a force
  std::string broken;

  explicit Session(std::uint64_t seed) : draw(seed) {
    guard.max_force_n = static_cast<float>(draw.between(0.5, 30));
    const double least = static_cast<double>(guard.max_force_n) / 0.020;
    guard.max_slew_n_per_s = static_cast<float>(least * draw.between(1, 8));
    guard.ramp_s = draw.chance(0.3) ? 0 : static_cast<float>(draw.between(0, 0.4));
    guard.watchdog_s = static_cast<float>(draw.between(1e-3, 5e-3));
    guard.buzz_n = draw.chance(0.5) ? 100 : 0.1F * guard.max_force_n;
    guard.continuous_force_n = static_cast<float>(draw.between(0.1, 1)) * guard.max_force_n;
    guard.stored_energy_j = 1e6F;
    guard.max_speed_m_per_s = 1e3F;
    info = {.name = "drawn",
            .max_force_n = guard.max_force_n,
            .max_slew_n_per_s = guard.max_slew_n_per_s};
    relay->limits = motor_limits(info);
    device_period_ns = draw.ms(0.2, 1);
    loop = Stalls::drawn(draw);
    device = Stalls::drawn(draw);
    trouble = draw.chance(0.5) ? 0 : draw.between(0, 0.01);
    presses_on = draw.chance(0.5);
    ends = draw.chance(0.3);
  }

  void fail(const char* why) {
    if (!broken.empty()) return;
    broken = why;
    broken += " (fault " + std::string(fault_name(state.fault)) + ", " + mode_name(state.mode) +
              ", guard " + std::to_string(size(state.force_n)) + " N, motor had " +
              std::to_string(size(written_n)) + " N, loop " +
              std::to_string(static_cast<double>(now_ns - loop_ns) * 1e-6) + " ms ago, device " +
              std::to_string(static_cast<double>(now_ns - written_ns) * 1e-6) + " ms ago)";
  }

  void need() {
    if (needed > acknowledged) return;
    needed = acknowledged + 1;
    needed_ns = now_ns;
  }

  // Checks every rule of the motor, with the time that has really passed.
  void judge(Vec3 force_n) {
    const double passed_s = static_cast<double>(now_ns - written_ns) * 1e-9;
    const double most = static_cast<double>(guard.max_slew_n_per_s) * passed_s;
    const double force = size(force_n);
    if (!std::isfinite(force)) return fail("not finite");
    if (force > static_cast<double>(guard.max_force_n) * (1 + 1e-6)) return fail("over the limit");
    // Called for a driver that gives its device up, or that was held up and cannot know what the
    // device did.
    const bool cut = force == 0 && (failed_ns != 0 || now_ns - written_ns > 10 * kMs);
    if (written_ns != 0 && !cut && apart(force_n, written_n) > most * (1 + 1e-5) + 1e-6) {
      return fail("changes faster than the slew limit");
    }
    const auto since_ms = [this](std::int64_t ns) {
      return static_cast<double>(now_ns - ns) * 1e-6;
    };
    // A driver that writes once a period notices it up to one period later.
    const double slack_ms = static_cast<double>(device_period_ns) * 1e-6;
    if (force > 0 && loop_ns != 0 && since_ms(loop_ns) > kZeroMs + slack_ms) {
      return fail("force 25 ms after the loop stopped");
    }
    // The guard sees faults only while the loop runs; a stall of the loop itself is judged above.
    if (force > 0 && fault_ns != 0 && since_ms(fault_ns) > kZeroMs + slack_ms) {
      return fail("force 25 ms after a fault");
    }
    if (force > 0 && ends && now_ns >= orders_end_ns) return fail("force after the orders' end");
    if (force > 0 && failed_ns != 0 && since_ms(failed_ns) > kZeroMs) {
      return fail("force after the device had failed");
    }
    if (ordered && since_ms(loop_ns) > 10) stopped = true;
    if (ordered && written_ns != 0 && since_ms(written_ns) > 10) stopped = true;
    if (stopped) need();
    // The order that was under way when the guard saw the fault may still come through.
    const bool under_way = now_ns - needed_ns < 2 * kMs;
    if (needed > acknowledged && !under_way && force > size(written_n) * (1 + 1e-6)) {
      return fail("force grows before it was acknowledged");
    }
    felt = felt || force > 0;
    written_n = force_n;
    written_ns = now_ns;
  }

  void tick_device() {
    if (device.busy(draw, now_ns)) return;
    if (draw.chance(trouble * 0.02)) {
      relay->fail(1);
      if (failed_ns == 0) failed_ns = now_ns;
    }
    judge(relay->order(now_ns).force_n);
    Pose pose = {{0.01F * static_cast<float>(std::sin(static_cast<double>(now_ns) * 1e-8)), 0, 0},
                 {1, 0, 0, 0}};
    if (draw.chance(trouble)) pose.position_m.x = draw.chance(0.5) ? kNan : 50;
    if (!draw.chance(trouble)) relay->publish(pose, 0, now_ns);
  }

  Vec3 asked() {
    if (draw.chance(trouble * 0.1)) return {kNan, 0, 0};
    const float most = guard.max_force_n * 1.5F;
    if (!presses_on) return {draw.chance(0.5) ? most : -most, 0, 0.3F};  // a square wave
    return {most, most * 0.2F, 0};
  }

  // The order ends earlier, by the time for which its sample was under way; some answers are lost.
  std::int64_t next_end_ns() {
    if (!ends) return 0;
    if (draw.chance(0.7)) orders_end_ns = std::max(orders_end_ns, now_ns + draw.ms(8, 20));
    return std::max<std::int64_t>(orders_end_ns, 1);
  }

  void note_fault(bool had) {
    const bool has = state.fault != Fault::kNone;
    if (has && !had) {
      fault_ns = now_ns;
      need();
    }
  }

  void accept() {
    ++acknowledged;
    fault_ns = 0;
    stopped = ordered = false;
  }

  void tick_loop() {
    if (loop.busy(draw, now_ns)) return;
    const bool had = state.fault != Fault::kNone;
    const std::uint32_t arming = state.arming;
    MotorReport report;
    if (relay->motor(report)) guard_motor(state, report);
    Sample sample;
    const bool answered = relay->read(now_ns, sample);
    (void)guard_sample(guard, state, answered, sample, now_ns);
    relay->write({.force_n = guard_force(guard, state, asked()),
                  .arming = state.arming,
                  .falls = guard_withdraws_force(state),
                  .end_ns = next_end_ns()});
    if (state.arming != arming && !felt) accept();  // none is needed before any force
    loop_ns = now_ns;
    ordered = true;
    note_fault(had);
  }

  // An operator: acknowledges what is latched, resets and starts, opens a device again.
  void operate() {
    if (state.fault != Fault::kNone && draw.chance(0.02) && guard_rearm(state, state.fault)) {
      accept();
    }
    // Not before a quarter of a second has passed, as in reality, when the guard has let go.
    if (relay->failed() && state.mode == GuardMode::kFault && draw.chance(0.02)) {
      relay = std::make_unique<Relay>();
      relay->limits = motor_limits(info);
      failed_ns = 0;
      written_n = {};
    }
    if (draw.chance(0.0005)) reset();
  }

  // Reset, and Start after a while. A latched fault stays latched; a guard that ended without a
  // fault is armed again.
  void reset() {
    const bool had = state.fault != Fault::kNone;
    GuardState torque = guard_start();
    for (bool gone = false; !gone; now_ns += kMs) {
      gone = guard_end(guard, state, torque, now_ns);
      Sample unused;
      (void)relay->read(now_ns, unused);
      relay->write({.force_n = state.force_n,
                    .arming = state.arming,
                    .falls = guard_withdraws_force(state),
                    .end_ns = ends ? std::max<std::int64_t>(orders_end_ns, 1) : 0});
      loop_ns = now_ns;
      judge(relay->order(now_ns).force_n);
    }
    const std::int64_t idle_ns = draw.ms(0, 200);
    for (std::int64_t end_ns = now_ns + idle_ns; now_ns < end_ns; now_ns += device_period_ns) {
      judge(relay->order(now_ns).force_n);
      relay->publish({{}, {1, 0, 0, 0}}, 0, now_ns);
    }
    if (size(written_n) > 0 && idle_ns > 30 * kMs) fail("force between two attempts");
    guard_resume(guard, state, idle_ns);
    if ((state.fault != Fault::kNone) != had) fail("a latched fault was forgotten");
    if (!had) {
      ++acknowledged;
      stopped = ordered = false;
    }
  }

  void run(double seconds) {
    const std::int64_t end_ns = now_ns + static_cast<std::int64_t>(seconds * 1e9);
    std::int64_t device_ns = now_ns, loop_at_ns = now_ns + draw.ms(0, 1);
    while (now_ns < end_ns && broken.empty()) {
      now_ns = std::max(now_ns, std::min(device_ns, loop_at_ns));
      if (now_ns >= device_ns) {
        tick_device();
        device_ns = now_ns + device_period_ns;
      }
      if (now_ns >= loop_at_ns) {
        tick_loop();
        operate();
        loop_at_ns = std::max(loop_at_ns + kMs, now_ns);
      }
    }
  }
};

// A session's seconds: enough for some stalls of 300 ms and the ramps after them.
constexpr double kSessionS = 2.5;

void run_sessions(std::uint64_t first, std::uint64_t count) {
  double felt = 0;
  std::uint64_t acknowledged = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    Session session(seed);
    session.run(kSessionS);
    ASSERT_EQ(session.broken, "") << "seed " << seed << " at "
                                  << static_cast<double>(session.now_ns) * 1e-6 - 1000 << " ms";
    felt = std::max(felt, size(session.written_n));
    acknowledged += session.acknowledged;
  }
  EXPECT_GT(felt, 1) << "there was a force to judge";
  EXPECT_GT(acknowledged, count / 2) << "and faults that were acknowledged";
}

TEST(Motor, KeepsEveryRuleInSomeSessions) {
  run_sessions(1, 400);
}

TEST(MotorExhaustive, KeepsEveryRuleInTenThousandSessions) {
  run_sessions(1'000'000, 10'000);
}

// ---- one rule at a time

struct Desk {
  MotorLimits limits = {3, 1000, 0.1F};
  MotorState state;
  MotorOrder order = {.arming = 1};
  std::int64_t now_ns = 50 * kMs;

  Vec3 step(std::int64_t ns = kMs, MotorCut cut = MotorCut::kNone) {
    now_ns += ns;
    motor_step(limits, state, order, cut, now_ns);
    return state.report.force_n;
  }
  Vec3 push(Vec3 force_n, std::int64_t ns = kMs) {
    order.force_n = force_n;
    order.t_ns = now_ns + ns;
    return step(ns);
  }
};

TEST(Motor, FollowsTheOrderWithinItsLimits) {
  Desk desk;
  desk.push({});
  EXPECT_NEAR(size(desk.push({0, 2.5F, 0})), 1, 1e-6);  // 1000 N/s for a millisecond
  EXPECT_NEAR(size(desk.push({0, 2.5F, 0})), 2, 1e-6);
  EXPECT_EQ(desk.push({0, 2.5F, 0}).y, 2.5F);
  for (int i = 0; i < 5; ++i) desk.push({0, 40, 0});
  EXPECT_NEAR(size(desk.push({0, 40, 0})), 3, 1e-6);
  for (float bad : {kNan, std::numeric_limits<float>::infinity()}) {
    Desk other;
    other.push({});
    for (int i = 0; i < 30; ++i) ASSERT_EQ(size(other.push({bad, 0, 0})), 0);
  }
}

// Calls of equal length, some of them held up; the motors get their force at the end of each call.
TEST(Motor, ACallThatIsHeldUpIsNotFollowedByAStep) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Draw draw(seed);
    Desk desk;
    const std::int64_t call_ns = draw.ms(0, 0.9);
    std::int64_t had_ns = desk.now_ns;
    double held_up = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 before = desk.state.report.force_n;
      const double way = draw.between(-3, 3);
      desk.push({static_cast<float>(way), i % 7 < 3 ? 2.0F : -2.0F, 0}, kMs - call_ns);
      desk.order.falls = draw.chance(0.1);
      desk.now_ns += call_ns + (draw.chance(0.1) ? draw.ms(0, 9) : 0);
      motor_written(desk.state, desk.now_ns);
      const double passed_ms = static_cast<double>(desk.now_ns - had_ns) * 1e-6;
      had_ns = desk.now_ns;
      EXPECT_LE(apart(desk.state.report.force_n, before), passed_ms * (1 + 1e-5))
          << seed << " " << i;
      held_up = std::max(held_up, passed_ms);
    }
    EXPECT_GT(held_up, 5);
  }
}

TEST(Motor, CallsThatTakeLongKeepTheSlewLimit) {
  for (const std::int64_t call_ns : {kMs / 10, kMs / 2, 9 * kMs / 10}) {
    Desk desk;
    for (int i = 0; i < 20; ++i) {
      const double before = size(desk.state.report.force_n);
      desk.push({i < 10 ? 0.0F : 2.9F, 0, 0}, kMs - call_ns);
      desk.now_ns += call_ns;
      motor_written(desk.state, desk.now_ns);
      if (i == 10 || i == 11) {
        EXPECT_NEAR(size(desk.state.report.force_n) - before, 1, 1e-5);
      }
    }
    EXPECT_EQ(desk.state.report.force_n.x, 2.9F);
  }
}

// Stalls of a loop that an independent check used.
TEST(Motor, StallsAreADipOrAnEndAndNeverAKick) {
  for (int stall_ms = 1; stall_ms <= 60; ++stall_ms) {
    Desk desk;
    for (int i = 0; i < 10; ++i) desk.push({2.9F, 0, 0});
    double last = size(desk.state.report.force_n);
    ASSERT_NEAR(last, 2.9, 1e-6);
    for (int i = 1; i <= stall_ms; ++i) {
      const double now = size(desk.step());
      EXPECT_LE(now, last);
      EXPECT_LE(last - now, 3.0 / 20 + 1e-6) << stall_ms << " at " << i;
      EXPECT_TRUE(i < 24 || now == 0) << stall_ms << " at " << i;
      last = now;
    }
    for (int i = 0; i < 40; ++i) {
      const double now = size(desk.push({2.9F, 0, 0}));
      EXPECT_LE(std::fabs(now - last), 1 + 1e-6) << stall_ms;
      EXPECT_TRUE(stall_ms <= 10 || now <= last) << stall_ms;
      last = now;
    }
    EXPECT_NEAR(last, stall_ms > 10 ? 0 : 2.9, 1e-6) << stall_ms;
    desk.order.arming = 2;
    for (int i = 0; i < 40; ++i) last = size(desk.push({2.9F, 0, 0}));
    EXPECT_NEAR(last, 2.9, 1e-6) << "armed anew";
  }
}

// The guard lets go, and both threads are held up: the motor goes on with the guard's fade, and
// does not begin it again.
TEST(Motor, ALateOrderThatAlreadyFadesIsContinuedNotRestarted) {
  Desk desk;
  for (int i = 0; i < 10; ++i) desk.push({2.9F, 0, 0});
  desk.order = {{1.5F, 0, 0}, {}, desk.now_ns + 3 * kMs, 1, true};
  desk.step(9 * kMs);  // 6 ms old when it is seen, and fresh for 4
  for (int i = 0; i < 8; ++i) desk.step();
  EXPECT_NEAR(size(desk.state.report.force_n), 0, 1e-6) << "10 ms of 3 N in 20 ms";
}

// From some tick on no orders come. The last order itself says when no force may be left.
TEST(Motor, TheForceOfAnOrderIsZeroAtItsEndWithinTheSlewLimit) {
  for (int held_ms = 0; held_ms <= 20; ++held_ms) {
    for (const float slew_n_per_s : {150.0F, 300.0F, 1000.0F}) {
      Desk desk;
      desk.limits.max_slew_n_per_s = slew_n_per_s;
      for (int i = 0; i < 30; ++i) desk.push({2.9F, 0, 0});
      desk.order.end_ns = desk.now_ns + 20 * kMs;
      double last = size(desk.state.report.force_n);
      for (int i = 1; i <= 30; ++i) {
        const Vec3 across = {0, i < held_ms ? 2.9F : 0, 2.0F};
        const Vec3 now_n = i < held_ms ? desk.push(across) : desk.step();
        EXPECT_LE(std::fabs(size(now_n) - last), 1e-3 * static_cast<double>(slew_n_per_s) + 1e-6);
        EXPECT_TRUE(i < 20 || size(now_n) == 0) << held_ms << " at " << i << ": " << size(now_n);
        last = size(now_n);
      }
    }
  }
}

TEST(Motor, AFailedDeviceIsCutAndAClosedOneFades) {
  Desk failed, closed;
  for (Desk* each : {&failed, &closed}) {
    for (int i = 0; i < 10; ++i) each->push({2.9F, 0, 0});
  }
  EXPECT_EQ(size(failed.step(kMs, MotorCut::kNow)), 0);
  double last = 2.9;
  for (int i = 1; i <= 22; ++i) {
    const double now = size(closed.step(kMs, MotorCut::kFade));
    EXPECT_LE(last - now, 3.0 / 20 + 1e-6);
    last = now;
  }
  EXPECT_EQ(last, 0);
  failed.order.arming = 9;
  for (int i = 0; i < 10; ++i) {
    failed.order.t_ns = failed.now_ns + kMs;
    EXPECT_EQ(size(failed.step(kMs, MotorCut::kNow)), 0);
  }
}

TEST(Motor, AnOrderOfTheFutureAgesFromWhenItWasSeen) {
  for (const std::int64_t ahead_ns : {3 * kMs, 50 * kMs, std::int64_t{1} << 60}) {
    Desk desk;
    for (int i = 0; i < 10; ++i) desk.push({2.9F, 0, 0});
    desk.order.t_ns = desk.now_ns + ahead_ns;
    for (int i = 0; i < 25; ++i) desk.step();
    EXPECT_EQ(size(desk.state.report.force_n), 0) << ahead_ns;
    EXPECT_TRUE(desk.state.report.stopped) << ahead_ns;
  }
}

TEST(Motor, AnInvalidLimitCountsAsTheSmallest) {
  for (const float none : {0.0F, -1.0F, kNan, std::numeric_limits<float>::infinity()}) {
    Desk slews, pushes;
    slews.limits.max_slew_n_per_s = none;
    slews.push({});
    EXPECT_NEAR(size(slews.push({2.5F, 0, 0})), 1e-3 * static_cast<double>(kUnknownSlewNPerS), 1e-6)
        << none;
    pushes.limits.max_force_n = none;
    pushes.push({});
    for (int i = 0; i < 5; ++i) EXPECT_EQ(size(pushes.push({2.5F, 0, 0})), 0) << none;
  }
}

TEST(Motor, OnlyANewerArmingMovesMotorsThatStopped) {
  for (const std::uint32_t arming : {7U, 0x7FFFFFFFU, 0xFFFFFFFFU, 0x80000000U}) {
    Desk desk;
    desk.order.arming = arming;
    for (int i = 0; i < 10; ++i) desk.push({2.9F, 0, 0});
    ASSERT_NEAR(size(desk.state.report.force_n), 2.9, 1e-6) << arming;
    for (int i = 0; i < 30; ++i) desk.step();
    for (const std::uint32_t not_newer : {0U, 1U, 6U, 1000U}) {
      desk.order.arming = arming - not_newer;
      for (int i = 0; i < 20; ++i) ASSERT_EQ(size(desk.push({2.9F, 0, 0})), 0) << not_newer;
    }
    desk.order.arming = arming + 1;
    for (int i = 0; i < 5; ++i) desk.push({2.9F, 0, 0});
    EXPECT_NEAR(size(desk.state.report.force_n), 2.9, 1e-6) << arming;
  }
}

TEST(Motor, TorqueHasItsOwnLimitAndSlew) {
  Desk desk;
  desk.push({});
  desk.order.torque_nm = {0, 0, 7};
  double last = 0;
  for (int i = 0; i < 20; ++i) {
    desk.push({});
    const double now = size(desk.state.report.torque_nm);
    EXPECT_LE(now - last, 0.01 + 1e-7);  // from zero to 0.1 N m in 10 ms
    last = now;
  }
  EXPECT_NEAR(last, 0.1, 1e-6);
}

TEST(Guard, LearnsThatTheMotorsHaveStoppedAndStaysThere) {
  GuardConfig config;
  config.ramp_s = 0;
  GuardState state = met(config);
  for (int i = 0; i < 20; ++i) (void)next_force(config, state, {2, 0, 0});
  guard_motor(state, {{2, 0, 0}, {}, state.arming + 1, true});
  EXPECT_EQ(state.fault, Fault::kNone) << "a report of another arming";
  guard_motor(state, {{0.5F, 0, 0}, {}, state.arming, true});
  EXPECT_EQ(state.fault, Fault::kForceExpired);
  EXPECT_LE(size(guard_force(config, state, {2, 0, 0})), 0.5);
  for (int i = 0; i < 25; ++i) (void)guard_force(config, state, {2, 0, 0});
  EXPECT_EQ(state.mode, GuardMode::kFault);
}

// A run ends during the fade of a fault, and its last ticks were lost: the fade counts their time.
TEST(Guard, TheEndOfARunCountsTheTimeThatWasLost) {
  for (int lost_ms = 1; lost_ms < 30; ++lost_ms) {
    GuardConfig config;
    config.ramp_s = 0;
    GuardState state = guard_start(), torque = guard_start();
    std::int64_t now_ns = 1000 * kMs;
    const auto tick = [&](std::uint64_t i) {
      now_ns += kMs;
      (void)guard_sample(config, state, true, {i + 1, now_ns, {{}, {1, 0, 0, 0}}, 0}, now_ns);
      (void)guard_force(config, state, {2, 0, 0});
      (void)guard_torque(config, 0.1F, state, torque, {0, 0, 0.05F});
    };
    for (std::uint64_t i = 0; i < 20; ++i) tick(i);
    guard_trip(state, Fault::kTooLate);
    const std::int64_t fault_ns = now_ns;
    for (std::uint64_t i = 20; i < 23; ++i) tick(i);
    now_ns += lost_ms * kMs;
    while (!guard_end(config, state, torque, now_ns)) now_ns += kMs;
    EXPECT_LE(now_ns - fault_ns, std::max(20, 3 + lost_ms) * kMs) << lost_ms;
    EXPECT_EQ(size(state.force_n) + size(torque.force_n), 0) << lost_ms;
  }
}

// The report of a peer is old by the time for which it was under way.
TEST(Guard, FadesFromTheSmallerOfTheForceSentAndTheForceReported) {
  for (const float had_n : {0.0F, 0.5F, 2.5F}) {
    GuardConfig config;
    config.ramp_s = 0;
    GuardState state = met(config);
    for (int i = 0; i < 20; ++i) (void)next_force(config, state, {1, 0, 0});
    guard_motor(state, {{had_n, 0, 0}, {}, state.arming, false});
    guard_trip(state, Fault::kTooLate);
    const double first = size(guard_force(config, state, {1, 0, 0}));
    EXPECT_NEAR(first, 0.95 * std::min(1.0, static_cast<double>(had_n)), 1e-6) << had_n;
  }
}

// 60 s of 1 N sent are (1 - 1/e) N^2; of 2 N felt, four times that.
TEST(Guard, HeatIsThatOfTheReportedForceIfItIsLarger) {
  GuardConfig config;
  config.continuous_force_n = 4;
  config.max_force_n = 8;
  for (const float had_n : {0.0F, 2.0F}) {
    GuardState state = met(config);
    for (int i = 0; i < 60'000; ++i) {
      guard_motor(state, {{0, had_n, 0}, {}, state.arming, false});
      (void)next_force(config, state, {1, 0, 0});
    }
    const double expected = (1 - std::exp(-1)) * std::max(1.0, std::pow(had_n, 2.0));
    EXPECT_NEAR(state.heat_n2, expected, 0.01 * expected) << had_n;
  }
}

}  // namespace
}  // namespace stylet::hal
