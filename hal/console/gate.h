// SPDX-License-Identifier: Apache-2.0
// Who may ask for what: decides on one HTTP request, as a pure function.
//
// A page of another site that is open in the same browser must not reach the console. So the host
// in a request must be an address of this machine, never a name that somebody else may point here
// (DNS rebinding), and its origin, if any, must be the console itself. With a token, everything but
// the page itself needs it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace stylet::console {

struct GateConfig {
  std::string address = "127.0.0.1";  // to listen on
  std::uint16_t port = 0;
  std::string token;  // empty: no token is asked for
};

struct Request {
  std::string_view method, target;
  std::string_view host, origin;  // headers; empty: missing
};

enum class Place { kPage, kScript, kStyle, kOrgan, kMetrics, kSocket };

struct GateAnswer {
  unsigned status = 200;  // HTTP status
  const char* reason = "";
  Place place = Place::kPage;
};
GateAnswer judge(const GateConfig& config, const Request& request);

bool is_loopback(std::string_view address);
// Compares in a time that depends only on the lengths.
bool same_secret(std::string_view a, std::string_view b);
// 128 random bits from the system, in hexadecimal.
std::string new_token();

}  // namespace stylet::console
