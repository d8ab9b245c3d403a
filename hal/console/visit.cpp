// SPDX-License-Identifier: Apache-2.0
#include "hal/console/visit.h"

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "hal/console/assets.h"
#include "hal/console/page_link.h"

namespace stylet::console {
namespace {

namespace http = beast::http;

std::string_view view_of(boost::string_view text) {
  return {text.data(), text.size()};
}

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
    const GateAnswer verdict =
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
                                              server_.view ? server_.view->scene : ""})
                    : "";
        return reply(200, "text/plain; version=0.0.4; charset=utf-8", text_);
      case Place::kSocket:
        if (!beast::websocket::is_upgrade(request))
          return reply(400, "text/plain", "expected a WebSocket connection");
        std::make_shared<PageLink>(std::move(stream_), server_, seat_)->start(request);
    }
  }

  void reply_organ() {
    const auto view = server_.view;
    if (view == nullptr) return reply(503, "text/plain", "no scene yet");
    organ_ = view->organ;
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

void serve_visit(tcp::socket&& socket, Server::Impl& server) {
  std::make_shared<Visit>(std::move(socket), server)->read();
}

}  // namespace stylet::console
