// SPDX-License-Identifier: Apache-2.0
#include "hal/console/server.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <utility>

#include "hal/base/contained.h"
#include "hal/console/limits.h"
#include "hal/console/page_link.h"
#include "hal/console/server_state.h"
#include "hal/console/visit.h"

namespace stylet::console {
namespace {

// Takes the lowest priority, and avoids the loop's processors if there are others.
void stand_back(const std::vector<int>& spared) {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 19);
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  for (const int cpu : spared) {
    if (cpu >= 0 && cpu < CPU_SETSIZE) CPU_CLR(static_cast<std::size_t>(cpu), &allowed);
  }
  if (CPU_COUNT(&allowed) > 0) sched_setaffinity(0, sizeof allowed, &allowed);
}

}  // namespace

Server::Impl::Impl(ServerConfig config_in, ServerEvents events_in)
    : config(std::move(config_in)), events(std::move(events_in)) {
  GateConfig& gate = config.gate;
  const auto fail = [&gate](const Error& error) {
    throw ConsoleError(
        fmt::format("console: {}:{}: {}: expected an address of this machine and a free port",
                    gate.address, gate.port, error.message()));
  };
  Error error;
  const auto address = asio::ip::make_address(gate.address, error);
  if (error) fail(error);
  const tcp::endpoint at(address, gate.port);
  acceptor.open(at.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(at, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) fail(error);
  gate.port = acceptor.local_endpoint().port();
  accept();
  wait_for_frame();
  thread = std::thread([this] {
    hal::name_thread("stylet-console");
    stand_back(config.spared_processors);
    // A failure ends one page's connection, not the others.
    while (!hal::contained("console", [this] { io.run(); })) {
    }
  });
}

void Server::Impl::accept() {
  acceptor.async_accept([this](const Error& error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error && connections < kMaxConnections) {
      Error ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      socket.set_option(tcp::socket::send_buffer_size(kSendBufferBytes), ignored);
      serve_visit(std::move(socket), *this);
    }
    accept();
  });
}

void Server::Impl::wait_for_frame() {
  timer.expires_after(kFramePause);
  timer.async_wait([this](const Error& error) {
    if (error) return;
    serve_frames();
    wait_for_frame();
  });
}

void Server::Impl::take_news() {
  for (Told each; told.pop(each);) live.add(each);
  if (view == nullptr) return;
  if (const hal::DisplayState* newest = view->display->take(); newest != nullptr) {
    state = newest;
    quantise(view->lattice, state->moved_m, places);
    ++serial;
  }
  // Quantiles go through all bins, so a few times a second is enough.
  constexpr std::uint32_t kTimingRounds = 16;
  if (rounds++ % kTimingRounds == 0) timing = timing_of(curve());
  timing.connections = static_cast<std::uint32_t>(links.size());
}

// The last rows of an attempt come after its last state.
bool Server::Impl::news_for(const Got& got) const {
  return got.serial != serial || got.activity != activity || got.attempt != live.attempt() ||
         got.rows != live.row_count() || got.events != live.event_count();
}

void Server::Impl::serve_frames() {
  take_news();
  if (state == nullptr) return;
  for (const std::shared_ptr<PageLink>& link : std::vector(links)) {
    Got& got = link->got;
    if (!news_for(got)) continue;
    if (!link->free()) {
      if (std::exchange(got.offered, serial) != serial) {
        ++got.lost_frames;
        ++lost_frames;
      }
      continue;
    }
    if (got.attempt != live.attempt()) got.rows = got.events = 0;
    got.attempt = live.attempt();
    const std::span rows = live.rows_from(got.rows);
    const std::span happened = live.events_from(got.events);
    const std::vector<Row> shown =
        rows.empty()
            ? std::vector<Row>{}
            : thin(rows, rows.front().tick(), stride_for(rows.size(), 1, kMaxRowsPerFrame));
    timing.lost_frames = got.lost_frames;
    link->send(shared(frame_message({activity, state, &places, &got.places, shown, happened,
                                     &timing, static_cast<std::uint32_t>(live.attempt())})));
    got.places = places;
    got.serial = serial;
    got.activity = activity;
    got.rows = live.row_count();
    got.events = live.event_count();
  }
}

bool Server::Impl::in_control(const PageLink& link) const {
  return !links.empty() && links.front().get() == &link;
}

void Server::Impl::greet(PageLink& link) {
  link.got = {};
  if (view == nullptr) return;
  link.send(shared(hello_message(*view, in_control(link))));
  for (const Parcel& each : scores) link.send(each);
  for (const Parcel& each : marks) link.send(each);
}

void Server::Impl::join(const std::shared_ptr<PageLink>& link) {
  links.push_back(link);
  greet(*link);
}

void Server::Impl::leave(const PageLink& link) {
  const bool controlled = in_control(link);
  std::erase_if(links, [&link](const auto& each) { return each.get() == &link; });
  if (controlled && events.pointer_left) events.pointer_left();
  if (controlled && !links.empty()) greet(*links.front());
}

// A teacher marks from a page of their own, whoever is in control.
std::string Server::Impl::take_order(const PageLink& link, Order order) {
  const bool mark = order.verb == Verb::kMark;
  if (!mark && !in_control(link)) {
    return "only the page that connected first is in control; this one may watch and set marks";
  }
  const std::size_t most = mark ? kMaxMarkBytes : kMaxNameBytes;
  if (order.verb != Verb::kChoose && order.text.size() > most) {
    return fmt::format("a text of {} bytes: expected at most {}", order.text.size(), most);
  }
  if (mark) {
    order.tick = present_tick();
    const auto control = [](unsigned char c) { return c < ' ' || c == 0x7F; };
    std::replace_if(order.text.begin(), order.text.end(), control, ' ');
  }
  const std::string refused = events.ordered(order);
  if (refused.empty() && mark) {
    // A mark before the first tick belongs to the next attempt.
    const auto attempt = static_cast<std::uint32_t>(std::max<std::uint64_t>(live.attempt(), 1));
    keep_and_send(marks, kMaxMarksKept, marked_message(order.tick, order.text, attempt));
  }
  return refused;
}

void Server::Impl::score(const ScoredAttempt& attempt) {
  if (view == nullptr) return;
  take_news();
  const std::span rows = curve().rows_from(0);
  const std::uint64_t first = rows.empty() ? 0 : rows.front().tick();
  const std::vector<Row> thinned = thin(rows, first, stride_for(rows.size(), 1, kMaxRowsPerScore));
  keep_and_send(scores, kMaxScoresKept, score_message(*view, attempt, thinned));
}

void Server::Impl::keep_and_send(std::deque<Parcel>& kept, std::size_t most, Bytes bytes) {
  kept.push_back(shared(std::move(bytes)));
  if (kept.size() > most) kept.pop_front();
  for (const auto& link : std::vector(links)) link->send(kept.back());
}

void Server::Impl::answer_rows(PageLink& link, const AskedRows& asked) {
  if (view == nullptr || asked.last < asked.first) return;
  const std::span rows = curve().rows_between(asked.first, asked.last);
  const std::uint32_t points = std::clamp(asked.points, 1U, kMaxRowsPerAnswer);
  const std::uint32_t stride = stride_for(rows.size(), 1, points);
  std::vector<Happened> events_there;
  for (const Happened& each : curve().events_from(0)) {
    if (each.tick() >= asked.first && each.tick() <= asked.last) events_there.push_back(each);
  }
  link.send(
      shared(rows_message(asked.first, stride, thin(rows, asked.first, stride), events_there)));
}

Server::Server(const ServerConfig& config, ServerEvents events)
    : impl_(std::make_unique<Impl>(config, std::move(events))) {}

Server::~Server() {
  asio::post(impl_->io, [impl = impl_.get()] {
    for (const auto& link : std::vector(impl->links)) link->close();
    impl->io.stop();
  });
  impl_->thread.join();
}

std::string Server::url() const {
  const GateConfig& gate = impl_->config.gate;
  const bool six = gate.address.find(':') != std::string::npos;
  return fmt::format("http://{}{}{}:{}/{}{}", six ? "[" : "", gate.address, six ? "]" : "",
                     gate.port, gate.token.empty() ? "" : "?token=", gate.token);
}

void Server::show(std::shared_ptr<const SceneView> view) {
  asio::post(impl_->io, [impl = impl_.get(), view = std::move(view)]() mutable {
    impl->state = nullptr;  // it belongs to the old view's display
    impl->view = std::move(view);
    for (const auto& link : std::vector(impl->links)) impl->greet(*link);
  });
}

void Server::show(Activity activity) {
  asio::post(impl_->io, [impl = impl_.get(), activity] { impl->activity = activity; });
}

void Server::show(std::shared_ptr<const Curve> curve, std::span<const hal::Mark> marks) {
  std::deque<Parcel> told;
  for (const hal::Mark& each : marks.first(std::min(marks.size(), kMaxMarksKept))) {
    told.push_back(shared(marked_message(each.tick, each.text, 0)));
  }
  asio::post(impl_->io, [impl = impl_.get(), curve = std::move(curve), told = std::move(told)] {
    impl->recorded = curve;
    impl->marks = told;
  });
}

void Server::show(const ScoredAttempt& attempt) {
  asio::post(impl_->io, [impl = impl_.get(), attempt] { impl->score(attempt); });
}

void Server::refuse(const std::string& what) {
  asio::post(impl_->io, [impl = impl_.get(), what] {
    if (!impl->links.empty()) impl->links.front()->send(shared(refused_message(what)));
  });
}

bool Server::tell(const Told& told) {
  return impl_->told.push(told);
}

}  // namespace stylet::console
