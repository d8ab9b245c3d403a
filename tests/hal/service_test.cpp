// SPDX-License-Identifier: Apache-2.0
// What is special about services: Haply's and spacenavd.
#include <random>

#include "hal/device/drivers/haply.h"
#include "hal/device/drivers/haply_state.h"
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
  EXPECT_TRUE(says(refusal("haply:,gate=0.3x"), "gate=0.3x: expected"));
  EXPECT_TRUE(says(refusal("haply:,events=10020.7"), "events=10020.7: expected"));
  HaplyService service;
  service.trouble(test::Trouble::kUncalibrated);
  EXPECT_TRUE(says(refusal(service.uri()), "not calibrated"));
  service.trouble(test::Trouble::kNone);
  EXPECT_TRUE(says(refusal(service.address("0000")), "lists no such Inverse3"));
  EXPECT_EQ(refusal(service.uri()), "opened");
}

TEST(Haply, DampingIsLeftToTheKernelAndTheGateToTheService) {
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

TEST(Haply, EventsEndTheDeviceAndAreNamed) {
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

// An older service has no channel of events.
TEST(Haply, AServiceWithoutEventsIsNoTrouble) {
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

// ---- devices and grips are known by their ids, whatever the list and its order

std::string plain(const HaplyService& service) {
  return service.address("");
}

TEST(Haply, StaysWithTheDeviceThatWasOpenedWhateverTheOrderOfTheList) {
  HaplyService service;
  service.ours_first = true;
  Ticker ticker(plain(service));
  EXPECT_STREQ(ticker.device.info.identity, "049D,grip=1");
  service.move({{0.01F, 0.02F, 0.03F}, {1, 0, 0, 0}});
  const auto ours = [&] {
    return ticker.usable && ticker.sample.pose.position_m.x == 0.01F && service.felt().z > 0.9F;
  };
  ASSERT_TRUE(ticker.tick_until({0, 0, 1}, ours));
  for (const bool first : {false, true, false}) {
    service.ours_first = first;
    const int before = service.messages;
    EXPECT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return service.messages > before + 20; }));
    EXPECT_TRUE(ticker.tick_until({0, 0, 1}, ours));
  }
  service.lists_ours = false;
  EXPECT_TRUE(says(ticker.trouble_under({0, 0, 1}), "does not list it"));
  EXPECT_EQ(service.told_others, 0);
}

TEST(Haply, ComesBackAsTheSameDeviceOrNotAtAll) {
  HaplyService service;
  service.ours_first = true;
  Ticker ticker(open_lasting_device(plain(service)), 15e-3F);
  ASSERT_TRUE(ticker.tick_until({}, [&] { return ticker.usable; }));
  service.lists_ours = false;
  const auto missing = [&] { return says(trouble_of(ticker.device), "it lists AAAA"); };
  for (int i = 0; i < 5 && !missing(); ++i) (void)ticker.tick_until({}, missing);
  EXPECT_TRUE(missing());
  service.ours_first = false;  // now the other device is first
  service.lists_ours = true;
  service.move({{0.01F, 0, 0}, {1, 0, 0, 0}});
  const auto back = [&] { return ticker.usable && ticker.sample.pose.position_m.x == 0.01F; };
  bool seen = false;
  for (int i = 0; i < 10 && !seen; ++i) seen = ticker.tick_until({}, back);
  EXPECT_TRUE(seen);
  EXPECT_EQ(service.told_others, 0);
}

TEST(Haply, ReopensWithTheIdsThatWereOpened) {
  const std::string bound = "049D,grip=7";
  EXPECT_EQ(same_haply("", bound), "049D,grip=7");
  EXPECT_EQ(same_haply("@127.0.0.1:1,gate=1", bound), "049D@127.0.0.1:1,grip=7,gate=1");
  EXPECT_EQ(same_haply("049D@127.0.0.1:1,grip=7,events=9", bound),
            "049D@127.0.0.1:1,grip=7,events=9");
  EXPECT_EQ(same_haply(",gate=1,grip=7", "049D,grip=none"), "049D,grip=none,gate=1");
}

// Stylet cannot know which grip belongs to which device. So the user is asked, and the other grip's
// buttons arm nothing.
TEST(Haply, OfSeveralGripsOneMustBeNamed) {
  HaplyService service;
  service.other_grip = true;
  const std::string several = refusal(service.uri());
  EXPECT_TRUE(says(several, "grip: several: expected ,grip=ID")) << several;
  EXPECT_TRUE(says(several, "the service lists 2, 1")) << several;
  EXPECT_TRUE(says(refusal(service.uri_with(",grip=3")), "grip: 3: expected"));
  {
    Ticker ticker(service.uri_with(",grip=1"));
    for (const std::uint32_t mask : {0U, 1U, 0U}) {
      service.press(mask);
      EXPECT_TRUE(ticker.tick_until({}, [&] { return ticker.sample.buttons == mask; }));
      for (int i = 0; i < 20; ++i) {
        ticker.tick({});
        EXPECT_EQ(ticker.sample.buttons, mask);
      }
    }
  }
  {
    Ticker ticker(service.uri_with(",grip=2"));
    EXPECT_TRUE(ticker.tick_until({}, [&] { return ticker.sample.buttons == 7; }));
    // The grip disappears: no button counts as held any more, and those of the other grip do not
    // count either.
    service.press(3);
    service.other_grip = false;
    EXPECT_TRUE(ticker.tick_until({}, [&] { return ticker.sample.buttons == 0; }));
    for (int i = 0; i < 20; ++i) {
      ticker.tick({});
      EXPECT_EQ(ticker.sample.buttons, 0U);
    }
  }
  service.press(1);
  Ticker ticker(service.uri_with(",grip=none"));
  for (int i = 0; i < 20; ++i) {
    ticker.tick({});
    EXPECT_EQ(ticker.sample.buttons, 0U);
  }
}

// Both needles are in this program: a device that holds one needle is not given to another.
TEST(Haply, TwoNeedlesShareNeitherDeviceNorGrip) {
  HaplyService service(2);
  service.press(1);
  Ticker first(service.uri());
  EXPECT_STREQ(first.device.info.identity, "049D,grip=1");
  const std::string held = refusal(service.uri());
  EXPECT_TRUE(says(held, "another needle holds it")) << held;
  EXPECT_TRUE(says(refusal(service.address("AAAA") + ",grip=1"), "grip: 1: expected"));
  Ticker second(plain(service));
  EXPECT_STREQ(second.device.info.identity, "AAAA,grip=none");
  EXPECT_TRUE(first.tick_until({}, [&] { return first.sample.buttons == 1; }));
  for (int i = 0; i < 20; ++i) second.tick({});
  EXPECT_EQ(second.sample.buttons, 0U);
}

// ---- whatever the service sends

using Json = nlohmann::json;

Json random_value(std::mt19937& random, int depth) {
  const auto number = [&random] { return static_cast<int>(random() % 2001) - 1000; };
  switch (random() % (depth > 0 ? 9 : 7)) {
    case 0:
      return nullptr;
    case 1:
      return random() % 2 == 0;
    case 2:
      return number();
    case 3:
      return 1e-3 * number();
    case 4:
      return std::string(random() % 4, static_cast<char>('0' + random() % 10));
    case 5:
      return 1e300 * number();
    case 6:
      return "\"}{\u0001\n049D";
    case 7: {
      Json list = Json::array();
      for (auto n = random() % 4; n > 0; --n) list.push_back(random_value(random, depth - 1));
      return list;
    }
    default:
      return {{"device_id", random_value(random, depth - 1)},
              {"state", random_value(random, depth - 1)}};
  }
}

// Replaces a part of the message, at any depth.
void change_a_part(std::mt19937& random, Json& json) {
  Json* at = &json;
  while (at->is_structured() && !at->empty() && random() % 5 != 0) {
    at = &*std::next(at->begin(), static_cast<std::ptrdiff_t>(random() % at->size()));
  }
  *at = random_value(random, 3);
}

TEST(Haply, AnyMessageIsAcceptedAndNoneOfAnotherDevice) {
  const HaplyIds ids = {"049D", "1"};
  const Json grip = {{"device_id", "1"},
                     {"status", {{"awake", true}}},
                     {"state",
                      {{"orientation", {{"w", 1}, {"x", 0}, {"y", 0}, {"z", 0}}},
                       {"buttons", {{"a", true}, {"b", 0}, {"home", 1}}}}}};
  const Json device = {
      {"device_id", "049D"},
      {"status", {{"calibrated", true}}},
      {"config", {{"filters", {{"force_gate", {{"gain", 0.3}}}, {"damping", {{"scalar", 0.5}}}}}}},
      {"state",
       {{"cursor_position", {{"x", 1}, {"y", 2}, {"z", 3}}},
        {"current_cursor_force", {{"x", 1}, {"y", 0}, {"z", 0}}}}}};
  Json other = device, other_grip = grip;
  other["device_id"] = "AAAA";
  other["state"]["cursor_position"] = {{"x", 77}, {"y", 77}, {"z", 77}};
  other_grip["device_id"] = "2";
  other_grip["state"]["buttons"] = {{"c", true}};
  const Json whole = {{"inverse3", {other, device}},
                      {"wireless_verse_grip", {other_grip, grip}},
                      {"verse_grip", Json::array()}};
  std::mt19937 random(20);
  int taken = 0;
  for (int i = 0; i < 20'000; ++i) {
    Json message = whole;
    for (auto n = random() % 4; n > 0; --n) change_a_part(random, message);
    message = Json::parse(message.dump());
    HaplyState state;
    take_filters(message, ids, state);
    taken += take_state(message, ids, state) ? 1 : 0;
    // Nothing is taken from the other device, unless it now has our id.
    const bool still_there = message.dump().find("AAAA") != std::string::npos;
    EXPECT_FALSE(still_there && state.pose.position_m.x == 77);
    for (const std::string& id : listed_devices(message)) {
      const Json sent = Json::parse(force_message({id, ""}, {1, 2, 3}));
      EXPECT_EQ(sent["inverse3"][0]["device_id"], id);
      EXPECT_EQ(sent["inverse3"][0]["commands"]["set_cursor_force"]["values"]["x"], 3);
    }
  }
  EXPECT_GT(taken, 2'000);
  EXPECT_LT(taken, 19'000);
}

// The same through the service: nothing ends the program, and no other device is given a force.
TEST(Haply, AServiceThatSendsAnythingIsRefusedOrFailsWithoutEndingTheProgram) {
  HaplyService service;
  std::mt19937 random(21);
  const std::string open_uri = service.uri();
  int opened = 0, refused = 0;
  service.change = [&random](Json& all) {
    if (random() % 8 == 0) change_a_part(random, all);
  };
  for (int i = 0; i < 30; ++i) {
    try {
      Ticker ticker(open_device(open_uri, 0.1), 15e-3F);
      ++opened;
      for (int k = 0; k < 40; ++k) ticker.tick({0, 0, 1});
    } catch (const DeviceError&) {
      ++refused;
    }
  }
  EXPECT_GT(opened, 0);
  EXPECT_EQ(service.told_others, 0);
}

TEST(Haply, TheListIsThatOfTheLastWholeMessage) {
  HaplyService service;
  service.cut = 1;
  const std::string refused = refusal(service.address("0000"));
  EXPECT_TRUE(says(refused, "it lists AAAA, 049D")) << refused;
}

// Among the messages were some cut short, pings and pieces.
TEST(Haply, GoesOnThroughBrokenMessages) {
  HaplyService service;
  Ticker ticker(service.uri());
  EXPECT_TRUE(ticker.tick_until({0, 0, 1}, [&] { return service.messages > 200; }));
  EXPECT_TRUE(ticker.answered);
}

// If a service sends more than it is asked for, samples do not become older.
TEST(Haply, MoreAnswersThanMessagesMakeNoSampleOld) {
  HaplyService service;
  service.unasked = 3;
  Ticker ticker(service.uri());
  const auto enough = [&service] { return service.messages > 600; };
  for (int i = 0; i < 5 && !enough(); ++i) (void)ticker.tick_until({0, 0, 1}, enough);
  ASSERT_TRUE(enough()) << trouble_of(ticker.device);
  const Vec3 place = {0.01F, 0.02F, -0.03F};
  service.move({place, {1, 0, 0, 0}});
  const int since = service.messages;
  EXPECT_TRUE(ticker.tick_until({0, 0, 1}, [&] {
    const Vec3 way = minus(ticker.sample.pose.position_m, place);
    return way.x * way.x + way.y * way.y + way.z * way.z < 1e-8F;
  }));
  EXPECT_LT(service.messages - since, 30);
}

// This is the worst case for a client that takes any message for its answer: a service that is
// slower than the exchange (0.5 ms) and sends unasked leaves no pause in which the client could
// notice how far ahead it is. The test counts messages, which do not become more on a busy machine.
// A device that is given up (20 ms without an answer) is opened again.
TEST(Haply, SlowServiceThatSendsUnaskedGetsOneForceAtATime) {
  constexpr double kStepM = 1e-6;
  HaplyService service;
  service.answer_time_us = 700;
  service.unasked = 10;
  service.change = [&service](Json& all) {  // our x is the vendor's y
    all["inverse3"][1]["state"]["cursor_position"]["y"] = kStepM * service.messages;
  };
  Ticker ticker(open_lasting_device(service.uri()), 15e-3F);
  double oldest = 0;
  for (int i = 0; i < 2000; ++i) {
    ticker.tick({0, 0, 1});
    const int now = service.messages;
    Sample sample = {};
    if (!ticker.device.read(ticker.device.self, monotonic_now_ns(), sample)) continue;
    const double then = static_cast<double>(sample.pose.position_m.x) / kStepM;
    oldest = std::max(oldest, now - then);
  }
  EXPECT_GT(service.messages, 500);
  // When a message comes, the one before has been answered; but every fiftieth answer is cut short.
  EXPECT_LT(oldest, 2.5);
  // At most a ping is waiting, which the service reads later; a force has more than a hundred
  // bytes.
  EXPECT_LT(service.most_waiting_bytes, 100U);
}

// The service answers one message, and then reads nothing any more.
TEST(Haply, ServiceThatAnswersNoPingIsRefused) {
  HaplyService service;
  int said = 0;
  service.change = [&](Json&) {
    if (++said == 2) service.trouble(test::Trouble::kSilent);
  };
  const std::string refused = refusal(service.uri());
  EXPECT_TRUE(says(refused, "does not answer pings: expected a pong")) << refused;
}

double of(float value) {
  return static_cast<double>(value);
}

struct Moved {
  Pose pose;
  double seconds;
};
// How far a deflection moves it, from a good sample to one about 200 ms later.
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

// One of five tries is enough: in the others this machine may have been busy.
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
