// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/haply_connection.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "hal/device/devices.h"

namespace stylet::hal::haply {

using boost::asio::ip::tcp;
using boost::beast::string_view;
using nlohmann::json;
namespace websocket = boost::beast::websocket;

void hang_up(HaplyConnection& at) {
  boost::beast::error_code ignored;
  at.socket.next_layer().close(ignored);
  at.io.restart();
  at.io.run();
}

TimePoint within(Milliseconds longest) {
  return std::chrono::steady_clock::now() + longest;
}

namespace {

constexpr int kMostUnasked = 16;  // messages besides the answer; more count as a flood

// Runs what was started. False: not done in time, or broken. Then the connection is closed, so that
// what was started ends here, while the variables it writes to still exist.
template <typename Done>
bool finish(HaplyConnection& at, TimePoint end, Done done) {
  at.io.restart();
  while (!done() && at.io.run_one_until(end) > 0) {
  }
  const bool in_time = done();
  if (!in_time) hang_up(at);
  return in_time;
}

// Starts to read the next message into the buffer, whenever it comes.
void listen(HaplyConnection& at) {
  if (at.reading || at.heard) return;
  at.reading = true;
  at.buffer.clear();
  at.socket.async_read(at.buffer, [&at](boost::beast::error_code error, std::size_t) {
    at.reading = false;
    at.heard = !error;
  });
}

void take(HaplyConnection& at, json& message) {
  const auto* text = static_cast<const char*>(at.buffer.data().data());
  message = json::parse(text, text + at.buffer.size(), nullptr, false);
  at.heard = false;
}

bool send(HaplyConnection& at, const std::string& text, TimePoint end) {
  bool done = false;
  at.socket.async_write(boost::asio::buffer(text),
                        [&](boost::beast::error_code error, std::size_t) { done = !error; });
  return finish(at, end, [&] { return done; });
}

// Each ping has its own number: an unrequested pong is allowed, and says nothing.
bool send_ping(HaplyConnection& at, TimePoint end) {
  bool done = false;
  const std::string number = std::to_string(++at.pings);
  at.ping.assign(number.data(), number.size());
  at.ponged = false;
  at.socket.async_ping(at.ping, [&](boost::beast::error_code error) { done = !error; });
  return finish(at, end, [&] { return done; });
}

// Reads everything up to the pong, and what is already there after it: the newest counts. A service
// that never stops talking counts as none.
bool hear_out(HaplyConnection& at, json& newest, TimePoint end) {
  for (int i = 0; i < kMostUnasked; ++i) {
    listen(at);
    if (!finish(at, end, [&] { return at.heard || at.ponged; })) return false;
    at.io.restart();
    at.io.poll();
    if (at.heard) {
      take(at, newest);
    } else if (at.ponged) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool receive(HaplyConnection& at, json& message, TimePoint end) {
  listen(at);
  if (!finish(at, end, [&] { return at.heard; })) return false;
  take(at, message);
  return true;
}

bool tell(HaplyConnection& at, const std::string& text, json& newest, Milliseconds longest) {
  newest = nullptr;
  if (!send(at, text, within(longest)) || !send_ping(at, within(longest))) return false;
  const TimePoint end = within(longest);
  return receive(at, newest, end) && hear_out(at, newest, end);
}

void connect(HaplyConnection& at, const tcp::endpoint& endpoint, const std::string& rest) {
  boost::beast::error_code error;
  bool connected = false;
  at.socket.next_layer().async_connect(endpoint, [&](boost::beast::error_code result) {
    error = result;
    connected = true;
  });
  if (!finish(at, within(kOpeningTime), [&] { return connected; }))
    error = boost::asio::error::timed_out;
  if (!error) {
    at.socket.next_layer().set_option(tcp::no_delay(true));
    at.socket.control_callback([&at](websocket::frame_type type, string_view said) {
      const string_view wanted(at.ping.data(), at.ping.size());
      if (type == websocket::frame_type::pong && said == wanted) at.ponged = true;
    });
    bool done = false;
    at.socket.async_handshake("localhost", "/", [&](boost::beast::error_code result) {
      error = result;
      done = true;
    });
    if (!finish(at, within(kOpeningTime), [&] { return done; }))
      error = boost::asio::error::timed_out;
  }
  if (!error) return;
  throw DeviceError(
      fmt::format("haply:{}: {}:{}: {}: install haply-inverse-service and start it "
                  "(systemctl start haply-inverse-service)",
                  rest, endpoint.address().to_string(), endpoint.port(), error.message()));
}

}  // namespace stylet::hal::haply
