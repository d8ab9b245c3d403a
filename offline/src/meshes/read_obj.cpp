// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront OBJ: v and f are read, l and p are counted, everything else (vt, vn, groups, materials,
// curves) is skipped. A backslash at the end of a line continues it.
#include "meshes/lines.h"

namespace stylet::offline {
namespace {

// The next logical line: continued lines are joined in `joined`; tokens then point into it.
bool next_logical_line(Lines& lines, std::string& joined) {
  const auto continued = [&] {
    while (!lines.rest.empty() && lines.rest.back() == '\r') lines.rest.remove_suffix(1);
    return !lines.rest.empty() && lines.rest.back() == '\\';
  };
  if (!next_line(lines)) return false;
  if (!continued()) return true;
  joined.clear();
  do {
    joined += lines.rest.substr(0, lines.rest.size() - 1);
    joined += ' ';
  } while (next_line(lines) && continued());
  joined += lines.rest;
  lines.rest = joined;
  return true;
}

// "7", "7/1", "7//3", "-1/2/3": only the point is used. Indices count from 1; negative indices
// count back from the last point read.
std::uint32_t parse_corner(const Lines& lines, std::string_view token, std::size_t points) {
  const std::string_view digits = token.substr(0, token.find('/'));
  constexpr std::int64_t kMost = 0xFFFFFFFE;
  std::int64_t index = 0;
  if (!parse_integer(digits, index) || index == 0 || index > kMost ||
      index < -static_cast<std::int64_t>(points)) {
    refuse_at(lines, token, fmt::format("a point index from 1, or from -1 back to -{}", points));
  }
  return static_cast<std::uint32_t>(index > 0 ? index - 1
                                              : index + static_cast<std::int64_t>(points));
}

}  // namespace

ReadMesh read_obj(std::string_view file, std::string_view bytes) {
  Lines lines{.text = without_mark(bytes), .file = file, .comment = '#'};
  Collector collector{.file = file, .first_index = 1};
  std::string joined;
  std::vector<std::uint32_t> corners;
  while (next_logical_line(lines, joined)) {
    const std::string_view keyword = next_token(lines);
    if (keyword == "v") {
      const std::string_view x = next_token(lines), y = next_token(lines), z = next_token(lines);
      add_point(collector, {x, y, z}, place_of(lines));
    } else if (keyword == "f") {
      corners.clear();
      for (std::string_view t = next_token(lines); !t.empty(); t = next_token(lines)) {
        corners.push_back(parse_corner(lines, t, collector.mesh.points.size()));
      }
      add_polygon(collector, corners, place_of(lines));
    } else if (keyword == "l" || keyword == "p") {
      ++collector.counts.lines_and_points;
    }
  }
  return finish(std::move(collector));
}

}  // namespace stylet::offline
