// SPDX-License-Identifier: Apache-2.0
// What the server's thread holds for its parts: connections (visit.h), pages (page_link.h), and the
// server itself (server.cpp). Promise: all of it belongs to the server's thread once that has
// begun.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <deque>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hal/console/limits.h"
#include "hal/console/server.h"

namespace stylet::console {

namespace asio = boost::asio;
using asio::ip::tcp;
using Error = boost::system::error_code;
using Parcel = std::shared_ptr<const Bytes>;

inline Parcel shared(Bytes bytes) {
  return std::make_shared<const Bytes>(std::move(bytes));
}

class PageLink;

// Counts open connections.
struct Seat {
  explicit Seat(std::size_t& count) : taken(&count) { ++count; }
  ~Seat() { --*taken; }
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;
  std::size_t* taken;
};

// What a page has already been sent.
struct Got {
  Places places;  // empty: it needs a key frame
  std::uint64_t serial = 0, offered = 0;
  std::uint64_t attempt = 0, rows = 0, events = 0;
  Activity activity = Activity::Ready;
  std::uint64_t lost_frames = 0;
};

struct Server::Impl {
  Impl(ServerConfig config_in, ServerEvents events_in);

  void accept();
  void wait_for_frame();
  void serve_frames();
  void take_news();
  bool news_for(const Got& got) const;
  std::string take_order(const PageLink& link, Order order);
  void answer_rows(PageLink& link, const AskedRows& asked);
  std::uint64_t present_tick() const { return state == nullptr ? 0 : state->hand[0].output.tick; }
  void score(const ScoredAttempt& attempt);
  void keep_and_send(std::deque<Parcel>& kept, std::size_t most, Bytes bytes);
  void greet(PageLink& link);
  bool in_control(const PageLink& link) const;
  void join(const std::shared_ptr<PageLink>& link);
  void leave(const PageLink& link);
  const Curve& curve() const { return recorded ? *recorded : live; }

  ServerConfig config;
  ServerEvents events;
  std::size_t connections = 0;  // must outlive the connections in `io`
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer timer{io};
  std::vector<std::shared_ptr<PageLink>> links;  // the oldest page is in control
  hal::Ring<Told> told{kRowRing};

  std::shared_ptr<const SceneView> view;
  Activity activity = Activity::Ready;
  std::shared_ptr<const Curve> recorded;  // of a recording; if null, `live` is shown
  Curve live{kMaxRowsKept};
  const hal::DisplayState* state = nullptr;  // the newest; belongs to the display
  Places places;
  std::uint64_t serial = 0;  // of the newest state
  TimingShown timing;
  std::uint32_t rounds = 0;
  std::uint64_t lost_frames = 0;  // of all pages so far
  std::deque<Parcel> marks;       // of this session
  std::deque<Parcel> scores;      // of this session
  std::thread thread;             // last, because it uses all of the above
};

}  // namespace stylet::console
