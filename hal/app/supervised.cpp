// SPDX-License-Identifier: Apache-2.0
#include "hal/app/supervised.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace stylet::app {
namespace {

constexpr int kTellsInWatchdog = 4;  // sd_watchdog_enabled(3) asks for two at least

std::string_view variable(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? "" : text;
}

long long number(std::string_view text) {
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

}  // namespace

Supervised::Supervised() : address_(variable("NOTIFY_SOCKET")) {
  // A path, or, with an @ in the place of its first byte, a name that no file has.
  const bool usable = address_.size() > 1 && (address_[0] == '/' || address_[0] == '@') &&
                      address_.size() < sizeof(sockaddr_un{}.sun_path);
  if (!usable) return;
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const std::string_view watched = variable("WATCHDOG_PID");
  if (watched.empty() || number(watched) == getpid()) {
    pause_ = std::chrono::microseconds(std::max(number(variable("WATCHDOG_USEC")), 0LL) /
                                       kTellsInWatchdog);
  }
}

Supervised::~Supervised() {
  if (socket_ >= 0) close(socket_);
}

void Supervised::alive() {
  const auto now = std::chrono::steady_clock::now();
  if (pause_.count() == 0 || now < next_) return;
  next_ = now + pause_;
  tell("WATCHDOG=1");
}

// What systemd does not take now, the next call tells again.
void Supervised::tell(const std::string& words) const {
  if (socket_ < 0) return;
  sockaddr_un to{};
  to.sun_family = AF_UNIX;
  std::memcpy(to.sun_path, address_.data(), address_.size());
  if (to.sun_path[0] == '@') to.sun_path[0] = '\0';
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
  (void)sendto(socket_, words.data(), words.size(), MSG_NOSIGNAL,
               reinterpret_cast<const sockaddr*>(&to), size);
}

}  // namespace stylet::app
