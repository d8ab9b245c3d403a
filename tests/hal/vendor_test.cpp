// SPDX-License-Identifier: Apache-2.0
// What is special about a vendor's library: opening, calibration, warnings, locale, several
// devices.
#include <dlfcn.h>

#include <clocale>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <span>

#include "device_bench.h"
#include "hal/device/driver_call.h"
#include "hal/device/drivers/force_dimension.h"
#include "hal/device/drivers/openhaptics.h"
#include "hal/device/model.h"
#include "hal/doctor/probe.h"
#include "hal/loop/loop.h"
#include "hal/scene/scene.h"

namespace stylet::hal {
namespace {

using test::StandIn;
using test::StandInOf;
using test::Trouble;

StandInOf standin_of(const char* library) {
  void* loaded = dlopen(library, RTLD_NOW | RTLD_NODELETE);
  return reinterpret_cast<StandInOf>(dlsym(loaded, "standin"));
}

// The one line with which opening is refused.
std::string refusal(const std::string& uri) {
  try {
    const Device device = open_device(uri, 0.2);
    device.close(device.self);
  } catch (const DeviceError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "opened";
}

bool says(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

class OpenHaptics : public testing::Test {
 protected:
  std::unique_ptr<Bench> bench = hd_bench();
  StandInOf standin = standin_of(STYLET_STANDIN_HD);
};

TEST_F(OpenHaptics, ErrorsAtOpeningAreNamedWithARemedy) {
  bench->trouble(Trouble::kNoDevice);
  EXPECT_TRUE(says(refusal("hd:"), "0x0302 (communication error), internal -28"));
  bench->trouble(Trouble::kInUse);
  EXPECT_TRUE(says(refusal("hd:"), "close the other program"));
  bench->trouble(Trouble::kNone);
  EXPECT_TRUE(says(refusal("hd:Nobody"), "hd:Nobody: error 0x0302"));
  EXPECT_EQ(refusal("hd:"), "opened");
}

TEST_F(OpenHaptics, WaitsForTheInkwell) {
  bench->trouble(Trouble::kUncalibrated);
  standin(0)->updates = -1000;
  EXPECT_TRUE(says(refusal("hd:"), "not calibrated (0x5001): put the stylus into the inkwell"));
  standin(0)->updates = 0;
  Ticker ticker("hd:");
  EXPECT_EQ(standin(0)->updates.load(), 2);
}

TEST_F(OpenHaptics, WarmMotorsAreNoFault) {
  Ticker ticker("hd:");
  bench->trouble(Trouble::kHarmless);
  EXPECT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return size(bench->felt()) > 0.9; }));
  for (int i = 0; i < 50; ++i) ticker.tick({0, 0, 1});
  EXPECT_TRUE(ticker.answered);
}

TEST_F(OpenHaptics, CapabilityIsThatOfTheDevice) {
  const Ticker ticker("hd:");
  EXPECT_FLOAT_EQ(ticker.device.info.max_force_n, 0.9F * 3.3F);
  EXPECT_FLOAT_EQ(ticker.device.info.max_stiffness_n_per_m, 400);
  EXPECT_FLOAT_EQ(ticker.device.info.continuous_force_n, 0.88F);
  EXPECT_STREQ(ticker.device.info.name, "Stand-in Touch");
}

// What the library does not report is taken from the smallest of the vendor's devices, never as
// unlimited.
TEST_F(OpenHaptics, CapabilityThatCannotBeReadIsThatOfTheSmallestDevice) {
  standin(0)->mute = true;
  {
    const Ticker ticker("hd:");
    EXPECT_FLOAT_EQ(ticker.device.info.max_force_n, 0.9F * 3.3F);
    EXPECT_FLOAT_EQ(ticker.device.info.max_stiffness_n_per_m, 400);
    EXPECT_FLOAT_EQ(ticker.device.info.continuous_force_n, 0.88F);
  }
  standin(0)->mute = false;
}

TEST_F(OpenHaptics, UsersLocaleIsHiddenFromTheVendorAndRestored) {
  ASSERT_NE(std::setlocale(LC_NUMERIC, "C.UTF-8"), nullptr);
  bench->move({{0.05F, 0, 0}, {1, 0, 0, 0}});
  {
    Ticker ticker("hd:");
    EXPECT_TRUE(ticker.tick_until({}, [&] { return ticker.usable; }));
    EXPECT_FLOAT_EQ(ticker.sample.pose.position_m.x, 0.05F);
    EXPECT_STREQ(std::setlocale(LC_NUMERIC, nullptr), "C.UTF-8");
  }
  std::setlocale(LC_NUMERIC, "C");
}

TEST_F(OpenHaptics, NoForbiddenCallIsMade) {
  standin(0)->forbidden = 0;
  {
    Ticker ticker("hd:");
    for (int i = 0; i < 50; ++i) ticker.tick({1, 0, 0});
  }
  EXPECT_EQ(standin(0)->forbidden.load(), 0);
}

// A tick that is a little late is no fault. If a tick is very late, the force has ended when it
// comes, and the device goes on after an acknowledgement.
TEST_F(OpenHaptics, LateTicksOfTheVendorsThread) {
  Ticker ticker("hd:", 3e-3F);
  const auto feels = [&] { return size(bench->felt()) > 0.9; };
  ASSERT_TRUE(ticker.tick_until({0, 0, 1}, feels));
  bool survived = false;
  for (int i = 0; i < 20 && !survived; ++i) {  // this machine may itself be late
    if (ticker.state.fault != Fault::kNone) (void)guard_rearm(ticker.state, ticker.state.fault);
    const std::uint64_t faults = ticker.state.counters.faults;
    standin(0)->late_ms = 1;
    for (int k = 0; k < 10; ++k) ticker.tick({0, 0, 1});
    survived = ticker.state.counters.faults == faults && ticker.state.fault == Fault::kNone;
  }
  EXPECT_TRUE(survived);
  ASSERT_TRUE(ticker.tick_until({0, 0, 1}, feels));
  standin(0)->late_ms = 15;
  for (int i = 0; i < 40; ++i) ticker.tick({0, 0, 1});
  EXPECT_NE(ticker.state.fault, Fault::kNone);
  EXPECT_EQ(size(bench->felt()), 0);
  EXPECT_EQ(trouble_of(ticker.device), "");
  EXPECT_TRUE(ticker.tick_until({0, 0, 1}, feels));
}

// What `stylet devices probe --push` sees with a hand of 200 g: it goes where it is pushed. Returns
// its shortest way in a push.
double least_push_m(const std::string& uri) {
  const Device device = open_device(uri);
  const std::atomic<bool> stop{false};
  auto probe = std::make_unique<DeviceProbe>();
  probe_device(device, 0.1, true, monotonic_clock(), stop, *probe);
  device.close(device.self);
  constexpr std::array<Vec3, 6> kWays = {
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  float least = 1;
  for (std::size_t i = 0; i < kWays.size(); ++i) {
    const Vec3 moved = probe->push[i].moved_m, way = kWays[i];
    least = std::min(least, moved.x * way.x + moved.y * way.y + moved.z * way.z);
  }
  return static_cast<double>(least);
}

// One of ten tries is enough: in the others this machine may have been busy.
void expect_pushed_along(const std::string& uri) {
  double best = -1;
  for (int i = 0; i < 10 && best < 2e-3; ++i) best = std::max(best, least_push_m(uri));
  EXPECT_GT(best, 2e-3);
}

TEST_F(OpenHaptics, AHandGoesWhereItIsPushed) {
  standin(0)->hand_kg = 0.2;
  expect_pushed_along("hd:");
}

// The scheduler stands still while a device is opened. The other device's supervisor must not take
// that for a stall.
TEST_F(OpenHaptics, OpeningTheSecondDoesNotFailTheFirst) {
  Ticker left("hd:Left");
  ASSERT_TRUE(left.tick_until({}, [&] { return left.usable; }));
  standin(1)->trouble = Trouble::kUncalibrated;  // opening takes long
  standin(1)->updates = -2;
  {
    Ticker right("hd:Right");
    EXPECT_TRUE(left.tick_until({}, [&] { return left.usable; }));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(40));
  EXPECT_TRUE(left.tick_until({}, [&] { return left.usable; }));
  EXPECT_EQ(trouble_of(left.device), "");
}

// Each device has its own position and force.
TEST_F(OpenHaptics, TwoDevicesHaveTheirOwnPlacesAndForces) {
  Ticker left("hd:Left"), right("hd:Right");
  standin(0)->position[0] = 10;
  standin(1)->position[0] = 20;
  const auto done = [&] {
    left.tick({1, 0, 0});
    return std::fabs(standin(0)->force[0].load() - 1) < 1e-5 &&
           std::fabs(standin(1)->force[1].load() - 2) < 1e-5 &&
           left.sample.pose.position_m.x == 0.01F && right.sample.pose.position_m.x == 0.02F;
  };
  EXPECT_TRUE(right.tick_until({0, 2, 0}, done));
  // One device fails, and the other goes on.
  standin(0)->trouble = Trouble::kNoAnswer;
  EXPECT_TRUE(right.tick_until({0, 2, 0}, [&] {
    left.tick({1, 0, 0});
    return !left.answered;
  }));
  for (int i = 0; i < 30; ++i) right.tick({0, 2, 0});
  EXPECT_TRUE(right.answered);
  EXPECT_NEAR(standin(1)->force[1].load(), 2, 1e-5);
  left.close();
  EXPECT_TRUE(right.tick_until({0, 1, 0},
                               [&] { return std::fabs(standin(1)->force[1].load() - 1) < 1e-5; }));
}

// ---- names, serials, models

class Folder {
 public:
  Folder() { std::filesystem::create_directories(path_ + "/config"); }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  void name(const std::string& device) const { std::ofstream(path_ + "/config/" + device); }
  const std::string path_ = testing::TempDir() + "names" + std::to_string(getpid());
};

TEST_F(OpenHaptics, ANameThatIsNotConfiguredIsNotReportedAsNoCable) {
  const Folder folder;
  setenv("GTDD_HOME", folder.path_.c_str(), 1);
  EXPECT_TRUE(says(refusal("hd:Nobody"), "no device of any name is configured in"));
  folder.name("Left.config");
  folder.name("notes.txt");
  const std::string why = refusal("hd:Nobody");
  EXPECT_TRUE(says(why, "no device of this name is configured in")) << why;
  EXPECT_TRUE(says(why, "expected \"Left\"")) << why;
  EXPECT_FALSE(says(why, "check the cable")) << why;
  EXPECT_FALSE(says(why, "notes")) << why;
  bench->trouble(Trouble::kNoDevice);  // it has a name, but no cable
  EXPECT_TRUE(says(refusal("hd:Left"), "check the cable"));
  unsetenv("GTDD_HOME");
}

TEST_F(OpenHaptics, AnotherDeviceDoesNotReplaceTheFirst) {
  standin(0)->serial = "40915001";
  Ticker ticker(open_lasting_device("hd:"), 15e-3F);
  EXPECT_STREQ(ticker.device.info.identity, "40915001");
  standin(0)->serial = "50915002";
  bench->trouble(Trouble::kNoAnswer);
  (void)ticker.trouble_under({0, 0, 1});
  bench->trouble(Trouble::kNone);
  const auto refused = [&] {
    return says(trouble_of(ticker.device), "50915002 is there instead of 40915001");
  };
  bool told = false;
  for (int i = 0; i < 10 && !told; ++i) told = ticker.tick_until({0, 0, 1}, refused);
  EXPECT_TRUE(told) << trouble_of(ticker.device);
  EXPECT_EQ(size(bench->felt()), 0);
  ticker.close();
  standin(0)->serial = nullptr;
}

// A guard that is fitted to the opened device, in virtual time. Returns the fault that it latches
// under this motion and force.
Fault fault_under(const DeviceInfo& info, double hz, double way_m, double force_n) {
  const char* strong = "[device]\nmax_force_n = 30\n[guard]\nramp_ms = 0\n";
  Hand hand = parse_scene(strong, "s", 1).hands[0];
  (void)fit_to_device(info, hand);
  GuardState state = guard_start();
  for (std::uint64_t tick = 1; tick <= 2000 && state.fault == Fault::kNone; ++tick) {
    const double phase = 2 * std::numbers::pi * hz * static_cast<double>(tick) * 1e-3;
    const auto now_ns = static_cast<std::int64_t>(tick) * 1'000'000;
    const auto x = static_cast<float>(way_m * std::sin(phase));
    const Sample sample = {tick, now_ns, {{x, 0, 0}, {1, 0, 0, 0}}, 0};
    (void)guard_sample(hand.guard, state, true, sample, now_ns);
    (void)guard_force(hand.guard, state, {static_cast<float>(force_n * std::cos(phase)), 0, 0});
  }
  return state.fault;
}

struct Told {
  const char* calls_itself;
  double most_n, stiffness_n_per_mm, always_n;  // as the vendor's library reports; 0: nothing
  const char* model;
  double expected_most_n, expected_always_n;
};

// Numbers are from data sheets. A buzz of a tenth of the device's largest force is a fault; a
// smaller one is not.
TEST_F(OpenHaptics, EveryModelHasItsOwnThresholds) {
  const Told all[] = {{"Touch", 3.3, 0.4, 0.88, "touch", 3.3, 0.88},
                      {"PHANTOM Omni", 3.3, 0.5, 0.88, "omni", 3.3, 0.88},
                      {"Touch X", 7.9, 1.8, 1.75, "touch-x", 7.9, 1.75},
                      {"PHANTOM Premium 1.5", 8.5, 3.5, 1.4, "premium-1.5", 8.5, 1.4},
                      {"PHANTOM Premium 3.0", 22, 1, 3, "premium-3.0", 22, 3},
                      {"Touch", 30, 9, 30, "touch", 3.3, 0.88},  // more than its kind can
                      {"Spoon", 5, 1, 2, "unknown", 5, 2},
                      {"Spoon", 0, 0, 0, "unknown", 3.3, 0.88},
                      {"Touch X", 0, 0, 0, "touch-x", 7.9, 1.75}};
  for (const Told& each : all) {
    standin(0)->model = each.calls_itself;
    standin(0)->mute = each.most_n == 0;
    standin(0)->most_force_n = each.most_n;
    standin(0)->most_stiffness_n_per_mm = each.stiffness_n_per_mm;
    standin(0)->always_n = each.always_n;
    const Device device = open_device("hd:");
    const DeviceInfo& info = device.info;
    EXPECT_STREQ(info.model->name, each.model) << each.calls_itself;
    EXPECT_NEAR(info.max_force_n, 0.9 * each.expected_most_n, 1e-5) << each.calls_itself;
    EXPECT_NEAR(info.continuous_force_n, each.expected_always_n, 1e-5) << each.calls_itself;
    const double buzz_n = 0.1 * 0.9 * each.expected_most_n;
    EXPECT_EQ(fault_under(info, 40, 0, 1.4 * buzz_n), Fault::kBuzz) << each.calls_itself;
    EXPECT_EQ(fault_under(info, 40, 0, 0.8 * buzz_n), Fault::kNone) << each.calls_itself;
    // The force is in phase with the hand's velocity, so each turn makes some mJ, more than the arm
    // takes up.
    const double made_n = 0.9 * 0.9 * each.expected_most_n;
    EXPECT_EQ(fault_under(info, 8, 5e-3, made_n), Fault::kEnergy) << each.calls_itself;
    device.close(device.self);
  }
  standin(0)->model = nullptr;
  standin(0)->mute = false;
  standin(0)->most_force_n = standin(0)->most_stiffness_n_per_mm = standin(0)->always_n = 0;
}

TEST_F(OpenHaptics, MotionThatMakesEnergyOnATouchIsAFault) {
  const Device device = open_device("hd:");
  EXPECT_EQ(fault_under(device.info, 40, 0, 0.65), Fault::kBuzz);
  EXPECT_NE(fault_under(device.info, 25, 3e-3, 0.65), Fault::kNone);
  device.close(device.self);
}

// ---- calls that never return

using test::Hang;

// The end comes within a limited time and names what hangs, and the motors have no force.
void expect_bounded_end(const std::string& uri, Bench& bench, StandIn& unit, Hang call) {
  const Device device = open_device(uri);
  {
    Ticker ticker(device, 15e-3F);
    EXPECT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return size(bench.felt()) > 0.9; }));
    ticker.device.close = nullptr;
  }
  unit.hangs = call;
  const auto start = std::chrono::steady_clock::now();
  const int before = driver_calls_given_up();
  const std::vector<std::size_t> hang =
      close_devices(std::span(&device, 1), std::chrono::milliseconds(600));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(hang, std::vector<std::size_t>{0}) << static_cast<int>(call);
  EXPECT_LT(took.count(), 5);  // on a machine that is very busy
  EXPECT_EQ(driver_calls_given_up(), before + 1);
  EXPECT_EQ(size(bench.felt()), 0) << static_cast<int>(call);
  unit.hangs = Hang::kNone;
  for (int i = 0; i < 500 && refusal(uri) != "opened"; ++i) {  // until that thread ends
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

TEST_F(OpenHaptics, ADriverThatHangsDoesNotHoldUpTheEnd) {
  for (const Hang call : {Hang::kRead, Hang::kWrite, Hang::kClose}) {
    expect_bounded_end("hd:", *bench, *standin(0), call);
  }
}

TEST_F(OpenHaptics, OpeningThatHangsIsGivenUp) {
  standin(0)->hangs = Hang::kOpen;
  bench->trouble(Trouble::kNoDevice);  // its result is not wanted any more
  int asked = 0;
  const auto device =
      call_driver<Device>([] { return open_device("hd:"); }, [&asked] { return ++asked > 20; });
  EXPECT_FALSE(device.has_value());
  standin(0)->hangs = Hang::kNone;
  EXPECT_TRUE(says(refusal("hd:"), "0x0302"));
  bench->trouble(Trouble::kNone);
}

class ForceDimension : public testing::Test {
 protected:
  std::unique_ptr<Bench> bench = dhd_bench();
  StandInOf standin = standin_of(STYLET_STANDIN_DHD_NOW);
};

TEST_F(ForceDimension, ErrorsAtOpeningAreNamedWithARemedy) {
  bench->trouble(Trouble::kNoDevice);
  EXPECT_TRUE(says(refusal("dhd:"), "no device found: check cable, power"));
  bench->trouble(Trouble::kInUse);
  EXPECT_TRUE(says(refusal("dhd:0"), "device in use"));
  bench->trouble(Trouble::kNone);
  EXPECT_TRUE(says(refusal("dhd:first"), "dhd:first: expected nothing, or the number"));
  EXPECT_TRUE(says(refusal("dhd:7"), "dhd:7: "));
  EXPECT_EQ(refusal("dhd:0"), "opened");
}

TEST_F(ForceDimension, WaitsForCalibrationAndNeverMovesTheArm) {
  bench->trouble(Trouble::kUncalibrated);
  standin(0)->updates = -1000;
  EXPECT_TRUE(says(refusal("dhd:0"), "not calibrated: put the end-effector"));
  standin(0)->updates = 0;
  EXPECT_EQ(refusal("dhd:0"), "opened");
}

TEST_F(ForceDimension, SaturationIsNoFault) {
  Ticker ticker("dhd:0");
  bench->trouble(Trouble::kHarmless);
  for (int i = 0; i < 50; ++i) ticker.tick({0, 0, 1});
  EXPECT_TRUE(ticker.answered);
  EXPECT_NEAR(bench->felt().z, 1, 1e-5F);
}

TEST_F(ForceDimension, ForcesSwitchedOffStayOff) {
  Ticker ticker("dhd:0");
  ASSERT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return size(bench->felt()) > 0.9; }));
  for (int i = 0; i < 50; ++i) ticker.tick({0, 0, 1});  // until its status is read
  bench->trouble(Trouble::kForcesOff);
  EXPECT_EQ(ticker.trouble_under({0, 0, 1}), "forces are off: its button was pressed");
}

TEST_F(ForceDimension, ADriverThatHangsDoesNotHoldUpTheEnd) {
  for (const Hang call : {Hang::kRead, Hang::kWrite, Hang::kClose}) {
    expect_bounded_end("dhd:0", *bench, *standin(0), call);
  }
}

// The firmware does not cut the force, so another thread of ours does while the call still hangs.
TEST_F(ForceDimension, ACallThatHangsWithoutAWatchdogIsCutAndReported) {
  for (const Hang call : {Hang::kRead, Hang::kWrite}) {
    bench->refuse_watchdog(true);
    EXPECT_EQ(force_dimension_watchdog(), std::optional<bool>(false));
    Ticker ticker(open_lasting_device("dhd:0"), 15e-3F);
    EXPECT_TRUE(says(note_of(ticker.device), "refuses the watchdog"));
    ASSERT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return size(bench->felt()) > 0.9; }));
    standin(0)->hangs = call;
    EXPECT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return size(bench->felt()) == 0; }));
    EXPECT_TRUE(says(ticker.trouble_under({0, 0, 1}), "hangs: forces were switched off"));
    EXPECT_EQ(size(bench->felt()), 0);
    standin(0)->hangs = Hang::kNone;
  }
}

TEST_F(ForceDimension, AWatchdogThatIsAcceptedIsNotMentioned) {
  EXPECT_EQ(force_dimension_watchdog(), std::optional<bool>(true));
  const Ticker ticker("dhd:0");
  EXPECT_EQ(note_of(ticker.device), "");
  EXPECT_EQ(force_dimension_watchdog(), std::nullopt) << "it is in use";
}

// If the button for forces is not pressed, a whole run would feel like air.
TEST_F(ForceDimension, ForcesThatNeverCameOnAreRefused) {
  bench->trouble(Trouble::kForcesOff);
  EXPECT_TRUE(says(refusal("dhd:0"), "press the force button"));
  bench->trouble(Trouble::kNone);
  EXPECT_EQ(refusal("dhd:0"), "opened");
}

TEST_F(ForceDimension, TypeNumbersNameModelsAndSerialsTellDevicesApart) {
  struct Numbered {
    int type;
    const char* model;
    float most_n;
  };
  const Numbered all[] = {{33, "omega.3", 12},  {36, "omega.6", 12}, {35, "omega.7", 12},
                          {60, "falcon", 8},    {63, "delta.6", 20}, {104, "sigma.7", 12},
                          {91, "unknown", 3.3F}};
  for (const Numbered& each : all) {
    standin(0)->type = each.type;
    standin(0)->serial = "1234";
    const Device device = open_device("dhd:0");
    EXPECT_STREQ(device.info.model->name, each.model);
    EXPECT_FLOAT_EQ(device.info.max_force_n, 0.9F * each.most_n);
    EXPECT_STREQ(device.info.identity, "1234");
    device.close(device.self);
  }
  standin(0)->type = 0;
  standin(0)->serial = nullptr;
}

TEST_F(ForceDimension, AHandGoesWhereItIsPushed) {
  standin(0)->hand_kg = 0.2;
  expect_pushed_along("dhd:0");
}

TEST_F(ForceDimension, TheBrakeIsNamedAsTheTrouble) {
  Ticker ticker("dhd:0");
  for (int i = 0; i < 50; ++i) ticker.tick({0, 0, 1});  // until its status is read
  standin(0)->hand_kg = 0.2;
  standin(0)->velocity[1] = 1;
  EXPECT_EQ(ticker.trouble_under({0, 0, 1}), "forces are off: it was moved too fast");
  EXPECT_EQ(size(bench->felt()), 0);
}

// Force commands carry the arm's weight, even those of zero force, and even when the loop has
// stopped.
TEST_F(ForceDimension, ArmDoesNotSagWhileTheLoopStandsStill) {
  Ticker ticker("dhd:0");
  for (int i = 0; i < 20; ++i) ticker.tick({});
  standin(0)->hand_kg = 0.2;
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_GT(standin(0)->position[2].load(), -0.02);  // free, it would have fallen 60 mm
}

TEST_F(ForceDimension, ClosedGripperIsItsFirstButton) {
  Ticker ticker("dhd:0");
  for (const bool pinched : {true, false}) {
    standin(0)->pinched = pinched;
    const std::uint32_t buttons = pinched ? 1 : 0;
    EXPECT_TRUE(ticker.tick_until({}, [&] { return ticker.sample.buttons == buttons; }));
  }
}

TEST_F(ForceDimension, TorqueTurnsAsTheForceDoes) {
  Ticker ticker("dhd:0");
  EXPECT_GT(ticker.device.info.max_torque_nm, 0);
  for (int i = 0; i < 20; ++i) {
    ticker.tick({});
    ticker.device.write(ticker.device.self,
                        {.force_n = {}, .torque_nm = {0.01F, 0.02F, 0.03F}, .max_force_n = 3});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  // Our axes: x right, y up, z toward the operator; the vendor's: x toward the operator, y right, z
  // up.
  EXPECT_NEAR(standin(0)->torque[0].load(), 0.03, 1e-6);
  EXPECT_NEAR(standin(0)->torque[1].load(), 0.01, 1e-6);
  EXPECT_NEAR(standin(0)->torque[2].load(), 0.02, 1e-6);
}

TEST(VendorLibrary, AMissingLibraryIsNamedWithWhatWasTried) {
  // In a separate process, because a library that was found once stays loaded.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("STYLET_LIBHD", "/nowhere/libHD.so", 1);
        const std::string why = openhaptics_missing();
        const bool good = says(why, "/nowhere/libHD.so") && says(why, "STYLET_LIBHD");
        if (!good) std::fputs(why.c_str(), stderr);
        std::exit(good ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace stylet::hal
