// SPDX-License-Identifier: Apache-2.0
// What is particular to a vendor's library: opening, calibration, warnings, locale, several
// devices.
#include <dlfcn.h>

#include <clocale>

#include "device_bench.h"
#include "stylet/hal/device_probe.h"
#include "stylet/hal/loop.h"
#include "stylet/hal/openhaptics.h"

namespace stylet::hal {
namespace {

using test::StandIn;
using test::StandInOf;
using test::Trouble;

StandInOf standin_of(const char* library) {
  void* loaded = dlopen(library, RTLD_NOW | RTLD_NODELETE);
  return reinterpret_cast<StandInOf>(dlsym(loaded, "standin"));
}

// One line that opening throws.
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

TEST_F(OpenHaptics, CapabilityIsTheDevicesOwn) {
  const Ticker ticker("hd:");
  EXPECT_FLOAT_EQ(ticker.device.info.max_force_n, 0.9F * 3.3F);
  EXPECT_FLOAT_EQ(ticker.device.info.max_stiffness_n_per_m, 400);
  EXPECT_FLOAT_EQ(ticker.device.info.continuous_force_n, 0.88F);
  EXPECT_STREQ(ticker.device.info.name, "Stand-in Touch");
}

// What it does not tell is taken as the smallest of the vendor's devices has it, never as no limit.
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

TEST_F(OpenHaptics, UsersLocaleIsKeptAwayFromTheVendorAndGivenBack) {
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

TEST_F(OpenHaptics, NothingForbiddenIsCalled) {
  standin(0)->forbidden = 0;
  {
    Ticker ticker("hd:");
    for (int i = 0; i < 50; ++i) ticker.tick({1, 0, 0});
  }
  EXPECT_EQ(standin(0)->forbidden.load(), 0);
}

// A tick that is a little late is nobody's fault; the force of one that is very late has ended when
// it comes, and the device goes on when somebody has acknowledged.
TEST_F(OpenHaptics, LateTicksOfTheVendorsThread) {
  Ticker ticker("hd:", 3e-3F);
  const auto feels = [&] { return size(bench->felt()) > 0.9; };
  ASSERT_TRUE(ticker.tick_until({0, 0, 1}, feels));
  bool survived = false;
  for (int i = 0; i < 20 && !survived; ++i) {  // this machine may be late by itself
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

// What `stylet devices probe --push` sees of a hand of 200 g: it goes where it is pushed. The least
// way it went along a push.
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

// Of ten tries one is enough: in the others this machine had something else to do.
void expect_pushed_along(const std::string& uri) {
  double best = -1;
  for (int i = 0; i < 10 && best < 2e-3; ++i) best = std::max(best, least_push_m(uri));
  EXPECT_GT(best, 2e-3);
}

TEST_F(OpenHaptics, AHandGoesWhereItIsPushed) {
  standin(0)->hand_kg = 0.2;
  expect_pushed_along("hd:");
}

// The scheduler stands while one is opened: the other's supervisor must not take that for a stall.
TEST_F(OpenHaptics, OpeningTheSecondLeavesTheFirstItsDevice) {
  Ticker left("hd:Left");
  ASSERT_TRUE(left.tick_until({}, [&] { return left.usable; }));
  standin(1)->trouble = Trouble::kUncalibrated;  // takes its time
  standin(1)->updates = -2;
  {
    Ticker right("hd:Right");
    EXPECT_TRUE(left.tick_until({}, [&] { return left.usable; }));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(40));
  EXPECT_TRUE(left.tick_until({}, [&] { return left.usable; }));
  EXPECT_EQ(trouble_of(left.device), "");
}

// Peers give both devices the same force, or refuse the second.
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
  // One breaks: the other goes on.
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
  for (int i = 0; i < 50; ++i) ticker.tick({0, 0, 1});  // its status was looked at
  bench->trouble(Trouble::kForcesOff);
  EXPECT_EQ(ticker.trouble_under({0, 0, 1}), "forces are off: its button was pressed");
}

TEST_F(ForceDimension, AHandGoesWhereItIsPushed) {
  standin(0)->hand_kg = 0.2;
  expect_pushed_along("dhd:0");
}

TEST_F(ForceDimension, BrakeIsTroubleThatIsNamed) {
  Ticker ticker("dhd:0");
  for (int i = 0; i < 50; ++i) ticker.tick({0, 0, 1});  // its status was looked at
  standin(0)->hand_kg = 0.2;
  standin(0)->velocity[1] = 1;
  EXPECT_EQ(ticker.trouble_under({0, 0, 1}), "forces are off: it was moved too fast");
  EXPECT_EQ(size(bench->felt()), 0);
}

// The arm is carried by the commands, zero ones, too: also when the loop has stopped.
TEST_F(ForceDimension, ArmDoesNotSagWhileTheLoopStands) {
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
  // Ours x right, y up, z toward the operator; the vendor's x toward him, y right, z up.
  EXPECT_NEAR(standin(0)->torque[0].load(), 0.03, 1e-6);
  EXPECT_NEAR(standin(0)->torque[1].load(), 0.01, 1e-6);
  EXPECT_NEAR(standin(0)->torque[2].load(), 0.02, 1e-6);
}

TEST(VendorLibrary, MissingOneIsNamedWithWhatWasTried) {
  // In a process of its own: a library that was found once stays.
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
