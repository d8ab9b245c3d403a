// SPDX-License-Identifier: Apache-2.0
// A client of the console without good manners: HTTP and WebSocket byte by byte over a plain
// socket, so that it can also send what no browser would. Every wait has a time limit.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "console_generated.h"

namespace stylet::console::test {

using Milliseconds = std::chrono::milliseconds;
constexpr Milliseconds kPatience{20000};

class Client {
 public:
  // `room`: bytes of the receive buffer, for what was sent and not read yet; 0: the system's own.
  explicit Client(std::uint16_t port, int room = 0)
      : port_(port), socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (room > 0) setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
    sockaddr_in to = {};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int yes = 1;
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  // False: the other side has closed.
  bool say(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }

  bool get(const std::string& target, const std::string& headers = "") {
    return say("GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) + "\r\n" +
               headers + "\r\n");
  }

  // Status and body of an answer to `get`; 0: none came.
  unsigned answer(std::string* body_out = nullptr) {
    while (heard_.find("\r\n\r\n") == std::string::npos) {
      if (!hear()) return 0;
    }
    const std::size_t head = heard_.find("\r\n\r\n") + 4;
    const auto status = static_cast<unsigned>(std::stoul(heard_.substr(9, 3)));
    std::size_t length = 0;
    if (const auto at = heard_.find("Content-Length: "); at != std::string::npos && at < head) {
      length = std::stoul(heard_.substr(at + 16));
    }
    while (heard_.size() < head + length) {
      if (!hear()) return 0;
    }
    if (body_out != nullptr) *body_out = heard_.substr(head, length);
    heard_.erase(0, head + length);
    return status;
  }

  unsigned join(const std::string& target = "/ws", const std::string& headers = "") {
    get(target,
        "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
            headers);
    return answer();
  }

  // A frame of a WebSocket; a browser masks it.
  bool say_frame(std::string_view payload, unsigned opcode = 2, bool masked = true) {
    std::string frame(1, static_cast<char>(0x80U | opcode));
    const unsigned mask_bit = masked ? 0x80U : 0;
    if (payload.size() < 126) {
      frame += static_cast<char>(mask_bit | payload.size());
    } else {
      frame += static_cast<char>(mask_bit | 127U);
      for (int shift = 56; shift >= 0; shift -= 8) {
        frame += static_cast<char>((payload.size() >> static_cast<unsigned>(shift)) & 0xFFU);
      }
    }
    if (masked) frame += std::string(4, '\0');  // a mask of zeros leaves the payload as it is
    return say(frame + std::string(payload));
  }

  bool say_message(const flatbuffers::DetachedBuffer& bytes) {
    return say_frame({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  // The next message of the server; none: it has closed, or nothing came in time. Pings are
  // answered.
  std::optional<std::string> next() {
    for (;;) {
      std::string payload;
      unsigned opcode = 0;
      if (!next_frame(opcode, payload)) return std::nullopt;
      if (opcode == 9) say_frame(payload, 10);
      if (opcode == 8) return std::nullopt;
      if (opcode == 2) return payload;
    }
  }

  // The next message of a kind. The bytes stay until the next call.
  template <typename T>
  const T* next_of(Body type, const std::function<bool(const T&)>& wanted = {}) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end) {
      std::optional<std::string> bytes = next();
      if (!bytes) return nullptr;
      message_ = std::move(*bytes);
      const auto* data = reinterpret_cast<const std::uint8_t*>(message_.data());
      flatbuffers::Verifier verifier(data, message_.size());
      EXPECT_TRUE(VerifyMessageBuffer(verifier));
      const Message& message = *GetMessage(data);
      if (message.body_type() != type) continue;
      const T* body = static_cast<const T*>(message.body());
      if (!wanted || wanted(*body)) return body;
    }
    return nullptr;
  }

  // Whether the other side closes the connection, whatever it sends before.
  bool closed(Milliseconds patience = kPatience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
      heard_.clear();
      if (!hear(patience)) return gone_;
    }
    return false;
  }

 private:
  bool hear(Milliseconds patience = kPatience) {
    pollfd one = {socket_, POLLIN, 0};
    if (::poll(&one, 1, static_cast<int>(patience.count())) <= 0) return false;
    std::array<char, 65536> bytes;
    const ssize_t count = ::recv(socket_, bytes.data(), bytes.size(), 0);
    gone_ = count <= 0;
    if (!gone_) heard_.append(bytes.data(), static_cast<std::size_t>(count));
    return !gone_;
  }

  bool have(std::size_t bytes) {
    while (heard_.size() < bytes) {
      if (!hear()) return false;
    }
    return true;
  }

  bool next_frame(unsigned& opcode, std::string& payload) {
    if (!have(2)) return false;
    opcode = static_cast<unsigned char>(heard_[0]) & 0x0FU;
    std::uint64_t length = static_cast<unsigned char>(heard_[1]) & 0x7FU;
    std::size_t head = 2;
    if (length >= 126) {
      const std::size_t digits = length == 126 ? 2 : 8;
      if (!have(head + digits)) return false;
      length = 0;
      for (std::size_t i = 0; i < digits; ++i) {
        length = length << 8U | static_cast<unsigned char>(heard_[head + i]);
      }
      head += digits;
    }
    if (!have(head + length)) return false;
    payload = heard_.substr(head, length);
    heard_.erase(0, head + length);
    return true;
  }

  std::uint16_t port_;
  int socket_;
  bool gone_ = false;
  std::string heard_, message_;
};

// A message of the page.
template <typename Make>
flatbuffers::DetachedBuffer page_message(Body type, Make make) {
  flatbuffers::FlatBufferBuilder builder;
  const auto body = make(builder);
  FinishMessageBuffer(builder, CreateMessage(builder, type, body.Union()));
  return builder.Release();
}

}  // namespace stylet::console::test
