// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/mesh_text.h"

#include <charconv>

namespace stylet::offline {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";
// With more unreadable points than this, the file is not a damaged mesh but another kind of file.
constexpr std::size_t kMaxBadPoints = 10'000;

// 32 bits can count all points: read_file accepts 4 GiB, and a point takes at least 2 bytes.
void add_checked(Collector& collector, Vec point, std::string place, std::string value) {
  if (!finite(point)) {
    if (collector.bad_points.size() >= kMaxBadPoints) {
      refuse("{}: {}: {}: expected finite coordinates (more than {} points have none)",
             collector.file, place, value, kMaxBadPoints);
    }
    collector.bad_points.push_back({static_cast<std::uint32_t>(collector.mesh.points.size()),
                                    std::move(place), std::move(value)});
  }
  collector.mesh.points.push_back(point);
}

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

std::string_view token_across_lines(Lines& lines, const char* expected) {
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
                             std::int64_t high, const char* expected) {
  std::int64_t value = 0;
  if (!parse_integer(token, value) || value < low || value > high) {
    refuse_at(lines, token, fmt::format("{} from {} to {}", expected, low, high));
  }
  return value;
}

void refuse_at(const Lines& lines, std::string_view value, std::string_view expected) {
  refuse("{}:{}: {}: expected {}", lines.file, lines.number, shown(value), expected);
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

void add_point(Collector& collector, const std::string_view (&tokens)[3], std::uint64_t line) {
  const Vec point{parse_number(tokens[0]), parse_number(tokens[1]), parse_number(tokens[2])};
  std::string place;
  std::string value;
  if (!finite(point)) {
    const std::size_t axis = std::isnan(point.x) ? 0 : std::isnan(point.y) ? 1 : 2;
    place = fmt::format("{}", line);
    value = shown(tokens[axis]);
  }
  add_checked(collector, point, std::move(place), std::move(value));
}

void add_point(Collector& collector, Vec point, std::string place) {
  add_checked(
      collector, point, std::move(place),
      finite(point) ? std::string() : fmt::format("({}, {}, {})", point.x, point.y, point.z));
}

void add_polygon(Collector& collector, const std::vector<std::uint32_t>& corners) {
  if (corners.size() < 3) {
    ++collector.counts.short_faces;
    return;
  }
  if (corners.size() > 3) ++collector.counts.polygons;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    collector.mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

ReadMesh finish(Collector&& collector) {
  Mesh& mesh = collector.mesh;
  if (mesh.triangles.empty()) {
    refuse("{}: {} points, no usable face: expected faces with at least 3 corners", collector.file,
           mesh.points.size());
  }
  std::vector<bool> used(mesh.points.size(), false);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) used[corner] = true;
  }
  for (const Collector::BadPoint& bad : collector.bad_points) {
    if (used[bad.point]) {
      refuse("{}:{}: {}: expected finite numbers in a point that a face uses", collector.file,
             bad.place, bad.value);
    }
    ++collector.counts.unusable_points;
    mesh.points[bad.point] = {};
  }
  return {std::move(mesh), collector.counts, {}};
}

}  // namespace stylet::offline
