// SPDX-License-Identifier: Apache-2.0
#include "hal/console/server.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <thread>
#include <utility>

#include "hal/base/contained.h"
#include "hal/console/assets.h"
#include "hal/console/limits.h"

namespace stylet::console {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using Error = boost::system::error_code;
using Parcel = std::shared_ptr<const Bytes>;

Parcel shared(Bytes bytes) {
  return std::make_shared<const Bytes>(std::move(bytes));
}

std::string_view view_of(boost::string_view text) {
  return {text.data(), text.size()};
}

// The lowest priority, and none of the loop's processors where there are others.
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

// Counts the connections that are open.
struct Seat {
  explicit Seat(std::size_t& count) : taken(&count) { ++count; }
  ~Seat() { --*taken; }
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;
  std::size_t* taken;
};

}  // namespace

class Link;

// What a page has got already.
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
  std::string take_order(const Link& link, Order order);
  void answer_rows(Link& link, const AskedRows& asked);
  std::uint64_t present_tick() const { return state == nullptr ? 0 : state->hand[0].output.tick; }
  void score(const ScoredAttempt& attempt);
  void keep_and_send(std::deque<Parcel>& kept, std::size_t most, Bytes bytes);
  void greet(Link& link);
  bool in_control(const Link& link) const;
  void join(const std::shared_ptr<Link>& link);
  void leave(const Link& link);
  const Curve& curve() const { return recorded ? *recorded : live; }

  ServerConfig config;
  ServerEvents events;
  std::size_t connections = 0;  // outlives those in the context
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer timer{io};
  std::vector<std::shared_ptr<Link>> links;  // the oldest is in control
  hal::Ring<Told> told{kRowRing};

  std::shared_ptr<const Stage> stage;
  Activity activity = Activity::Ready;
  std::shared_ptr<const Curve> recorded;  // of a recording; else live is shown
  Curve live{kMaxRowsKept};
  const hal::DisplayState* state = nullptr;  // the newest; the display's
  Places places;
  std::uint64_t serial = 0;  // of the newest state
  TimingShown timing;
  std::uint32_t rounds = 0;
  std::uint64_t lost_frames = 0;  // of all pages so far
  std::deque<Parcel> marks;       // of this session
  std::deque<Parcel> scores;      // of this session
  std::thread thread;             // last: it uses all of the above
};

// ---- a page's WebSocket

class Link : public std::enable_shared_from_this<Link> {
 public:
  Link(beast::tcp_stream&& stream, Server::Impl& server, std::shared_ptr<Seat> seat)
      : socket_(std::move(stream)), server_(server), seat_(std::move(seat)) {}

  void start(const http::request<http::empty_body>& request) {
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout{kRequestTime, kIdleTime, true});
    socket_.read_message_max(kMaxMessageBytes);
    socket_.auto_fragment(false);
    socket_.binary(true);
    socket_.async_accept(request, [self = shared_from_this()](const Error& error) {
      if (error) return;
      self->server_.join(self);
      self->read();
    });
  }

  void send(Parcel message) {
    if (closed_) return;
    const bool too_many = waiting_.size() >= kMaxWaitingMessages;
    const bool too_much = !waiting_.empty() && bytes_ + message->size() > kMaxWaitingBytes;
    if (too_many || too_much) return close();
    bytes_ += message->size();
    waiting_.push_back(std::move(message));
    if (waiting_.size() == 1) write();
  }

  bool free() const { return waiting_.empty() && !closed_; }

  void close() {
    if (std::exchange(closed_, true)) return;
    beast::get_lowest_layer(socket_).close();
    server_.leave(*this);
  }

  Got got;

 private:
  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](const Error& error, std::size_t) {
      if (error || !self->take()) return self->close();
      self->read();
    });
  }

  // False: close.
  bool take() {
    const auto now = std::chrono::steady_clock::now();
    if (now - second_ > std::chrono::seconds(1)) {
      second_ = now;
      messages_ = 0;
    }
    if (++messages_ > kMaxMessagesPerSecond || !socket_.got_binary()) return false;
    const auto data = buffer_.cdata();
    const std::optional<Asked> asked =
        read_message({static_cast<const std::byte*>(data.data()), data.size()});
    buffer_.consume(buffer_.size());
    if (!asked) return false;
    if (const auto* rows = std::get_if<AskedRows>(&*asked)) {
      server_.answer_rows(*this, *rows);
    } else if (const auto* moved = std::get_if<PointerMoved>(&*asked)) {
      if (server_.in_control(*this) && server_.events.pointed) server_.events.pointed(*moved);
    } else {
      const std::string refused = server_.take_order(*this, std::get<Order>(*asked));
      if (!refused.empty()) send(shared(refused_message(refused)));
    }
    return true;
  }

  void write() {
    const Bytes& bytes = *waiting_.front();
    socket_.async_write(asio::buffer(bytes.data(), bytes.size()),
                        [self = shared_from_this()](const Error& error, std::size_t) {
                          if (error) return self->close();
                          self->bytes_ -= self->waiting_.front()->size();
                          self->waiting_.pop_front();
                          if (!self->waiting_.empty()) self->write();
                        });
  }

  websocket::stream<beast::tcp_stream> socket_;
  Server::Impl& server_;
  std::shared_ptr<Seat> seat_;
  beast::flat_buffer buffer_{kMaxMessageBytes};
  std::deque<Parcel> waiting_;  // the first is being written
  std::size_t bytes_ = 0;       // of those
  std::chrono::steady_clock::time_point second_ = {};
  std::uint32_t messages_ = 0;
  bool closed_ = false;
};

// ---- HTTP

namespace {

class Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(tcp::socket&& socket, Server::Impl& server)
      : stream_(std::move(socket)),
        server_(server),
        seat_(std::make_shared<Seat>(server.connections)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(0);
    stream_.expires_after(kRequestTime);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](const Error& error, std::size_t) {
                       if (!error) self->answer();
                     });
  }

 private:
  using Answer = http::response<http::span_body<const char>>;

  void answer() {
    const auto& request = parser_->get();
    const Verdict verdict =
        judge(server_.config.gate,
              {view_of(request.method_string()), view_of(request.target()),
               view_of(request[http::field::host]), view_of(request[http::field::origin])});
    if (verdict.status != 200) return reply(verdict.status, "text/plain", verdict.reason);
    switch (verdict.place) {
      case Place::kPage:
        return reply(200, "text/html; charset=utf-8", page_html());
      case Place::kScript:
        return reply(200, "text/javascript; charset=utf-8", page_script());
      case Place::kStyle:
        return reply(200, "text/css; charset=utf-8", page_style());
      case Place::kOrgan:
        return reply_organ();
      case Place::kMetrics:
        text_ = server_.events.metrics
                    ? server_.events.metrics({server_.connections, server_.lost_frames,
                                              server_.stage ? server_.stage->scene : ""})
                    : "";
        return reply(200, "text/plain; version=0.0.4; charset=utf-8", text_);
      case Place::kSocket:
        if (!websocket::is_upgrade(request)) return reply(400, "text/plain", "only a WebSocket");
        std::make_shared<Link>(std::move(stream_), server_, seat_)->start(request);
    }
  }

  void reply_organ() {
    const auto stage = server_.stage;
    if (stage == nullptr) return reply(503, "text/plain", "no scene yet");
    organ_ = stage->organ;
    const auto* bytes = reinterpret_cast<const char*>(organ_->bytes.data());
    reply(200, "application/octet-stream", {bytes, organ_->bytes.size()});
  }

  // `body` must outlive the answer.
  void reply(unsigned status, const char* type, std::string_view body) {
    answer_.emplace(http::status(status), parser_->get().version());
    answer_->set(http::field::content_type, type);
    answer_->set(http::field::cache_control, "no-store");
    answer_->set("Referrer-Policy", "no-referrer");
    answer_->set("X-Content-Type-Options", "nosniff");
    answer_->set("X-Frame-Options", "DENY");
    answer_->set("Content-Security-Policy",
                 "default-src 'self'; img-src 'self' data: blob:; style-src 'self' "
                 "'unsafe-inline'; frame-ancestors 'none'; form-action 'none'; base-uri 'none'");
    answer_->keep_alive(status == 200 && parser_->get().keep_alive());
    answer_->body() = {body.data(), body.size()};
    answer_->prepare_payload();
    stream_.expires_after(kAnswerTime + std::chrono::seconds(body.size() >> 20U));
    http::async_write(stream_, *answer_,
                      [self = shared_from_this()](const Error& error, std::size_t) {
                        if (error) return;
                        if (self->answer_->need_eof()) {
                          Error ignored;
                          self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                          return;
                        }
                        self->read();
                      });
  }

  beast::tcp_stream stream_;
  Server::Impl& server_;
  std::shared_ptr<Seat> seat_;
  beast::flat_buffer buffer_{2 * kMaxHeaderBytes};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<Answer> answer_;
  std::shared_ptr<const hal::OrganFile> organ_;
  std::string text_;
};

}  // namespace

// ---- the server

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
    // What fails is one page's connection, not the others'.
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
      std::make_shared<Visit>(std::move(socket), *this)->read();
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
  if (stage == nullptr) return;
  if (const hal::DisplayState* newest = stage->display->take(); newest != nullptr) {
    state = newest;
    quantise(stage->lattice, state->moved_m, places);
    ++serial;
  }
  // Quantiles walk all bins: a few times a second is often enough.
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
  for (const std::shared_ptr<Link>& link : std::vector(links)) {
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

bool Server::Impl::in_control(const Link& link) const {
  return !links.empty() && links.front().get() == &link;
}

void Server::Impl::greet(Link& link) {
  link.got = {};
  if (stage == nullptr) return;
  link.send(shared(hello_message(*stage, in_control(link))));
  for (const Parcel& each : scores) link.send(each);
  for (const Parcel& each : marks) link.send(each);
}

void Server::Impl::join(const std::shared_ptr<Link>& link) {
  links.push_back(link);
  greet(*link);
}

void Server::Impl::leave(const Link& link) {
  const bool controlled = in_control(link);
  std::erase_if(links, [&link](const auto& each) { return each.get() == &link; });
  if (controlled && events.pointer_left) events.pointer_left();
  if (controlled && !links.empty()) greet(*links.front());
}

// A teacher marks from a page of his own, whoever is in control.
std::string Server::Impl::take_order(const Link& link, Order order) {
  const bool mark = order.verb == Verb::kMark;
  if (!mark && !in_control(link)) {
    return "only the page that came first may control; this one may look and mark";
  }
  const std::size_t most = mark ? kMaxMarkBytes : kMaxNameBytes;
  if (order.verb != Verb::kChoose && order.text.size() > most) {
    return fmt::format("a text of {} bytes: at most {}", order.text.size(), most);
  }
  if (mark) {
    order.tick = present_tick();
    const auto control = [](unsigned char c) { return c < ' ' || c == 0x7F; };
    std::replace_if(order.text.begin(), order.text.end(), control, ' ');
  }
  const std::string refused = events.ordered(order);
  if (refused.empty() && mark) {
    // Before the first tick, a mark is of the attempt to come.
    const auto attempt = static_cast<std::uint32_t>(std::max<std::uint64_t>(live.attempt(), 1));
    keep_and_send(marks, kMaxMarksKept, marked_message(order.tick, order.text, attempt));
  }
  return refused;
}

void Server::Impl::score(const ScoredAttempt& attempt) {
  if (stage == nullptr) return;
  take_news();
  const std::span rows = curve().rows_from(0);
  const std::uint64_t first = rows.empty() ? 0 : rows.front().tick();
  const std::vector<Row> thinned = thin(rows, first, stride_for(rows.size(), 1, kMaxRowsPerScore));
  keep_and_send(scores, kMaxScoresKept, score_message(*stage, attempt, thinned));
}

void Server::Impl::keep_and_send(std::deque<Parcel>& kept, std::size_t most, Bytes bytes) {
  kept.push_back(shared(std::move(bytes)));
  if (kept.size() > most) kept.pop_front();
  for (const auto& link : std::vector(links)) link->send(kept.back());
}

void Server::Impl::answer_rows(Link& link, const AskedRows& asked) {
  if (stage == nullptr || asked.last < asked.first) return;
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

void Server::show(std::shared_ptr<const Stage> stage) {
  asio::post(impl_->io, [impl = impl_.get(), stage = std::move(stage)]() mutable {
    impl->state = nullptr;  // it belongs to the display of the old stage
    impl->stage = std::move(stage);
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
