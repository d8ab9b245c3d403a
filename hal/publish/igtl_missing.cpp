// SPDX-License-Identifier: Apache-2.0
// Built instead of igtl.cpp if the library is not installed.
#include "hal/publish/igtl.h"

namespace stylet::hal {

struct IgtlServer::Server {};

IgtlServer::IgtlServer(const IgtlConfig& /*config*/) {
  throw IgtlError(
      "OpenIGTLink: this program was built without it: install libopenigtlink-dev and build again");
}
IgtlServer::~IgtlServer() = default;
std::uint16_t IgtlServer::port() const {
  return 0;
}
void IgtlServer::post(std::span<const TickRecord> /*records*/) {}
IgtlCounters IgtlServer::counters() const {
  return {};
}

}  // namespace stylet::hal
