// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/lines.h"

#include <charconv>

namespace stylet::offline {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

}  // namespace

std::string_view without_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (bytes.starts_with(kMark)) bytes.remove_prefix(kMark.size());
  return bytes;
}

bool next_line(Lines& lines) {
  if (lines.next >= lines.text.size()) {
    lines.rest = {};
    return false;
  }
  const std::size_t end = std::min(lines.text.find('\n', lines.next), lines.text.size());
  lines.rest = lines.text.substr(lines.next, end - lines.next);
  lines.next = end + 1;
  ++lines.number;
  if (lines.comment != '\0') lines.rest = lines.rest.substr(0, lines.rest.find(lines.comment));
  return true;
}

std::string_view next_token(Lines& lines) {
  const std::size_t start = std::min(lines.rest.find_first_not_of(kBlank), lines.rest.size());
  lines.rest.remove_prefix(start);
  const std::size_t end = std::min(lines.rest.find_first_of(kBlank), lines.rest.size());
  const std::string_view token = lines.rest.substr(0, end);
  lines.rest.remove_prefix(end);
  return token;
}

std::string_view token_across_lines(Lines& lines, std::string_view expected) {
  for (;;) {
    const std::string_view token = next_token(lines);
    if (!token.empty()) return token;
    if (!next_line(lines)) refuse_at(lines, "end of file", expected);
  }
}

double parse_number(std::string_view token) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc{} || end != token.data() + token.size() || !std::isfinite(value)) {
    return kNone;
  }
  return value;
}

bool parse_integer(std::string_view token, std::int64_t& value_out) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value_out);
  return error == std::errc{} && end == token.data() + token.size();
}

std::int64_t require_integer(const Lines& lines, std::string_view token, std::int64_t low,
                             std::int64_t high, std::string_view expected) {
  std::int64_t value = 0;
  if (!parse_integer(token, value) || value < low || value > high) {
    refuse_at(lines, token, fmt::format("{} from {} to {}", expected, low, high));
  }
  return value;
}

std::size_t require_count(const Lines& lines, std::string_view token, std::size_t bytes_each,
                          std::string_view what) {
  std::int64_t count = 0;
  if (!parse_integer(token, count)) count = -1;
  return require_room(place_of(lines), shown(token), count, {lines.text.size(), bytes_each}, what);
}

Place place_of(const Lines& lines) {
  return {lines.file, Place::Kind::kLine, lines.number};
}

void refuse_at(const Lines& lines, std::string_view value, std::string_view expected) {
  refuse_at(place_of(lines), shown(value), expected);
}

std::string shown(std::string_view token) {
  constexpr std::size_t kLongest = 40;
  std::string text(token.substr(0, kLongest));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  if (token.size() > kLongest) text += "...";
  return text.empty() ? "nothing" : "'" + text + "'";
}

void add_point(Collector& collector, const std::string_view (&tokens)[3], const Place& place) {
  const Vec point{parse_number(tokens[0]), parse_number(tokens[1]), parse_number(tokens[2])};
  if (finite(point)) return add_point(collector, point, place);
  const std::size_t axis = std::isnan(point.x) ? 0 : std::isnan(point.y) ? 1 : 2;
  add_point(collector, point, place, shown(tokens[axis]));
}

}  // namespace stylet::offline
