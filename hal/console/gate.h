// SPDX-License-Identifier: Apache-2.0
// Who may ask for what: the decision about one HTTP request, as a pure function.
//
// A page of another site that is open in the same browser must not reach the console: the host a
// request names is an address of this machine, never a name somebody else may point here (DNS
// rebinding), and its origin, where it has one, is the console itself. With a token, everything but
// the page itself needs it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace stylet::console {

struct GateConfig {
  std::string address = "127.0.0.1";  // that is listened on
  std::uint16_t port = 0;
  std::string token;  // empty: none is asked for
};

struct Request {
  std::string_view method, target;
  std::string_view host, origin;  // headers, empty: none
};

enum class Place { kPage, kScript, kStyle, kOrgan, kMetrics, kSocket };

struct Verdict {
  unsigned status = 200;  // of HTTP
  const char* reason = "";
  Place place = Place::kPage;
};
Verdict judge(const GateConfig& config, const Request& request);

bool is_loopback(std::string_view address);
// In a time that depends on the lengths alone.
bool same_secret(std::string_view a, std::string_view b);
// 128 bits of the system's, in hexadecimal.
std::string new_token();

}  // namespace stylet::console
