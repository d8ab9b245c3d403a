// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/haply_events.h"

#include <atomic>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "hal/base/contained.h"

namespace stylet::hal {

using boost::asio::ip::tcp;
using nlohmann::json;
namespace websocket = boost::beast::websocket;

namespace {

constexpr int kMostTries = 8;  // more than the number of operations started

std::string text(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

HaplyEvent event_of(const json& message) {
  HaplyEvent event;
  event.name = text(message, "name");
  event.message = text(message, "message");
  const std::string level = text(message, "level");
  event.warns = level != "info" && level != "notice";
  const auto data = message.find("data");
  if (data != message.end() && data->is_object()) {
    event.device_id = text(*data, "device_id");
    event.safety = text(*data, "safety_type");
  }
  return event;
}

}  // namespace

struct HaplyEvents::Reader {
  std::function<void(const HaplyEvent&)> tell;
  boost::asio::io_context io;
  websocket::stream<tcp::socket> socket{io};
  boost::beast::flat_buffer buffer;
  std::atomic<bool> connected{false}, stop{false};
  std::thread thread;

  void read_next() {
    buffer.clear();
    socket.async_read(buffer, [this](boost::beast::error_code error, std::size_t) {
      connected = !error;
      if (error) return;
      const auto* at = static_cast<const char*>(buffer.data().data());
      const json message = json::parse(at, at + buffer.size(), nullptr, false);
      if (message.is_object()) tell(event_of(message));
      read_next();
    });
  }

  void run(const tcp::endpoint& endpoint) {
    socket.next_layer().async_connect(endpoint, [this](boost::beast::error_code error) {
      if (error) return;
      socket.async_handshake("localhost", "/", [this](boost::beast::error_code refused) {
        connected = !refused;
        if (!refused) read_next();
      });
    });
    if (!contained("haply", [this] {
          while (!stop && !io.stopped()) io.run_for(std::chrono::milliseconds(20));
        })) {
      connected = false;
    }
    boost::beast::error_code ignored;
    socket.next_layer().close(ignored);
    io.restart();
    // All that has been started ends while what it points to still exists.
    for (int i = 0; i < kMostTries && !contained("haply", [this] { io.run(); }); ++i) {
    }
  }
};

HaplyEvents::HaplyEvents(const tcp::endpoint& endpoint, std::function<void(const HaplyEvent&)> tell)
    : reader_(std::make_unique<Reader>()) {
  reader_->tell = std::move(tell);
  reader_->thread = std::thread([at = reader_.get(), endpoint] {
    name_thread("stylet-haply");
    (void)contained("haply", [&] { at->run(endpoint); });
  });
}

HaplyEvents::~HaplyEvents() {
  reader_->stop = true;
  reader_->thread.join();
}

bool HaplyEvents::connected() const {
  return reader_->connected;
}

}  // namespace stylet::hal
