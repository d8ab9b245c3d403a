// SPDX-License-Identifier: Apache-2.0
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>

#include "hal/device/devices.h"
#include "hal/device/drivers/haply.h"
#include "service_bench.h"

namespace stylet::hal {
namespace {
using boost::asio::ip::tcp;
using nlohmann::json;
namespace websocket = boost::beast::websocket;

// A program registers its drivers before it opens its first device.
[[maybe_unused]] const bool g_haply_is_known = [] {
  use_drivers(drivers_with_haply());
  return true;
}();

bool readable(int socket, int wait_ms) {
  pollfd wanted = {socket, POLLIN, 0};
  return ::poll(&wanted, 1, wait_ms) > 0;
}

// All bytes that have come so far, read or not. The C library's tcp_info ends before this field of
// Linux (linux/tcp.h, since 4.1), and both headers cannot be included together.
std::uint64_t bytes_received(int socket) {
  struct {
    tcp_info first;
    std::uint64_t pacing_rate, max_pacing_rate, bytes_acked, bytes_received;
  } info = {};
  socklen_t size = sizeof info;
  (void)getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size);
  return info.bytes_received;
}

// Bytes of a client's unfragmented frame: two, four for its mask, and two for a longer size.
std::uint64_t frame_bytes(std::size_t payload) {
  return payload + (payload < 126 ? 6 : 8);
}
}  // namespace

struct HaplyService::Connection {
  explicit Connection(Listener& listener);
  // Takes the next message and answers the pings before it; false: none came in 2 ms.
  bool read();

  boost::asio::io_context io;
  boost::beast::flat_buffer buffer;
  websocket::stream<tcp::socket> socket{io};
  boost::system::error_code error;
  bool reading = false, heard = false;
  std::uint64_t read_bytes = 0;  // of messages, pings and pongs
  bool ours = false;             // commands 049D
};

struct HaplyService::Listener {
  // Several threads share it: a connection that one of them has taken must not hold up the others.
  explicit Listener(bool shared = false) { acceptor.non_blocking(shared); }
  boost::asio::io_context io;
  tcp::acceptor acceptor{io, {boost::asio::ip::make_address("127.0.0.1"), 0}};
  std::string port() const { return std::to_string(acceptor.local_endpoint().port()); }
};

HaplyService::Connection::Connection(Listener& listener) {
  listener.acceptor.accept(socket.next_layer(), error);
}

bool HaplyService::Connection::read() {
  if (!reading) {
    reading = true;
    buffer.clear();
    socket.async_read(buffer, [this](boost::system::error_code failed, std::size_t size) {
      reading = false;
      heard = true;
      error = failed;
      read_bytes += frame_bytes(size);
    });
  }
  heard = false;
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(2);
  io.restart();
  while (!heard && io.run_one_until(end) > 0) {
  }
  if (error) throw boost::system::system_error(error);
  return heard;
}

HaplyService::HaplyService(int clients)
    : listener_(std::make_unique<Listener>(clients > 1)),
      events_(std::make_unique<Listener>()),
      thread_([this] { serve(); }),
      event_thread_([this] { serve_events(); }) {
  loses = false;  // TCP sends again what is lost
  while (--clients > 0) more_.emplace_back([this] { serve(); });
}

HaplyService::~HaplyService() {
  stop_ = true;
  thread_.join();
  for (std::thread& each : more_) each.join();
  event_thread_.join();
}

std::string HaplyService::uri_with(const std::string& wishes) const {
  return address() + wishes + ",events=" + events_->port();
}

std::string HaplyService::address(const std::string& id) const {
  return "haply:" + id + "@127.0.0.1:" + listener_->port();
}

void HaplyService::tell(const std::string& event) {
  const std::lock_guard lock(mutex_);
  untold_.push_back(event);
}

void HaplyService::serve_events() {
  while (!stop_) {
    if (!readable(events_->acceptor.native_handle(), 2)) continue;
    Connection connection(*events_);
    try {
      connection.socket.accept();
      const auto gone = [&](int wait_ms) {
        return stop_ || readable(connection.socket.next_layer().native_handle(), wait_ms);
      };
      while (!gone(2)) {
        const std::lock_guard lock(mutex_);
        if (gone(0)) break;  // what was set since is for the next one
        for (const std::string& each : untold_) {
          connection.socket.write(boost::asio::buffer(each));
        }
        untold_.clear();
      }
    } catch (const boost::system::system_error&) {  // the client has gone
    }
  }
}

void HaplyService::move(const Pose& pose) {
  const std::lock_guard lock(mutex_);
  pose_ = pose;
}
void HaplyService::press(std::uint32_t mask) {
  const std::lock_guard lock(mutex_);
  buttons_ = mask;
}
Vec3 HaplyService::felt() {
  const std::lock_guard lock(mutex_);
  return force_n_;
}

// The vendor's x is toward the user, y right, z up.
std::string HaplyService::state(bool inventory) {
  const std::lock_guard lock(mutex_);
  const Vec3& p = pose_.position_m;
  const Quat& q = pose_.rotation;
  json device = {{"device_id", "049D"},
                 {"status", {{"calibrated", trouble_ != test::Trouble::kUncalibrated}}},
                 {"state", {{"cursor_position", {{"x", p.z}, {"y", p.x}, {"z", p.y}}}}}};
  const double share = gate.load() < 1 ? 0.8 : 1;
  device["state"]["current_cursor_force"] = {{"x", share * static_cast<double>(force_n_.z)},
                                             {"y", share * static_cast<double>(force_n_.x)},
                                             {"z", share * static_cast<double>(force_n_.y)}};
  if (inventory) {
    device["config"] = {
        {"handedness", "right"},
        {"filters",
         {{"force_gate", {{"gain", gate.load()}}}, {"damping", {{"scalar", damping.load()}}}}}};
  }
  json other = device;
  other["device_id"] = "AAAA";
  other["state"]["cursor_position"] = {{"x", 9}, {"y", 9}, {"z", 9}};
  json grip = {{"device_id", "1"},
               {"state", {{"orientation", {{"w", q.w}, {"x", q.z}, {"y", q.x}, {"z", q.y}}}}}};
  grip["status"]["awake"] = grip_awake.load();  // asleep, it keeps its last state
  if (messages % 2 == 0) {
    grip["state"]["buttons"] = {{"a", (buttons_ & 1) != 0}, {"b", (buttons_ & 2) != 0}};
  } else {
    grip["state"]["button_0"] = buttons_ & 1;
    grip["state"]["button_1"] = buttons_ >> 1 & 1;
  }
  json held = {{"device_id", "2"}, {"status", {{"awake", true}}}, {"state", grip["state"]}};
  held["state"]["buttons"] = {{"a", true}, {"b", true}, {"c", true}};
  json all = {{"inverse3", json::array()}, {"wireless_verse_grip", json::array({grip})}};
  if (lists_ours && ours_first) all["inverse3"].push_back(device);
  all["inverse3"].push_back(other);
  if (lists_ours && !ours_first) all["inverse3"].push_back(device);
  if (other_grip) all["verse_grip"] = json::array({held});
  if (other_grip) all["wireless_verse_grip"] = json::array({held, grip});
  if (change) change(all);
  return all.dump();
}

void HaplyService::obey(const std::string& text) {
  const json message = json::parse(text);
  if (!message.contains("inverse3")) return;
  const json& device = message["inverse3"][0];
  if (device["device_id"] != "049D") return void(++told_others);
  if (device.contains("configure")) {
    const json& wanted = device["configure"];
    if (wanted.contains("damping")) damping = wanted["damping"]["scalar"].get<double>();
    if (wanted.contains("force_gate")) gate = wanted["force_gate"]["gain"].get<double>();
  }
  if (!device.contains("commands")) return;
  const json& values = device["commands"]["set_cursor_force"]["values"];
  const std::lock_guard lock(mutex_);
  force_n_ = {values["y"], values["z"], values["x"]};
}

void HaplyService::talk(Connection& connection) {
  auto& socket = connection.socket;
  const int handle = socket.next_layer().native_handle();
  socket.next_layer().set_option(tcp::no_delay(true));
  socket.control_callback([&](websocket::frame_type, boost::beast::string_view said) {
    connection.read_bytes += frame_bytes(said.size());
  });
  socket.accept();
  connection.read_bytes = bytes_received(handle);
  socket.auto_fragment(true);
  socket.write_buffer_bytes(64);
  socket.text(true);
  socket.write(boost::asio::buffer(state(true)));
  while (!stop_ && trouble_ != test::Trouble::kNoAnswer) {
    if (trouble_ == test::Trouble::kSilent) {
      // It does not read its messages either, but it does notice the end of the connection.
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      char room[65536];
      const ssize_t got = recv(handle, room, sizeof room, MSG_DONTWAIT);
      if (got == 0) return;
      continue;
    }
    if (!connection.read()) continue;
    const std::string text = boost::beast::buffers_to_string(connection.buffer.data());
    connection.ours = connection.ours || text.find("049D") != std::string::npos;
    obey(text);
    ++messages;
    std::this_thread::sleep_for(std::chrono::microseconds(answer_time_us));
    const std::uint64_t waiting = bytes_received(handle) - connection.read_bytes;
    most_waiting_bytes = std::max(most_waiting_bytes.load(), waiting);
    answer(connection);
  }
}

void HaplyService::answer(Connection& connection) {
  auto& socket = connection.socket;
  if (messages % 10 == 0) socket.ping({});
  std::string answer = state(false);
  if (messages % cut == 0) answer.resize(answer.size() / 2);
  socket.write(boost::asio::buffer(answer));
  if (unasked > 0 && messages % unasked == 0) socket.write(boost::asio::buffer(state(false)));
}

void HaplyService::serve() {
  tcp::acceptor& acceptor = listener_->acceptor;
  while (!stop_) {
    if (!readable(acceptor.native_handle(), 2)) continue;
    Connection connection(*listener_);
    if (connection.error) continue;  // taken by another of our threads
    try {
      talk(connection);
    } catch (const boost::system::system_error&) {  // the client has gone
    }
    const std::lock_guard lock(mutex_);
    if (connection.ours) force_n_ = {};
  }
}

std::unique_ptr<Bench> haply_bench() {
  return std::make_unique<HaplyService>();
}

}  // namespace stylet::hal
