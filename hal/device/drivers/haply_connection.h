// SPDX-License-Identifier: Apache-2.0
// The WebSocket to Haply's service.
//
// Promise: each call ends in the time it is given; if what it waited for did not come, it closes
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
  bool reading = false, heard = false;      // a message is awaited; one has come
  std::uint32_t pings = 0;                  // sent so far
  boost::beast::websocket::ping_data ping;  // the text of the newest one
  bool ponged = false;                      // the pong of the newest ping has come
};

// Closing the connection is all that can be done about a force that the service may still hold.
void hang_up(HaplyConnection& at);
TimePoint within(Milliseconds longest);
// The next message. False: none came in time, or the connection broke; it is closed then.
bool receive(HaplyConnection& at, nlohmann::json& message, TimePoint end);
// Sends a message and then a ping. The service answers each message once, but may also speak
// unasked, and an answer does not say which message it belongs to. A client that sent a new message
// for each one received would get ahead of a slow service by one for each unasked message, and its
// forces would grow old in the queue. The pong shows that the service has read all we sent, so that
// no more than one of our messages is ever on its way. `newest` is null if no message came.
bool tell(HaplyConnection& at, const std::string& text, nlohmann::json& newest,
          Milliseconds longest = kAnswerTime);
// Throws DeviceError; its text names `rest`, a part of the URI.
void connect(HaplyConnection& at, const boost::asio::ip::tcp::endpoint& endpoint,
             const std::string& rest);

}  // namespace stylet::hal::haply
