// SPDX-License-Identifier: Apache-2.0
// Every backend that renders force, each with its stand-in, for tests of the whole chain in virtual
// time.
#pragma once

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "device_bench.h"
#include "hal/device/drivers/haply.h"
#include "hal/device/link.h"

namespace stylet::hal {

// Who has the motors.
enum class Motors {
  kLibrary,  // the vendor's, in this process; orders must be renewed
  kService,  // the vendor's; it drops the force of a client that has gone
  kPeer,     // a program that keeps the rules of packets.md
  kStation,  // a station with a vendor's device of its own
};
struct Backend {
  const char* name;  // its driver's scheme
  Motors motors = Motors::kLibrary;
  MakeBench bench = nullptr;                        // the vendor's stand-in
  bool may_refuse_watchdog = false;                 // of a library: some devices have no watchdog
  const char* uri = nullptr;                        // of a peer, without the port
  Link (*link)(const std::string& port) = nullptr;  // the peer's end of the link
  bool may_hang = true;                             // of a library: a call of it may not return
};
inline Link by_network(const std::string& port) {
  return udp_connect("127.0.0.1:" + port);
}
inline Link by_memory(const std::string& port) {
  return shared_memory("motor" + port, Side::kDevice);
}
constexpr const char* kByNetwork = "udp:127.0.0.1:";
constexpr Backend kBackends[] = {
    {"hd", Motors::kLibrary, hd_bench},
    {"dhd", Motors::kLibrary, dhd_bench, true},
    {"haply", Motors::kService, haply_bench},
    {"udp", Motors::kPeer, nullptr, false, kByNetwork, by_network},
    {"shm", Motors::kPeer, nullptr, false, "shm:motor", by_memory},
};
constexpr Backend kStation = {"station", Motors::kStation, hd_bench, false, kByNetwork, by_network};
inline void PrintTo(const Backend& backend, std::ostream* out) {
  *out << backend.name;
}

// Backends of all drivers that render force, and a station. Drivers that are not in the list above
// have no motors.
inline std::vector<Backend> all_backends() {
  std::vector<Backend> found;
  for (const DriverDescriptor* driver : drivers_with_haply()) {
    if (!driver->renders) continue;
    const auto* known =
        std::find_if(std::begin(kBackends), std::end(kBackends),
                     [&](const Backend& each) { return std::string(each.name) == driver->scheme; });
    found.push_back(known != std::end(kBackends) ? *known : Backend{driver->scheme});
  }
  found.push_back(kStation);
  return found;
}

}  // namespace stylet::hal
