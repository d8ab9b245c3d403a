// SPDX-License-Identifier: GPL-3.0-or-later
// STL, text and binary. A file is binary if its size agrees with the count in a binary header; the
// word "solid" does not tell, since many binary files begin with it, too.
#include <cctype>

#include "meshes/bytes.h"
#include "meshes/lines.h"

namespace stylet::offline {
namespace {

constexpr std::size_t kTitleBytes = 80;
constexpr std::size_t kHeaderBytes = kTitleBytes + sizeof(std::uint32_t);
constexpr std::size_t kFacetBytes = 50;
constexpr std::size_t kNormalBytes = 12;
constexpr std::size_t kAttributeBytes = 2;

std::string lower(std::string_view token) {
  std::string text(token.substr(0, 16));
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_text(std::string_view bytes) {
  if (bytes.size() >= kHeaderBytes) {
    const auto claimed = number_at<std::uint32_t>(bytes, kTitleBytes, std::endian::little);
    if (bytes.size() == kHeaderBytes + kFacetBytes * std::size_t{claimed}) return false;
  }
  bytes = without_mark(bytes);
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  constexpr std::size_t kProbe = 512;
  return start != std::string_view::npos && lower(bytes.substr(start, 5)) == "solid" &&
         bytes.substr(0, kProbe).find('\0') == std::string_view::npos;
}

// The number of triangles. Bytes after them may be padding; more triangles than claimed are
// refused.
std::size_t read_claimed(Bytes& in) {
  const Place place = place_of(in);
  const std::size_t claimed = next_count<std::uint32_t>(in, kFacetBytes, "a number of triangles");
  const std::string_view rest = in.bytes.substr(in.next + claimed * kFacetBytes);
  if (rest.size() >= kFacetBytes && rest.find_first_not_of('\0') != std::string_view::npos) {
    refuse_at(
        place, fmt::format("{}", claimed),
        fmt::format("{} triangles, which {} bytes hold", left(in) / kFacetBytes, in.bytes.size()));
  }
  return claimed;
}

ReadMesh read_binary(std::string_view file, std::string_view bytes) {
  if (bytes.size() < kHeaderBytes) {
    refuse("{}: {} bytes: expected the word solid, or at least {} bytes of a binary STL", file,
           bytes.size(), kHeaderBytes);
  }
  constexpr std::string_view kMore = "another triangle";
  Bytes in{.bytes = bytes, .file = file, .next = kTitleBytes};
  const std::size_t claimed = read_claimed(in);
  Collector collector{.file = file};
  collector.mesh.points.reserve(claimed * 3);
  for (std::size_t i = 0; i < claimed; ++i) {
    const Place place = place_of(in);
    const auto first = static_cast<std::uint32_t>(collector.mesh.points.size());
    skip_bytes(in, kNormalBytes, kMore);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Place start = place_of(in);
      const auto coordinate = [&] { return static_cast<double>(next<float>(in, kMore)); };
      add_point(collector, Vec{coordinate(), coordinate(), coordinate()}, start);
    }
    skip_bytes(in, kAttributeBytes, kMore);
    add_polygon(collector, std::array{first, first + 1, first + 2}, place);
  }
  return finish(std::move(collector));
}

// After "solid" comes a name of any words, up to the end of the line, or up to the first facet if
// the whole file is one line.
void skip_name(Lines& lines) {
  while (true) {
    const Lines here = lines;
    const std::string_view token = next_token(lines);
    if (token.empty()) return;
    const Lines behind = lines;
    if (lower(token) == "facet" && lower(next_token(lines)) == "normal") {
      lines = here;
      return;
    }
    lines = behind;
  }
}

// The name after "endsolid" goes up to the end of the line or the next solid.
void skip_end_name(Lines& lines) {
  while (true) {
    const Lines here = lines;
    const std::string_view token = next_token(lines);
    if (token.empty()) return;
    if (lower(token) != "solid") continue;
    lines = here;
    return;
  }
}

ReadMesh read_text(std::string_view file, std::string_view bytes) {
  Lines lines{.text = bytes, .file = file};
  Collector collector{.file = file};
  std::vector<std::uint32_t> corners;
  while (true) {
    const std::string_view token = next_token(lines);
    if (token.empty()) {
      if (next_line(lines)) continue;
      break;
    }
    const std::string keyword = lower(token);
    if (keyword == "vertex") {
      const std::string_view x = next_token(lines), y = next_token(lines), z = next_token(lines);
      corners.push_back(static_cast<std::uint32_t>(collector.mesh.points.size()));
      add_point(collector, {x, y, z}, place_of(lines));
    } else if (keyword == "endloop") {
      add_polygon(collector, corners, place_of(lines));
      corners.clear();
    } else if (keyword == "normal") {
      for (int axis = 0; axis < 3; ++axis) (void)next_token(lines);
    } else if (keyword == "solid") {
      skip_name(lines);
    } else if (keyword == "endsolid") {
      skip_end_name(lines);
    } else if (keyword != "facet" && keyword != "outer" && keyword != "loop" &&
               keyword != "endfacet") {
      refuse_at(lines, token, "solid, facet, outer loop, vertex, endloop, endfacet or endsolid");
    }
  }
  if (!corners.empty()) refuse_at(lines, "end of file", "endloop");
  return finish(std::move(collector));
}

}  // namespace

ReadMesh read_stl(std::string_view file, std::string_view bytes) {
  return is_text(bytes) ? read_text(file, without_mark(bytes)) : read_binary(file, bytes);
}

}  // namespace stylet::offline
