// SPDX-License-Identifier: Apache-2.0
// What systemd wants to know of a program that it runs as a service: that it is ready, and, where
// the unit has WatchdogSec, again and again that it lives. Without systemd nothing is done. The
// protocol is that of sd_notify(3): a datagram to the socket that NOTIFY_SOCKET names.
#pragma once

#include <chrono>
#include <string>

namespace stylet::app {

class Supervised {
 public:
  Supervised();  // reads the environment, and leaves it as it is
  ~Supervised();
  Supervised(const Supervised&) = delete;
  Supervised& operator=(const Supervised&) = delete;

  void ready() const { tell("READY=1"); }
  // Call it as often as you like: systemd is told at most four times in the unit's WatchdogSec.
  void alive();

 private:
  void tell(const std::string& words) const;

  int socket_ = -1;
  std::string address_;
  std::chrono::microseconds pause_{0};  // 0: nobody watches
  std::chrono::steady_clock::time_point next_;
};

}  // namespace stylet::app
