// SPDX-License-Identifier: Apache-2.0
// What is particular to services: Haply's and spacenavd.
#include "service_bench.h"

namespace stylet::hal {
namespace {

std::string refusal(const std::string& uri) {
  try {
    const Device device = open_device(uri, 0.2);
    device.close(device.self);
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "opened";
}

bool says(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST(Haply, RefusalsNameWhatIsMissing) {
  EXPECT_TRUE(says(refusal("haply:@127.0.0.1:9"), "start haply-inverse-service"));
  EXPECT_TRUE(says(refusal("haply:049D@here"), "expected nothing, ID, or ID@ADDRESS:PORT"));
  EXPECT_TRUE(says(refusal("haply:049D,gate=2"), "gate=2: expected nothing, ID"));
  EXPECT_TRUE(says(refusal("haply:,volume=1"), "volume=1: expected"));
  HaplyService service;
  service.trouble(test::Trouble::kUncalibrated);
  EXPECT_TRUE(says(refusal(service.uri()), "not calibrated"));
  service.trouble(test::Trouble::kNone);
  EXPECT_TRUE(says(refusal(service.address("0000")), "lists no such Inverse3"));
  EXPECT_EQ(refusal(service.uri()), "opened");
}

TEST(Haply, DampingIsTheKernelsAndTheGateTheServices) {
  HaplyService service;
  {
    Ticker ticker(service.uri());
    EXPECT_EQ(service.damping, 0);
    EXPECT_EQ(service.gate, 0.3);
    EXPECT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return service.felt().z > 0.9F; }));
    for (int i = 0; i < 20; ++i) ticker.tick({0, 0, 1});
    const std::string about = ticker.device.about(ticker.device.self);
    EXPECT_TRUE(says(about, "force gate 0.3 and damping 0.5, now 0.3 and 0")) << about;
    EXPECT_TRUE(says(about, "1.00 N asked, 0.80 N rendered")) << about;
  }
  Ticker ticker(service.uri_with(",gate=1,damping=0.25"));
  EXPECT_EQ(service.damping, 0.25);
  EXPECT_EQ(service.gate, 1);
}

TEST(Haply, EventsEndTheDeviceByTheirName) {
  HaplyService service;
  const auto trouble_of_event = [&service](Ticker& ticker, const std::string& event) {
    service.tell(event);
    return ticker.trouble_under({});
  };
  const std::string brake = R"({"name":"device-safety-triggered","level":"error",)"
                            R"("data":{"device_id":"049D","safety_type":"ebrake_triggered"},)"
                            R"("message":"brake engaged"})";
  {
    Ticker ticker(service.uri());
    service.tell(R"({"name":"device-disconnected","level":"warning","data":{"device_id":"AAAA"}})");
    service.tell("no event");
    service.tell(R"({"name":7,"data":"x"})");
    for (int i = 0; i < 100; ++i) ticker.tick({});
    EXPECT_EQ(trouble_of(ticker.device), "");
    EXPECT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return service.felt().z > 0.9F; }));
    EXPECT_EQ(trouble_of_event(ticker, brake),
              "its emergency brake has locked it (device-safety-triggered: brake engaged)");
    EXPECT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return size(service.felt()) == 0; }));
  }
  Ticker ticker(service.uri());
  const std::string gone = trouble_of_event(
      ticker, R"({"name":"device-disconnected","level":"warning","data":{"device_id":"049D"}})");
  EXPECT_TRUE(says(gone, "check its cable")) << gone;
}

// An older service has no such channel.
TEST(Haply, NoEventsIsNoTrouble) {
  HaplyService service;
  Ticker ticker(service.address() + ",events=1");
  EXPECT_TRUE(ticker.tick_until({}, [&] { return ticker.usable; }));
  EXPECT_TRUE(says(ticker.device.about(ticker.device.self), "no events"));
}

TEST(Haply, DeviceThatIsNoLongerListedIsTrouble) {
  HaplyService service;
  Ticker ticker(service.uri());
  ASSERT_TRUE(ticker.tick_until({}, [&] { return ticker.usable; }));
  service.lists_ours = false;
  EXPECT_TRUE(says(ticker.trouble_under({}), "does not list it"));
}

TEST(Haply, GripThatFallsAsleepHoldsNoButton) {
  HaplyService service;
  Ticker ticker(service.uri());
  service.press(1);
  EXPECT_TRUE(ticker.tick_until({}, [&] { return ticker.sample.buttons == 1; }));
  service.grip_awake = false;
  EXPECT_TRUE(ticker.tick_until({}, [&] { return ticker.sample.buttons == 0; }));
  EXPECT_TRUE(ticker.usable || ticker.tick_until({}, [&] { return ticker.usable; }));
}

// Messages cut short, pings and pieces were among them.
TEST(Haply, GoesOnThroughBrokenMessages) {
  HaplyService service;
  Ticker ticker(service.uri());
  EXPECT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return service.messages > 200; }));
  EXPECT_TRUE(ticker.answered);
}

double of(float value) {
  return static_cast<double>(value);
}

struct Moved {
  Pose pose;
  double seconds;
};
// How a deflection moves it, from a good sample to one about 200 ms later.
Moved moved_by(const std::array<int, 6>& deflection, bool old_daemon) {
  Spacenavd daemon(old_daemon);
  Ticker ticker(daemon.uri());
  daemon.deflect(deflection);
  for (int i = 0; i < 50; ++i) ticker.tick({});
  const Sample from = ticker.sample;
  for (int i = 0; i < 200; ++i) ticker.tick({});
  const Sample to = ticker.sample;
  return {{minus(to.pose.position_m, from.pose.position_m), to.pose.rotation},
          static_cast<double>(to.t_ns - from.t_ns) * 1e-9};
}

// Of five tries one is enough: in the others this machine had something else to do.
bool moves_at(const std::array<int, 6>& deflection, bool old_daemon, Vec3 m_per_s) {
  for (int i = 0; i < 5; ++i) {
    const Moved moved = moved_by(deflection, old_daemon);
    const Vec3 p = moved.pose.position_m;
    const double off =
        std::hypot(of(p.x) / moved.seconds - of(m_per_s.x), of(p.y) / moved.seconds - of(m_per_s.y),
                   of(p.z) / moved.seconds - of(m_per_s.z));
    if (off < 0.1 * size(m_per_s) && std::fabs(moved.pose.rotation.w - 1) < 1e-6F) return true;
  }
  return false;
}

TEST(SpaceMouse, FullDeflectionIsFiftyMillimetresASecondInOurFrame) {
  for (const bool old_daemon : {false, true}) {
    EXPECT_TRUE(moves_at({350, 0, 0, 0, 0, 0}, old_daemon, {0.05F, 0, 0}));
    EXPECT_TRUE(moves_at({0, 0, 175, 0, 0, 0}, old_daemon, {0, 0, -0.025F}));
    EXPECT_TRUE(moves_at({0, 1000, 0, 0, 0, 0}, old_daemon, {0, 0.05F, 0}));
  }
}

TEST(SpaceMouse, TurnsAboutItsAxes) {
  const Moved moved = moved_by({0, 0, 0, 0, 350, 0}, false);
  EXPECT_GT(moved.pose.rotation.y, 0.1);
  EXPECT_NEAR(moved.pose.rotation.x, 0, 1e-6);
  EXPECT_LT(moved_by({0, 0, 0, 0, 0, 350}, false).pose.rotation.z, -0.1);
}

TEST(SpaceMouse, SilenceAndUnplugIsRest) {
  for (const bool unplugged : {false, true}) {
    Spacenavd daemon;
    Ticker ticker(daemon.uri());
    daemon.deflect({350, 0, 0, 0, 0, 0});
    ASSERT_TRUE(ticker.tick_until({}, [&] { return ticker.sample.pose.position_m.x > 0.002F; }));
    daemon.deflect({});
    if (unplugged) daemon.unplug();
    for (int i = 0; i < (unplugged ? 30 : 100); ++i) ticker.tick({});
    const float at = ticker.sample.pose.position_m.x;
    for (int i = 0; i < 50; ++i) ticker.tick({});
    EXPECT_EQ(ticker.sample.pose.position_m.x, at);
    EXPECT_TRUE(ticker.tick_until({}, [&] { return ticker.usable; }));
  }
}

TEST(SpaceMouse, DaemonThatEndsIsTroubleWithARemedy) {
  Spacenavd daemon;
  Ticker ticker(daemon.uri());
  ASSERT_TRUE(ticker.tick_until({}, [&] { return ticker.usable; }));
  daemon.trouble(test::Trouble::kNoAnswer);
  EXPECT_TRUE(says(ticker.trouble_under({}), "restart spacenavd"));
}

TEST(SpaceMouse, NoDaemonIsNamedWithItsSocketAndARemedy) {
  setenv("SPNAV_SOCKET", "/nowhere/spnav.sock", 1);
  EXPECT_TRUE(says(refusal("spacemouse:"), "/nowhere/spnav.sock: No such file"));
  EXPECT_TRUE(says(refusal("spacemouse:0"), "expected nothing after the colon"));
}

}  // namespace
}  // namespace stylet::hal
