// SPDX-License-Identifier: GPL-3.0-or-later
// OFF and its variants with colours and normals (COFF, NOFF, STOFF, ...): a point's line begins
// with three coordinates, a face's line with its corner indices; the rest of the line is skipped.
// Comments start with '#'.
// The counts may follow the keyword on its line, even without a blank ("OFF8 6 12").
#include "meshes/lines.h"

namespace stylet::offline {
namespace {

// Moves the cursor to the number of points.
void read_keyword(Lines& lines) {
  const std::string_view token = token_across_lines(lines, "the keyword OFF");
  const std::size_t at = token.find("OFF");
  const bool known = at != std::string_view::npos && token.substr(0, at) != "n" &&
                     token.substr(0, at).find_first_not_of("STCN") == std::string_view::npos;
  if (!known) refuse_at(lines, token, "the keyword OFF, COFF, NOFF or STOFF");
  const std::size_t glued = token.size() - (at + 3);
  lines.rest = std::string_view(lines.rest.data() - glued, lines.rest.size() + glued);
}

}  // namespace

ReadMesh read_off(std::string_view file, std::string_view bytes) {
  Lines lines{.text = without_mark(bytes), .file = file, .comment = '#'};
  Collector collector{.file = file};
  read_keyword(lines);
  const auto count = [&](std::string_view what) {
    constexpr std::size_t kLeastBytes = 2;  // of a point, a face or a corner
    return require_count(lines, token_across_lines(lines, what), kLeastBytes, what);
  };
  const std::size_t points = count("a number of points");
  const std::size_t faces = count("a number of faces");
  lines.rest = {};
  for (std::size_t i = 0; i < points; ++i) {
    const std::string_view x = token_across_lines(lines, "a coordinate");
    const std::string_view y = token_across_lines(lines, "a coordinate");
    const std::string_view z = token_across_lines(lines, "a coordinate");
    add_point(collector, {x, y, z}, place_of(lines));
    lines.rest = {};
  }
  std::vector<std::uint32_t> corners;
  const auto last_point = static_cast<std::int64_t>(points) - 1;
  for (std::size_t i = 0; i < faces; ++i) {
    const std::size_t n = count("a number of corners");
    corners.clear();
    for (std::size_t corner = 0; corner < n; ++corner) {
      const std::string_view token = token_across_lines(lines, "a point index");
      corners.push_back(static_cast<std::uint32_t>(
          require_integer(lines, token, 0, last_point, "a point index")));
    }
    lines.rest = {};
    add_polygon(collector, corners, place_of(lines));
  }
  return finish(std::move(collector));
}

}  // namespace stylet::offline
