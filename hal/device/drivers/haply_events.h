// SPDX-License-Identifier: Apache-2.0
// What Haply's service tells beside the exchange of samples and forces: on a WebSocket of its own,
// that is only read. A service without it is as good, but silent about why.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <memory>
#include <string>

namespace stylet::hal {

struct HaplyEvent {
  std::string name;       // as "device-disconnected"
  std::string device_id;  // empty: of no device
  std::string safety;     // as "ebrake_triggered", where the name says so
  std::string message;    // for people
  bool warns = false;     // worse than a notice
};

class HaplyEvents {
 public:
  // Connects in a thread of its own, which calls `tell` for each.
  HaplyEvents(const boost::asio::ip::tcp::endpoint& endpoint,
              std::function<void(const HaplyEvent&)> tell);
  ~HaplyEvents();
  HaplyEvents(const HaplyEvents&) = delete;
  HaplyEvents& operator=(const HaplyEvents&) = delete;
  bool connected() const;

 private:
  struct Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace stylet::hal
