// SPDX-License-Identifier: Apache-2.0
// The WebSocket to Haply's service.
//
// Promise: each call ends in the time it is given; one that did not get what it waited for closes
// the connection. Used by one thread. Source: RFC 6455.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace stylet::hal::haply {

using Milliseconds = std::chrono::milliseconds;
using TimePoint = std::chrono::steady_clock::time_point;
constexpr Milliseconds kAnswerTime(20), kOpeningTime(2000);

struct HaplyConnection {
  boost::asio::io_context io;
  boost::beast::websocket::stream<boost::asio::ip::tcp::socket> socket{io};
  boost::beast::flat_buffer buffer;
  bool reading = false, heard = false;      // a message is waited for; one has come
  std::uint32_t pings = 0;                  // sent so far
  boost::beast::websocket::ping_data ping;  // what the newest one says
  bool ponged = false;                      // its pong has come
};

// A closed connection is all that can be done about a force the service may still hold.
void hang_up(HaplyConnection& at);
TimePoint within(Milliseconds longest);
// The next message. False: none in time, or broken; the connection is closed then.
bool receive(HaplyConnection& at, nlohmann::json& message, TimePoint end);
// A message, and a ping behind it. The service answers each message once, but may speak unasked,
// too, and what comes does not say which message it answers: whoever sent the next one for each
// that comes would get ahead of a slow service by one for each unasked one, and the forces that
// wait there would grow old. The pong shows that the service has read all that was sent, so that no
// more than one of our messages is ever on its way. `newest` is null where no message came.
bool tell(HaplyConnection& at, const std::string& text, nlohmann::json& newest,
          Milliseconds longest = kAnswerTime);
// Throws DeviceError; `rest`: of the URI, for its text.
void connect(HaplyConnection& at, const boost::asio::ip::tcp::endpoint& endpoint,
             const std::string& rest);

}  // namespace stylet::hal::haply
