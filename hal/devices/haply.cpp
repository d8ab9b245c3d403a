// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/haply.h"

#include <fmt/format.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "device_thread.h"
#include "haply_events.h"
#include "stylet/hal/devices.h"
#include "stylet/hal/relay.h"
#include "vendor_pose.h"

namespace stylet::hal {
namespace {

using boost::asio::ip::tcp;
using nlohmann::json;
namespace websocket = boost::beast::websocket;

constexpr std::int64_t kExchangeNs = 500'000;
using Milliseconds = std::chrono::milliseconds;
constexpr Milliseconds kAnswerTime(20), kOpeningTime(2000);
constexpr std::uint32_t kNoAnswer = 1, kDeviceGone = 2, kBrake = 3;
constexpr const char* kExpected =
    "expected nothing, ID, or ID@ADDRESS:PORT, and then ,gate=0.3 ,damping=0 or ,events=10020";
constexpr const char* kGrips[] = {"wireless_verse_grip", "verse_grip", "custom_verse_grip"};
constexpr const char* kButtons[][2] = {
    {"a", "button_0"}, {"b", "button_1"}, {"c", "button_2"}, {"home", "button_3"}};

// After the commas of a URI. What the service makes of a force: the gate takes some of it where it
// sees oscillation, damping resists motion. Damping is the kernel's business, so it is none unless
// asked for; the gate is a net of the service's own and stays as it is.
struct Wishes {
  double gate = -1;  // below zero: as the service has it
  double damping = 0;
  unsigned short events = 10020;
};

struct Haply {
  Relay relay;
  DeviceThread thread;
  boost::asio::io_context io;
  websocket::stream<tcp::socket> socket{io};
  boost::beast::flat_buffer buffer;
  std::string wanted_id, id;
  Wishes wishes;
  // What the service tells of itself: filters at the start, the force it renders, the newest event.
  double gate = -1, damping = -1;
  std::atomic<float> asked_n{0}, rendered_n{0};
  std::mutex mutex;
  std::string warning;
  std::unique_ptr<HaplyEvents> events;
  bool calibrated = false;
  Pose pose = {{}, {1, 0, 0, 0}};
  std::uint32_t buttons = 0;
};

// ==== Messages: whatever is missing or of another type is left as it was

std::string word(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

const json* entry(const json& message, const char* list, const std::string& id) {
  const auto found = message.find(list);
  if (found == message.end() || !found->is_array()) return nullptr;
  for (const json& each : *found) {
    if (each.is_object() && (id.empty() || word(each, "device_id") == id)) return &each;
  }
  return nullptr;
}

const json* part(const json* object, const char* key) {
  if (object == nullptr || !object->is_object()) return nullptr;
  const auto found = object->find(key);
  return found == object->end() ? nullptr : &*found;
}

bool number(const json* object, const char* key, double& out) {
  const json* found = part(object, key);
  if (found == nullptr || !found->is_number()) return false;
  out = found->get<double>();
  return true;
}

bool truth(const json* object, const char* key) {
  const json* found = part(object, key);
  if (found == nullptr) return false;
  return found->is_boolean() ? found->get<bool>() : found->is_number() && *found != 0;
}

// One that sleeps or has gone holds no button: a dead man's must not stay pressed.
void take_grip(const json& message, Haply& haply) {
  haply.buttons = 0;
  for (const char* kind : kGrips) {
    const json* grip = entry(message, kind, "");
    const json* status = part(grip, "status");
    if (part(status, "awake") != nullptr && !truth(status, "awake")) continue;
    const json* state = part(grip, "state");
    const json* q = part(state, "orientation");
    double w = 0, x = 0, y = 0, z = 0;
    if (!number(q, "w", w) || !number(q, "x", x) || !number(q, "y", y) || !number(q, "z", z)) {
      continue;
    }
    haply.pose.rotation = from_user_first(Quat{static_cast<float>(w), static_cast<float>(x),
                                               static_cast<float>(y), static_cast<float>(z)});
    const json* buttons = part(state, "buttons");
    haply.buttons = truth(state, "button") ? 1U : 0U;
    for (std::uint32_t i = 0; i < std::size(kButtons); ++i) {
      for (const char* name : kButtons[i]) {
        if (truth(buttons, name) || truth(state, name)) haply.buttons |= 1U << i;
      }
    }
    return;
  }
}

// The inventory, which comes first, tells it.
void take_filters(const json& message, Haply& haply) {
  const json* filters =
      part(part(entry(message, "inverse3", haply.wanted_id), "config"), "filters");
  (void)number(part(filters, "force_gate"), "gain", haply.gate);
  (void)number(part(filters, "damping"), "scalar", haply.damping);
}

double length(const UserFirst& v) {
  return std::hypot(v.x, v.y, v.z);
}

// What comes out of the service's filters.
void take_rendered(const json* state, Haply& haply) {
  const json* force = part(state, "current_cursor_force");
  UserFirst f = {};
  if (!number(force, "x", f.x) || !number(force, "y", f.y) || !number(force, "z", f.z)) return;
  haply.rendered_n = static_cast<float>(length(f));
}

// True if it holds a place of our device.
bool take(const json& message, Haply& haply) {
  const json* device = entry(message, "inverse3", haply.wanted_id);
  if (device == nullptr) return false;
  if (haply.id.empty()) haply.id = word(*device, "device_id");
  if (part(part(device, "status"), "calibrated") != nullptr) {
    haply.calibrated = truth(part(device, "status"), "calibrated");
  }
  take_rendered(part(device, "state"), haply);
  const json* place = part(part(device, "state"), "cursor_position");
  double x = 0, y = 0, z = 0;
  if (!number(place, "x", x) || !number(place, "y", y) || !number(place, "z", z)) return false;
  haply.pose.position_m = from_user_first(x, y, z);
  take_grip(message, haply);
  return true;
}

std::string command(const Haply& haply, Vec3 force_n) {
  const UserFirst f = to_user_first(force_n);
  const auto values = fmt::format(R"({{"x":{:.6g},"y":{:.6g},"z":{:.6g}}})", f.x, f.y, f.z);
  return fmt::format(
      R"({{"inverse3":[{{"device_id":"{}","commands":{{"set_cursor_force":{{"values":{}}}}}}}]}})",
      haply.id, values);
}

// Lasts as long as the connection.
std::string configuration(const Haply& haply) {
  std::string gate;
  if (haply.wishes.gate >= 0) {
    gate = fmt::format(R"(,"force_gate":{{"gain":{:g}}})", haply.wishes.gate);
  }
  return fmt::format(
      R"({{"inverse3":[{{"device_id":"{}","configure":{{"damping":{{"scalar":{:g}}}{}}}}}]}})",
      haply.id, haply.wishes.damping, gate);
}

// ==== The connection

// A closed connection is all that can be done about a force the service may still hold.
void hang_up(Haply& haply) {
  boost::beast::error_code ignored;
  haply.socket.next_layer().close(ignored);
  haply.io.restart();
  haply.io.run();
}

// Runs what was started; false: not done in time, or broken. Then the connection is closed, so that
// what was started ends here, while what it writes to is still there.
bool finish(Haply& haply, const bool& done, Milliseconds longest) {
  haply.io.restart();
  haply.io.run_for(longest);
  const bool in_time = done;
  if (!in_time) hang_up(haply);
  return in_time;
}

bool receive(Haply& haply, json& message, Milliseconds longest = kAnswerTime) {
  bool done = false;
  haply.buffer.clear();
  haply.socket.async_read(haply.buffer,
                          [&](boost::beast::error_code error, std::size_t) { done = !error; });
  if (!finish(haply, done, longest)) return false;
  const auto* text = static_cast<const char*>(haply.buffer.data().data());
  message = json::parse(text, text + haply.buffer.size(), nullptr, false);
  return true;
}

bool send(Haply& haply, const std::string& text, Milliseconds longest = kAnswerTime) {
  bool done = false;
  haply.socket.async_write(boost::asio::buffer(text),
                           [&](boost::beast::error_code error, std::size_t) { done = !error; });
  return finish(haply, done, longest);
}

void exchange_once(Haply& haply) {
  if (!haply.socket.next_layer().is_open()) return;
  json message;
  const Vec3 force_n = haply.relay.order(monotonic_now_ns()).force_n;
  haply.asked_n = static_cast<float>(length(to_user_first(force_n)));
  const bool answered = send(haply, command(haply, force_n)) && receive(haply, message);
  if (!answered) haply.relay.fail(kNoAnswer);
  if (haply.relay.failed()) return hang_up(haply);  // an event may have said so, too
  if (message.is_discarded()) return;               // not a message: the next one may be
  if (take(message, haply)) {
    haply.relay.publish(haply.pose, haply.buttons, monotonic_now_ns());
  } else if (message.contains("inverse3")) {
    haply.relay.fail(kDeviceGone);
    hang_up(haply);
  }
}

// Nothing leaves the thread: what cannot be handled is a device that does not answer.
void exchange(Haply& haply) try { exchange_once(haply); } catch (const std::exception&) {
  haply.relay.fail(kNoAnswer);
}

// In the thread of the events. What ends the device for the hand ends it for us, at once and by its
// name; the rest is told when somebody asks.
void hear(Haply& haply, const HaplyEvent& event) {
  if (!event.device_id.empty() && event.device_id != haply.id) return;
  if (event.warns) {  // first: who learns that it has failed asks why
    const std::lock_guard lock(haply.mutex);
    haply.warning = event.name + (event.message.empty() ? "" : ": " + event.message);
  }
  if (event.name == "device-disconnected") haply.relay.fail(kDeviceGone);
  if (event.safety == "ebrake_triggered") haply.relay.fail(kBrake);
}

void close(void* self) {
  const std::unique_ptr<Haply> haply(static_cast<Haply*>(self));
  haply->events.reset();
  haply->relay.end();
  std::this_thread::sleep_for(kFadeTime);
  haply->thread.stop();
  if (!haply->socket.next_layer().is_open()) return;
  json last;
  if (send(*haply, command(*haply, {}))) (void)receive(*haply, last);
  hang_up(*haply);
}
std::string trouble(void* self) {
  Haply& haply = *static_cast<Haply*>(self);
  if (!haply.relay.failed()) return "";
  const std::lock_guard lock(haply.mutex);
  const std::string told = haply.warning.empty() ? "" : " (" + haply.warning + ")";
  switch (haply.relay.why()) {
    case kDeviceGone:
      return "the service does not list it any more: check its cable" + told;
    case kBrake:
      return "its emergency brake has locked it" + told;
    default:
      return "the service does not answer: systemctl restart haply-inverse-service" + told;
  }
}

std::string about(void* self) {
  Haply& haply = *static_cast<Haply*>(self);
  const auto said = [](double value) {
    return value < 0 ? "not told" : fmt::format("{:g}", value);
  };
  const float asked = haply.asked_n, rendered = haply.rendered_n;
  const std::lock_guard lock(haply.mutex);
  return fmt::format(
      "its service came with force gate {} and damping {}, now {} and {:g}; {:.2f} N asked, "
      "{:.2f} N rendered; {}{}",
      said(haply.gate), said(haply.damping),
      said(haply.wishes.gate >= 0 ? haply.wishes.gate : haply.gate), haply.wishes.damping, asked,
      rendered, haply.events->connected() ? "events are heard" : "no events",
      haply.warning.empty() ? "" : ": " + haply.warning);
}

// Takes what is behind the commas off the URI's end.
Wishes wishes_of(std::string& rest) {
  Wishes wishes;
  const std::string whole = rest;
  for (std::size_t comma = rest.rfind(','); comma != std::string::npos; comma = rest.rfind(',')) {
    const std::string wish = rest.substr(comma + 1);
    const std::size_t equals = wish.find('=');
    const std::string key = wish.substr(0, equals);
    double value = -1;
    if (equals != std::string::npos) {
      std::from_chars(wish.data() + equals + 1, wish.data() + wish.size(), value);
    }
    const bool share = (key == "gate" || key == "damping") && value >= 0 && value <= 1;
    const bool port = key == "events" && value >= 1 && value <= 65535;
    if (!share && !port) throw DeviceError(fmt::format("haply:{}: {}: {}", whole, wish, kExpected));
    if (key == "gate") wishes.gate = value;
    if (key == "damping") wishes.damping = value;
    if (port) wishes.events = static_cast<unsigned short>(value);
    rest.resize(comma);
  }
  return wishes;
}

tcp::endpoint endpoint_of(const std::string& rest, std::string& id) {
  const std::size_t at = rest.find('@');
  id = rest.substr(0, at);
  const std::string where = at == std::string::npos ? "127.0.0.1:10001" : rest.substr(at + 1);
  const std::size_t colon = where.rfind(':');
  boost::beast::error_code error;
  unsigned short port = 0;
  if (colon != std::string::npos) {
    std::from_chars(where.data() + colon + 1, where.data() + where.size(), port);
  }
  const auto address = boost::asio::ip::make_address(where.substr(0, colon), error);
  if (error || port == 0) throw DeviceError(fmt::format("haply:{}: {}", rest, kExpected));
  return {address, port};
}

void connect(Haply& haply, const tcp::endpoint& endpoint, const std::string& rest) {
  boost::beast::error_code error;
  haply.socket.next_layer().connect(endpoint, error);
  if (!error) {
    haply.socket.next_layer().set_option(tcp::no_delay(true));
    bool done = false;
    haply.socket.async_handshake("localhost", "/", [&](boost::beast::error_code result) {
      error = result;
      done = true;
    });
    if (!finish(haply, done, kOpeningTime)) error = boost::asio::error::timed_out;
  }
  if (!error) return;
  throw DeviceError(
      fmt::format("haply:{}: {}:{}: {}: install haply-inverse-service and start it "
                  "(systemctl start haply-inverse-service)",
                  rest, endpoint.address().to_string(), endpoint.port(), error.message()));
}

// The first message is the inventory; then one for each of ours, all with no force.
void wait_until_ready(Haply& haply, const std::string& rest, double patience_s) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (true) {
    json message;
    const bool answered = receive(haply, message, kOpeningTime);
    const bool found = answered && !message.is_discarded() && take(message, haply);
    if (found) take_filters(message, haply);
    if (found && haply.calibrated) return;
    if (!answered || std::chrono::steady_clock::now() > end) {
      hang_up(haply);
      throw DeviceError(fmt::format(
          "haply:{}: {}", rest,
          !answered ? "the service does not answer: systemctl restart haply-inverse-service"
          : !found  ? "the service lists no such Inverse3: check its cable and power"
                   : "not calibrated: put the handle into the holder, as the vendor's guide says"));
    }
    (void)send(haply, haply.id.empty() ? "{}" : command(haply, {}), kOpeningTime);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace

Device open_haply(const std::string& rest, double patience_s) {
  auto haply = std::make_unique<Haply>();
  std::string where = rest;
  haply->wishes = wishes_of(where);
  const tcp::endpoint endpoint = endpoint_of(where, haply->wanted_id);
  connect(*haply, endpoint, rest);
  wait_until_ready(*haply, rest, patience_s);
  json answer;
  if (!send(*haply, configuration(*haply), kOpeningTime) ||
      !receive(*haply, answer, kOpeningTime)) {
    hang_up(*haply);
    throw DeviceError(
        fmt::format("haply:{}: the service takes no configuration: expected version "
                    "3.1 or newer",
                    rest));
  }
  haply->events = std::make_unique<HaplyEvents>(
      tcp::endpoint(endpoint.address(), haply->wishes.events),
      [at = haply.get()](const HaplyEvent& event) { hear(*at, event); });
  // Limits from the vendor's pages, kept low: the service does not tell.
  const DeviceInfo info = {.name = "Haply Inverse3",
                           .max_force_n = 5,
                           .max_slew_n_per_s = 1000,
                           .max_stiffness_n_per_m = 2000};
  haply->relay.limits = motor_limits(info);
  haply->thread.start(kExchangeNs, [at = haply.get()] { exchange(*at); });
  Device device = relayed(haply.release(), info, close, trouble);
  device.about = about;
  return device;
}

}  // namespace stylet::hal
