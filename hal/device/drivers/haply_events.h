// SPDX-License-Identifier: Apache-2.0
// What Haply's service tells besides samples and forces: on a WebSocket of its own that is only
// read. A service without it works as well, but does not say why a device failed.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <memory>
#include <string>

namespace stylet::hal {

struct HaplyEvent {
  std::string name;       // such as "device-disconnected"
  std::string device_id;  // empty: of no device in particular
  std::string safety;     // such as "ebrake_triggered", if the name has it
  std::string message;    // for people
  bool warns = false;     // worse than a notice
};

class HaplyEvents {
 public:
  // Connects in a thread of its own, which calls `tell` for each event.
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
