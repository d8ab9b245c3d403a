// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/haply.h"

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "device_thread.h"
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
constexpr std::uint32_t kNoAnswer = 1, kDeviceGone = 2;
constexpr const char* kGrips[] = {"wireless_verse_grip", "verse_grip", "custom_verse_grip"};
constexpr const char* kButtons[][2] = {
    {"a", "button_0"}, {"b", "button_1"}, {"c", "button_2"}, {"home", "button_3"}};

struct Haply {
  Relay relay;
  DeviceThread thread;
  boost::asio::io_context io;
  websocket::stream<tcp::socket> socket{io};
  boost::beast::flat_buffer buffer;
  std::string wanted_id, id;
  bool calibrated = false;
  Pose pose = {{}, {1, 0, 0, 0}};
  std::uint32_t buttons = 0;
};

// ==== Messages: whatever is missing or of another type is left as it was

const json* entry(const json& message, const char* list, const std::string& id) {
  const auto found = message.find(list);
  if (found == message.end() || !found->is_array()) return nullptr;
  for (const json& each : *found) {
    if (each.is_object() && (id.empty() || each.value("device_id", "") == id)) return &each;
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

void take_grip(const json& message, Haply& haply) {
  for (const char* kind : kGrips) {
    const json* state = part(entry(message, kind, ""), "state");
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

// True if it holds a place of our device.
bool take(const json& message, Haply& haply) {
  const json* device = entry(message, "inverse3", haply.wanted_id);
  if (device == nullptr) return false;
  haply.id = device->value("device_id", haply.id);
  if (part(part(device, "status"), "calibrated") != nullptr) {
    haply.calibrated = truth(part(device, "status"), "calibrated");
  }
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

// ==== The connection

// Runs what was started; false: not done in time, or broken.
bool finish(Haply& haply, const bool& done, Milliseconds longest) {
  haply.io.restart();
  haply.io.run_for(longest);
  return done;
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

bool send(Haply& haply, const std::string& text) {
  bool done = false;
  haply.socket.async_write(boost::asio::buffer(text),
                           [&](boost::beast::error_code error, std::size_t) { done = !error; });
  return finish(haply, done, kAnswerTime);
}

// A closed connection is all that can be done about a force the service may still hold. Whatever
// had been started ends here, while what it points to is still there.
void hang_up(Haply& haply) {
  boost::beast::error_code ignored;
  haply.socket.next_layer().close(ignored);
  haply.io.restart();
  haply.io.run();
}

void exchange(Haply& haply) {
  if (haply.relay.failed()) return;
  json message;
  const Vec3 force_n = haply.relay.order(monotonic_now_ns()).force_n;
  if (!send(haply, command(haply, force_n)) || !receive(haply, message)) {
    haply.relay.fail(kNoAnswer);
    return hang_up(haply);
  }
  if (message.is_discarded()) return;  // not a message: the next one may be
  if (take(message, haply)) {
    haply.relay.publish(haply.pose, haply.buttons, monotonic_now_ns());
  } else if (message.contains("inverse3")) {
    haply.relay.fail(kDeviceGone);
    hang_up(haply);
  }
}

void close(void* self) {
  const std::unique_ptr<Haply> haply(static_cast<Haply*>(self));
  haply->thread.stop();
  if (haply->relay.failed()) return;
  json last;
  if (send(*haply, command(*haply, {}))) (void)receive(*haply, last);
  hang_up(*haply);
}
std::string trouble(void* self) {
  const Relay& relay = static_cast<Haply*>(self)->relay;
  if (!relay.failed()) return "";
  return relay.why() == kDeviceGone ? "the service does not list it any more: check its cable"
                                    : "the service does not answer: systemctl restart "
                                      "haply-inverse-service";
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
  if (error || port == 0) {
    throw DeviceError(fmt::format("haply:{}: expected nothing, ID, or ID@ADDRESS:PORT", rest));
  }
  return {address, port};
}

void connect(Haply& haply, const tcp::endpoint& endpoint, const std::string& rest) {
  boost::beast::error_code error;
  haply.socket.next_layer().connect(endpoint, error);
  if (!error) {
    haply.socket.next_layer().set_option(tcp::no_delay(true));
    error = boost::asio::error::timed_out;
    bool done = false;
    haply.socket.async_handshake("localhost", "/", [&](boost::beast::error_code result) {
      error = result;
      done = true;
    });
    if (!finish(haply, done, kOpeningTime)) hang_up(haply);
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
    if (found && haply.calibrated) return;
    if (!answered || std::chrono::steady_clock::now() > end) {
      hang_up(haply);
      throw DeviceError(fmt::format(
          "haply:{}: {}", rest,
          !answered ? "the service does not answer: systemctl restart haply-inverse-service"
          : !found  ? "the service lists no such Inverse3: check its cable and power"
                   : "not calibrated: put the handle into the holder, as the vendor's guide says"));
    }
    (void)send(haply, haply.id.empty() ? "{}" : command(haply, {}));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace

Device open_haply(const std::string& rest, double patience_s) {
  auto haply = std::make_unique<Haply>();
  const tcp::endpoint endpoint = endpoint_of(rest, haply->wanted_id);
  connect(*haply, endpoint, rest);
  wait_until_ready(*haply, rest, patience_s);
  haply->thread.start(kExchangeNs, [at = haply.get()] { exchange(*at); });
  // Limits from the vendor's pages, kept low: the service does not tell.
  const DeviceInfo info = {.name = "Haply Inverse3",
                           .max_force_n = 5,
                           .max_slew_n_per_s = 1000,
                           .max_stiffness_n_per_m = 2000};
  return relayed(haply.release(), info, close, trouble);
}

}  // namespace stylet::hal
