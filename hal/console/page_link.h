// SPDX-License-Identifier: Apache-2.0
// A page's WebSocket: what it sends is checked and passed on; what is sent to it waits in a bounded
// queue.
// Promise: used by the server's thread alone; a page that sends unknown messages, or too many, or
// takes nothing, is closed, and nobody else notices.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>

#include "hal/console/server_state.h"

namespace stylet::console {

namespace beast = boost::beast;

class PageLink : public std::enable_shared_from_this<PageLink> {
 public:
  PageLink(beast::tcp_stream&& stream, Server::Impl& server, std::shared_ptr<Seat> seat)
      : socket_(std::move(stream)), server_(server), seat_(std::move(seat)) {}

  void start(const beast::http::request<beast::http::empty_body>& request);
  void send(Parcel message);
  bool free() const { return waiting_.empty() && !closed_; }

  void close();

  Got got;

 private:
  void read();
  // False: close the connection.
  bool take();
  void write();

  beast::websocket::stream<beast::tcp_stream> socket_;
  Server::Impl& server_;
  std::shared_ptr<Seat> seat_;
  beast::flat_buffer buffer_{kMaxMessageBytes};
  std::deque<Parcel> waiting_;  // the first is being written
  std::size_t bytes_ = 0;       // of those
  std::chrono::steady_clock::time_point second_ = {};
  std::uint32_t messages_ = 0;
  bool closed_ = false;
};

}  // namespace stylet::console
