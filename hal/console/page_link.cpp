// SPDX-License-Identifier: Apache-2.0
#include "hal/console/page_link.h"

#include <optional>
#include <utility>
#include <variant>

namespace stylet::console {

void PageLink::start(const beast::http::request<beast::http::empty_body>& request) {
  beast::get_lowest_layer(socket_).expires_never();
  socket_.set_option(beast::websocket::stream_base::timeout{kRequestTime, kIdleTime, true});
  socket_.read_message_max(kMaxMessageBytes);
  socket_.auto_fragment(false);
  socket_.binary(true);
  socket_.async_accept(request, [self = shared_from_this()](const Error& error) {
    if (error) return;
    self->server_.join(self);
    self->read();
  });
}

void PageLink::send(Parcel message) {
  if (closed_) return;
  const bool too_many = waiting_.size() >= kMaxWaitingMessages;
  const bool too_much = !waiting_.empty() && bytes_ + message->size() > kMaxWaitingBytes;
  if (too_many || too_much) return close();
  bytes_ += message->size();
  waiting_.push_back(std::move(message));
  if (waiting_.size() == 1) write();
}

void PageLink::close() {
  if (std::exchange(closed_, true)) return;
  beast::get_lowest_layer(socket_).close();
  server_.leave(*this);
}

void PageLink::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](const Error& error, std::size_t) {
    if (error || !self->take()) return self->close();
    self->read();
  });
}

bool PageLink::take() {
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

void PageLink::write() {
  const Bytes& bytes = *waiting_.front();
  socket_.async_write(asio::buffer(bytes.data(), bytes.size()),
                      [self = shared_from_this()](const Error& error, std::size_t) {
                        if (error) return self->close();
                        self->bytes_ -= self->waiting_.front()->size();
                        self->waiting_.pop_front();
                        if (!self->waiting_.empty()) self->write();
                      });
}

}  // namespace stylet::console
