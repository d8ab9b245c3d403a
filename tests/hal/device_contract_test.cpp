// SPDX-License-Identifier: Apache-2.0
// What every backend promises, tested with each of them on its stand-in.
#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <thread>
#include <vector>

#include "device_bench.h"

// A sanitizer brings a heap and locks of its own.
#ifndef STYLET_SANITIZED
#include "allocation_trap.h"

namespace {
thread_local bool g_counts_locks = false;
thread_local int g_locks = 0;
using Lock = int (*)(pthread_mutex_t*);
const Lock g_real_lock = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
}  // namespace

// In place of the C library's, for the whole program.
extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) {
  if (g_counts_locks) ++g_locks;
  // It may be called before this file's variables exist.
  if (g_real_lock == nullptr) {
    return reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"))(mutex);
  }
  return g_real_lock(mutex);
}
#endif

namespace stylet::hal {
namespace {

struct Backend {
  const char* name;
  MakeBench make;
};
void PrintTo(const Backend& backend, std::ostream* out) {
  *out << backend.name;
}

constexpr Vec3 kAskew = {0.5F, 1, -1.5F};

// As hard as the checks push a device, along this direction.
Vec3 push_along(const Bench& bench, Vec3 direction) {
  const auto scale = static_cast<float>(static_cast<double>(bench.push_n) / size(direction));
  return {scale * direction.x, scale * direction.y, scale * direction.z};
}

// Along the axes in which the device has a force.
Vec3 push_on(const Bench& bench) {
  return push_along(bench, bench.feels.any() ? bench.feels.of(kAskew) : kAskew);
}

// The hand feels most of a push.
bool is_pushed(Bench& bench) {
  return size(bench.felt()) > 0.5 * static_cast<double>(bench.push_n);
}

class DeviceContract : public testing::TestWithParam<Backend> {
 protected:
  std::unique_ptr<Bench> bench = GetParam().make();
  const Vec3 push = push_on(*bench);
};

constexpr float kRoot = 0.70710678F;

Quat product_sign(const Quat& a, const Quat& b) {
  const float same = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
  return {std::fabs(same), 0, 0, 0};
}

TEST_P(DeviceContract, PlacesAreMetresInOurFrame) {
  if (!bench->places.any()) GTEST_SKIP() << "it says how fast to move";
  Ticker ticker(bench->uri());
  const Pose places[] = {{{0.01F, 0.02F, -0.03F}, {1, 0, 0, 0}},
                         {{-0.04F, 0, 0}, {kRoot, kRoot, 0, 0}},
                         {{0, -0.05F, 0}, {kRoot, 0, kRoot, 0}},
                         {{0, 0, 0.06F}, {kRoot, 0, 0, -kRoot}},
                         {{0, 0, 0}, {0.5F, -0.5F, 0.5F, 0.5F}}};
  for (const Pose& place : places) {
    bench->move(place);
    EXPECT_TRUE(ticker.tick_until(
        {},
        [&] {
          return ticker.usable &&
                 size(bench->places.of(minus(ticker.sample.pose.position_m, place.position_m))) <
                     1e-6 &&
                 (!bench->turns ||
                  product_sign(ticker.sample.pose.rotation, place.rotation).w > 0.99999F);
        }))
        << ticker.sample.pose.position_m.x << " " << ticker.sample.pose.position_m.y << " "
        << ticker.sample.pose.position_m.z;
  }
}

TEST_P(DeviceContract, ForceOnTheHandHasOurSignAndAxes) {
  if (!bench->feels.any()) GTEST_SKIP() << "a device without force";
  Ticker ticker(bench->uri());
  const double apart_n = 1e-5 + std::sqrt(3.0) * static_cast<double>(bench->step_n);
  for (const Vec3 way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, kAskew}) {
    const Vec3 force = push_along(*bench, way), wanted = bench->feels.of(force);
    EXPECT_TRUE(
        ticker.tick_until(force, [&] { return size(minus(bench->felt(), wanted)) < apart_n; }))
        << bench->felt().x << " " << bench->felt().y << " " << bench->felt().z;
  }
}

TEST_P(DeviceContract, TorqueOnTheHandHasOurSignAndAxesAndEndsWithTheLoop) {
  Ticker ticker(bench->uri());
  const float most = ticker.device.info.max_torque_nm;
  if (!(most > 0)) GTEST_SKIP() << "a device without torque";
  for (const Vec3 way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vec3 wanted = {0.5F * most * way.x, 0.5F * most * way.y, 0.5F * most * way.z};
    bool felt = false;
    for (int i = 0; i < 500 && !felt; ++i) {
      ticker.tick({}, wanted);
      felt = size(minus(bench->felt_torque(), wanted)) < 1e-6;
    }
    EXPECT_TRUE(felt) << bench->felt_torque().x << " " << bench->felt_torque().y << " "
                      << bench->felt_torque().z;
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_EQ(size(bench->felt_torque()), 0);
}

TEST_P(DeviceContract, ButtonsArePressedAndReleased) {
  if (!bench->presses) GTEST_SKIP() << "a device without buttons";
  Ticker ticker(bench->uri());
  for (const std::uint32_t mask : {1U, 0U, 1U}) {
    bench->press(mask);
    EXPECT_TRUE(ticker.tick_until({}, [&] {
      return ticker.usable && ticker.sample.buttons == mask;
    })) << ticker.sample.buttons;
  }
}

TEST_P(DeviceContract, SequenceAndTimeNeverGoBack) {
  Ticker ticker(bench->uri());
  ASSERT_TRUE(ticker.tick_until({}, [&] { return ticker.usable; }));
  Sample last = ticker.sample;
  const Sample first = last;
  for (int i = 0; i < 300; ++i) {
    ticker.tick({});
    EXPECT_GE(ticker.sample.seq, last.seq);
    EXPECT_GE(ticker.sample.t_ns, last.t_ns);
    EXPECT_LE(ticker.sample.t_ns, monotonic_now_ns());
    last = ticker.sample;
  }
  EXPECT_GE(last.seq, first.seq + 100);
}

TEST_P(DeviceContract, ForceEndsWhenTheLoopStops) {
  if (!bench->feels.any()) GTEST_SKIP() << "a device without force";
  Ticker ticker(bench->uri());
  ASSERT_TRUE(ticker.tick_until(push, [&] { return is_pushed(*bench); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(60));  // without a tick: 20 ms and more
  EXPECT_EQ(size(bench->felt()), 0);
}

// The force as a thread of its own sees it, with the times at which it looked.
struct Felt {
  std::int64_t from_ns, to_ns;  // just before and after the look
  double force_n;
};

// Whatever the loop does, the hand feels no kick. The force is observed where it is felt.
TEST_P(DeviceContract, StallsOfTheLoopAreNoKicks) {
  if (!bench->feels.any() || !bench->latches)
    GTEST_SKIP() << "a peer's own program renders the force";
  Ticker ticker(bench->uri());
  const double slew = static_cast<double>(ticker.device.info.max_slew_n_per_s);
  for (const int stall_ms : {6, 12, 15, 25, 60}) {
    ASSERT_TRUE(ticker.tick_until(push, [&] { return is_pushed(*bench); })) << stall_ms;
    std::atomic<bool> stop{false};
    std::vector<Felt> seen;
    seen.reserve(100'000);
    std::thread looker([&] {
      while (!stop.load() && seen.size() < seen.capacity()) {
        const std::int64_t from_ns = monotonic_now_ns();
        const double force_n = size(bench->felt());
        seen.push_back({from_ns, monotonic_now_ns(), force_n});
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(stall_ms));
    for (int i = 0; i < 50; ++i) ticker.tick(push);  // nobody acknowledges
    stop.store(true);
    looker.join();
    const bool expired = ticker.state.fault != Fault::kNone;
    EXPECT_TRUE(stall_ms < 12 || expired) << stall_ms;
    EXPECT_TRUE(!expired || seen.back().force_n == 0) << stall_ms;
    for (std::size_t i = 1; i < seen.size(); ++i) {
      // The vendor's thread may have written a step of 2 ms just before the look.
      const double passed_s = static_cast<double>(seen[i].to_ns - seen[i - 1].from_ns) * 1e-9;
      const double change = seen[i].force_n - seen[i - 1].force_n;
      ASSERT_LE(change, slew * (passed_s + 2e-3)) << stall_ms << " ms, look " << i;
      // After a stall too short for a fault this look may be at a later tick, when the force has
      // already come back.
      if (!expired || stall_ms < 12) continue;
      const bool rising = seen[i].from_ns - seen[0].from_ns < 5'000'000;  // that of the last order
      ASSERT_TRUE(rising || change <= 1e-6) << stall_ms << " ms, look " << i;
    }
  }
}

TEST_P(DeviceContract, ClosedDeviceHasNoForceAndOpensAgain) {
  int at_once = 0;  // in the other tries this machine was busy
  for (int i = 0; i < 3; ++i) {
    Ticker ticker(bench->uri());
    if (bench->feels.any()) {
      EXPECT_TRUE(ticker.tick_until(push, [&] { return is_pushed(*bench); }));
    }
    ticker.close();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (size(bench->felt()) == 0) ++at_once;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(size(bench->felt()), 0);
  }
  EXPECT_GT(at_once, 0);
}

// The best of five tries: in the others this machine was busy.
double best_ms_to_zero(Bench& bench, test::Trouble trouble) {
  const Vec3 push = push_on(bench);
  double best = 1e9;
  for (int i = 0; i < 5 && best > 25; ++i) {
    bench.trouble(test::Trouble::kNone);
    Ticker ticker(bench.uri(), 3e-3F);
    if (!ticker.tick_until(push, [&] { return is_pushed(bench); })) continue;
    const auto start = std::chrono::steady_clock::now();
    bench.trouble(trouble);
    std::chrono::duration<double, std::milli> past{};
    while (past.count() <= 500) {
      const bool felt = size(bench.felt()) > 0;
      past = std::chrono::steady_clock::now() - start;
      if (!felt) {
        best = std::min(best, past.count());
        break;
      }
      ticker.tick(push);
    }
  }
  bench.trouble(test::Trouble::kNone);
  return best;
}

TEST_P(DeviceContract, SilentDeviceHasNoForceAfter25Milliseconds) {
  if (!bench->feels.any()) GTEST_SKIP() << "a device without force";
  EXPECT_LE(best_ms_to_zero(*bench, test::Trouble::kSilent), 25);
}

TEST_P(DeviceContract, BrokenDeviceHasNoForceAfter25Milliseconds) {
  if (!bench->feels.any()) GTEST_SKIP() << "a device without force";
  EXPECT_LE(best_ms_to_zero(*bench, test::Trouble::kNoAnswer), 25);
}

// GUARD.md, S4, with the watchdog of a scene that says nothing of it. The device's samples stop for
// 8 ms at a time: lost, or late until then.
TEST_P(DeviceContract, LostSamplesAreNoFault) {
  if (!bench->feels.any() || !bench->loses) GTEST_SKIP() << "its samples are not lost on the way";
  Ticker ticker(bench->uri(), 3e-3F);
  const auto life_s = static_cast<double>(ticker.device.info.force_life_s);
  EXPECT_LE(life_s, 20e-3 + 1e-6) << "force_life_s: its forces end 20 ms after their sample";
  ASSERT_GE(static_cast<double>(ticker.guard.watchdog_s), 15e-3 - 1e-6)
      << "force_life_s: expected 20 ms: a packet may be lost, see own_driver.md";
  int calm = 0;  // in the other rounds this machine was busy
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(ticker.tick_until(
        push, [&] { return ticker.state.fault == Fault::kNone && is_pushed(*bench); }));
    bench->trouble(test::Trouble::kSilent);
    for (int tick = 0; tick < 8; ++tick) ticker.tick(push);
    bench->trouble(test::Trouble::kNone);
    for (int tick = 0; tick < 20; ++tick) ticker.tick(push);
    if (ticker.state.fault == Fault::kNone) ++calm;
  }
  EXPECT_GE(calm, 3);
}

// Whichever tick is the watchdog's last one: what a person reads is what has happened.
TEST_P(DeviceContract, ADeviceThatSaysNothingIsCalledSilent) {
  if (!bench->feels.any() || !bench->fails) GTEST_SKIP() << "what says nothing is at rest";
  for (int i = 0; i < 5; ++i) {
    Ticker ticker(bench->uri(), 3e-3F);
    ASSERT_TRUE(ticker.tick_until(push, [&] { return is_pushed(*bench); }));
    bench->trouble(test::Trouble::kSilent);
    for (int tick = 0; tick < 500 && ticker.state.fault == Fault::kNone; ++tick) ticker.tick(push);
    const bool late = ticker.state.fault == Fault::kTooLate;  // this machine was busy
    EXPECT_TRUE(late || ticker.state.fault == Fault::kDeviceSilent)
        << fault_name(ticker.state.fault);
    bench->trouble(test::Trouble::kNone);
  }
}

// After trouble a device that is back shall not push, whatever the loop asks, until it is opened
// again.
TEST_P(DeviceContract, TroubleIsLatched) {
  if (!bench->feels.any() || !bench->latches) GTEST_SKIP() << "it is the guard that latches here";
  {
    Ticker ticker(bench->uri());
    ASSERT_TRUE(ticker.tick_until(push, [&] { return is_pushed(*bench); }));
    bench->trouble(test::Trouble::kNoAnswer);
    ASSERT_NE(ticker.trouble_under(push), "");
    bench->trouble(test::Trouble::kNone);
    const std::int64_t felt_until_ns =
        monotonic_now_ns() + 25'000'000;  // what was left of the force fades
    double last = size(bench->felt());
    for (int i = 0; i < 100; ++i) {
      ticker.tick({});
      ticker.device.write(ticker.device.self, {.force_n = push, .max_force_n = 3});
      EXPECT_FALSE(ticker.answered);
      const double felt = size(bench->felt());
      EXPECT_LE(felt, last);
      last = felt;
      if (monotonic_now_ns() > felt_until_ns) {
        EXPECT_EQ(felt, 0);
      }
    }
  }
  Ticker again(bench->uri());
  EXPECT_TRUE(again.tick_until(push, [&] { return is_pushed(*bench); }));
  EXPECT_EQ(again.device.trouble(again.device.self), "");
}

// In a run it is opened again by itself, and has no force before somebody acknowledges.
TEST_P(DeviceContract, ComesBackAndWaitsToBeAcknowledged) {
  if (!bench->fails) GTEST_SKIP() << "what says nothing is at rest";
  Ticker ticker(open_lasting_device(bench->uri()), 15e-3F);
  const auto feels = [&] { return !bench->feels.any() || is_pushed(*bench); };
  ASSERT_TRUE(ticker.tick_until(push, feels));
  bench->trouble(test::Trouble::kNoAnswer);
  for (int i = 0; i < 500 && ticker.state.mode != GuardMode::kFault; ++i) ticker.tick(push);
  ASSERT_EQ(ticker.state.mode, GuardMode::kFault);
  for (int i = 0; i < 300; ++i) ticker.tick(push);
  bench->trouble(test::Trouble::kNone);
  const std::uint64_t before = ticker.state.seq;
  bool back = false;
  for (int i = 0; i < 5000 && !back; ++i) {
    ticker.tick(push);
    back = ticker.usable;
    ASSERT_EQ(size(bench->felt()), 0);
  }
  ASSERT_TRUE(back) << trouble_of(ticker.device);
  EXPECT_GT(ticker.state.seq, before);
  for (int i = 0; i < 50; ++i) {
    ticker.tick(push);
    ASSERT_EQ(size(bench->felt()), 0);
  }
  EXPECT_EQ(trouble_of(ticker.device), "");
  EXPECT_TRUE(ticker.tick_until(push, feels));
}

#ifndef STYLET_SANITIZED
TEST_P(DeviceContract, TickTakesNoMemoryAndNoLock) {
  Ticker ticker(bench->uri());
  ASSERT_TRUE(ticker.tick_until({}, [&] { return ticker.usable; }));
  test::arm_allocation_trap();
  g_locks = 0;
  g_counts_locks = true;
  for (int i = 0; i < 200; ++i) ticker.tick(push);
  g_counts_locks = false;
  EXPECT_EQ(test::disarm_allocation_trap(), 0U);
  EXPECT_EQ(g_locks, 0);
}

TEST(DeviceContractTraps, LockTrapFires) {
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  g_locks = 0;
  g_counts_locks = true;
  pthread_mutex_lock(&mutex);
  g_counts_locks = false;
  pthread_mutex_unlock(&mutex);
  EXPECT_EQ(g_locks, 1);
}
#endif

// The priority of the loop's thread, if this machine grants it; the benches' threads inherit it.
class RealTime : public testing::Environment {
 public:
  void SetUp() override {
    constexpr sched_param kAsTheLoop = {80};
    (void)pthread_setschedparam(pthread_self(), SCHED_FIFO, &kAsTheLoop);
  }
};
const auto* const kRealTime = testing::AddGlobalTestEnvironment(new RealTime);

constexpr Backend kBackends[] = {{"hd", hd_bench},           {"dhd", dhd_bench},
                                 {"haply", haply_bench},     {"spacemouse", spacemouse_bench},
                                 {"pointer", pointer_bench}, {"udp", udp_bench},
                                 {"shm", shm_bench}};
TEST(DeviceContractBackends, AreThoseOfAllDrivers) {
  std::vector<std::string> here, all;
  for (const Backend& each : kBackends) here.emplace_back(each.name);
  for (const DriverDescriptor* each : drivers()) all.emplace_back(each->scheme);
  EXPECT_EQ(here, all);
}
INSTANTIATE_TEST_SUITE_P(All, DeviceContract, testing::ValuesIn(kBackends),
                         [](const auto& each) { return each.param.name; });

// One motor is enough for every check of force.
constexpr Backend kOneAxis = {"one_axis", one_axis_bench};
TEST(DeviceContractBackends, ADeviceWithOneMotorIsPushedAlongIt) {
  const std::unique_ptr<Bench> bench = one_axis_bench();
  EXPECT_TRUE(bench->feels.any() && bench->places.any() && bench->latches && bench->fails)
      << "no check of force leaves it out";
  const Vec3 push = push_on(*bench);
  EXPECT_EQ(push.x, 0);
  EXPECT_EQ(push.y, 0);
  EXPECT_FLOAT_EQ(std::fabs(push.z), bench->push_n);
}
INSTANTIATE_TEST_SUITE_P(More, DeviceContract, testing::Values(kOneAxis),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace stylet::hal
