// SPDX-License-Identifier: Apache-2.0
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "service_bench.h"

namespace stylet::hal {

Spacenavd::Spacenavd(bool old_version)
    : old_(old_version), path_("/tmp/stylet-spnav-" + std::to_string(getpid())) {
  setenv("SPNAV_SOCKET", path_.c_str(), 1);
  unlink(path_.c_str());
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
  listener_ = socket(AF_UNIX, SOCK_STREAM, 0);
  EXPECT_EQ(bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(listen(listener_, 1), 0);
  thread_ = std::thread([this] { serve(); });
}

Spacenavd::~Spacenavd() {
  stop_ = true;
  thread_.join();
  close(listener_);
  unlink(path_.c_str());
}

void Spacenavd::send(const std::array<std::int32_t, 8>& packet) {
  const auto* bytes = reinterpret_cast<const char*>(packet.data());
  (void)::send(socket_, bytes, 13, MSG_NOSIGNAL);
  std::this_thread::sleep_for(std::chrono::microseconds(100));
  (void)::send(socket_, bytes + 13, sizeof packet - 13, MSG_NOSIGNAL);
}

void Spacenavd::press(std::uint32_t mask) {
  const std::lock_guard lock(mutex_);
  buttons_ = mask;
}

void Spacenavd::deflect(const std::array<int, 6>& deflection) {
  const std::lock_guard lock(mutex_);
  deflection_ = deflection;
}

void Spacenavd::unplug() {
  const std::lock_guard lock(mutex_);
  send({3, 1});
}

void Spacenavd::serve() {
  std::uint32_t told = 0;
  while (!stop_) {
    if (socket_ < 0 || trouble_ == test::Trouble::kNoAnswer) {
      if (socket_ >= 0) close(socket_.exchange(-1));
      pollfd wanted = {listener_, POLLIN, 0};
      if (::poll(&wanted, 1, 2) <= 0) continue;
      socket_ = accept(listener_, nullptr, nullptr);
      if (trouble_ == test::Trouble::kNoAnswer) continue;  // the connection is closed at once
      std::int32_t greeting = 0;
      EXPECT_EQ(recv(socket_, &greeting, sizeof greeting, MSG_WAITALL), 4);
      EXPECT_EQ(greeting, 0x7faa5501);
      if (!old_) (void)::send(socket_, &greeting, sizeof greeting, MSG_NOSIGNAL);
      told = 0;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    char byte;
    if (recv(socket_, &byte, 1, MSG_DONTWAIT) == 0) {
      close(socket_.exchange(-1));
      continue;
    }
    const std::lock_guard lock(mutex_);
    const auto& d = deflection_;
    if (d != std::array<int, 6>{}) send({0, d[0], d[1], d[2], d[3], d[4], d[5], 8});
    for (int i = 0; i < 32; ++i) {
      const std::uint32_t bit = 1U << i;
      if (((told ^ buttons_) & bit) != 0) send({(buttons_ & bit) != 0 ? 1 : 2, i});
    }
    told = buttons_;
  }
  if (socket_ >= 0) close(socket_);
}

std::unique_ptr<Bench> spacemouse_bench() {
  auto bench = std::make_unique<Spacenavd>();
  bench->places = bench->feels = kNoAxis;
  bench->turns = false;
  return bench;
}

}  // namespace stylet::hal
