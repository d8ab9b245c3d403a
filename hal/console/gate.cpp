// SPDX-License-Identifier: Apache-2.0
#include "hal/console/gate.h"

#include <sys/random.h>

#include <array>
#include <boost/asio/ip/address.hpp>
#include <cstdio>
#include <optional>
#include <stdexcept>

namespace stylet::console {
namespace {

struct Known {
  std::string_view path;
  Place place;
  bool open;  // without the token
};
constexpr std::array kKnown = {
    Known{"/", Place::kPage, true},
    Known{"/app.js", Place::kScript, true},
    Known{"/app.css", Place::kStyle, true},
    Known{"/organ", Place::kOrgan, false},
    Known{"/metrics", Place::kMetrics, false},
    Known{"/ws", Place::kSocket, false},
};

const Known* find_place(std::string_view path) {
  for (const Known& each : kKnown) {
    if (each.path == path) return &each;
  }
  return nullptr;
}

// Parses "127.0.0.1:7760" and "[::1]:7760"; a missing port means 80, which is never ours.
struct HostName {
  std::string_view name, port;
};
std::optional<HostName> split_host(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  if (colon == std::string_view::npos) return std::nullopt;
  HostName out = {host.substr(0, colon), host.substr(colon + 1)};
  if (out.name.starts_with('[') && out.name.ends_with(']')) {
    out.name = out.name.substr(1, out.name.size() - 2);
  } else if (out.name.find(':') != std::string_view::npos) {
    return std::nullopt;
  }
  return out;
}

bool host_good(const GateConfig& config, std::string_view host) {
  const std::optional<HostName> parts = split_host(host);
  if (!parts || parts->port != std::to_string(config.port)) return false;
  if (parts->name == "localhost" || is_loopback(parts->name)) return true;
  if (is_loopback(config.address)) return false;
  boost::system::error_code error;
  (void)boost::asio::ip::make_address(std::string(parts->name), error);
  return !error;
}

std::string_view token_of(std::string_view query) {
  constexpr std::string_view kName = "token=";
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view each = query.substr(0, end);
    if (each.starts_with(kName)) return each.substr(kName.size());
    if (end == std::string_view::npos) break;
    query.remove_prefix(end + 1);
  }
  return {};
}

}  // namespace

bool is_loopback(std::string_view address) {
  boost::system::error_code error;
  const auto parsed = boost::asio::ip::make_address(std::string(address), error);
  return !error && parsed.is_loopback();
}

bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    different |=
        static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  }
  return different == 0;
}

std::string new_token() {
  std::array<unsigned char, 16> bytes;
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the system gave no random numbers for a token");
  }
  std::string text;
  for (const unsigned char each : bytes) {
    std::array<char, 3> digits;
    std::snprintf(digits.data(), digits.size(), "%02x", static_cast<unsigned>(each));
    text += digits.data();
  }
  return text;
}

GateAnswer judge(const GateConfig& config, const Request& request) {
  if (!host_good(config, request.host)) {
    return {403, "the Host of the request is not the console's address and port"};
  }
  if (!request.origin.empty() && request.origin != "http://" + std::string(request.host)) {
    return {403, "the Origin of the request is not the console itself"};
  }
  if (request.method != "GET") return {405, "only GET requests are answered"};
  const std::size_t mark = request.target.find('?');
  const Known* known = find_place(request.target.substr(0, mark));
  if (known == nullptr) return {404, "there is nothing at this address"};
  const std::string_view query =
      mark == std::string_view::npos ? std::string_view{} : request.target.substr(mark + 1);
  if (!known->open && !config.token.empty() && !same_secret(token_of(query), config.token)) {
    return {401, "the token is missing or wrong: use the address that the console printed"};
  }
  return {200, "", known->place};
}

}  // namespace stylet::console
