// SPDX-License-Identifier: GPL-3.0-or-later
// PLY 1.0, text and binary in either byte order, with any layout of elements and properties. Only
// x, y, z of "vertex" and the list vertex_indices (or vertex_index) of "face" are
// kept.
#include "meshes/bytes.h"
#include "meshes/lines.h"

namespace stylet::offline {
namespace {

enum class Kind { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

struct Property {
  std::string name;
  Kind kind = Kind::kFloat32;
  bool is_list = false;
  Kind count_kind = Kind::kUint8;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { kText, kLittle, kBig };

struct Header {
  Encoding encoding = Encoding::kText;
  std::vector<Element> elements;
};

Kind parse_kind(const Lines& lines, std::string_view token) {
  constexpr std::pair<std::string_view, Kind> kNames[] = {
      {"char", Kind::kInt8},      {"int8", Kind::kInt8},       {"uchar", Kind::kUint8},
      {"uint8", Kind::kUint8},    {"short", Kind::kInt16},     {"int16", Kind::kInt16},
      {"ushort", Kind::kUint16},  {"uint16", Kind::kUint16},   {"int", Kind::kInt32},
      {"int32", Kind::kInt32},    {"uint", Kind::kUint32},     {"uint32", Kind::kUint32},
      {"float", Kind::kFloat32},  {"float32", Kind::kFloat32}, {"double", Kind::kFloat64},
      {"float64", Kind::kFloat64}};
  for (const auto& [name, kind] : kNames) {
    if (token == name) return kind;
  }
  refuse_at(lines, token, "a type: char, uchar, short, ushort, int, uint, float or double");
}

Property parse_property(Lines& lines) {
  Property property;
  std::string_view type = next_token(lines);
  if (type == "list") {
    property.is_list = true;
    property.count_kind = parse_kind(lines, next_token(lines));
    if (property.count_kind >= Kind::kFloat32) refuse_at(lines, "list", "an integer as its count");
    type = next_token(lines);
  }
  property.kind = parse_kind(lines, type);
  property.name = next_token(lines);
  return property;
}

Encoding parse_encoding(Lines& lines) {
  const std::string_view token = next_token(lines);
  if (token == "ascii") return Encoding::kText;
  if (token == "binary_little_endian") return Encoding::kLittle;
  if (token == "binary_big_endian") return Encoding::kBig;
  refuse_at(lines, token, "ascii, binary_little_endian or binary_big_endian");
}

// Skips lines that do not begin with a keyword of the format: exporters put free text there.
Header read_header(Lines& lines) {
  Header header;
  if (!next_line(lines) || next_token(lines) != "ply") refuse_at(lines, "", "the word ply");
  while (next_line(lines)) {
    const std::string_view keyword = next_token(lines);
    if (keyword == "end_header") return header;
    if (keyword == "format") {
      header.encoding = parse_encoding(lines);
    } else if (keyword == "element") {
      const std::string name(next_token(lines));
      constexpr std::size_t kLeastRowBytes = 1;
      header.elements.push_back(
          {name,
           require_count(lines, next_token(lines), kLeastRowBytes, "a number of elements"),
           {}});
    } else if (keyword == "property") {
      if (header.elements.empty()) refuse_at(lines, keyword, "an element before its properties");
      header.elements.back().properties.push_back(parse_property(lines));
    }
  }
  refuse_at(lines, "end of file", "end_header");
}

constexpr std::string_view kMore = "more elements, as the header says";

// Reads the values after the header one by one, in any encoding.
struct Values {
  Lines lines;  // text
  Bytes bytes;  // binary
  bool is_text = true;
};

Place place_of(const Values& values) {
  return values.is_text ? place_of(values.lines) : place_of(values.bytes);
}

double next_binary(Bytes& bytes, Kind kind) {
  const auto number = [&bytes](auto of_type) {
    return static_cast<double>(next<decltype(of_type)>(bytes, kMore));
  };
  switch (kind) {
    case Kind::kInt8:
      return number(std::int8_t{});
    case Kind::kUint8:
      return number(std::uint8_t{});
    case Kind::kInt16:
      return number(std::int16_t{});
    case Kind::kUint16:
      return number(std::uint16_t{});
    case Kind::kInt32:
      return number(std::int32_t{});
    case Kind::kUint32:
      return number(std::uint32_t{});
    case Kind::kFloat32:
      return number(float{});
    case Kind::kFloat64:
      return number(double{});
  }
  return 0;
}

double next_value(Values& values, Kind kind) {
  if (!values.is_text) return next_binary(values.bytes, kind);
  return parse_number(token_across_lines(values.lines, kMore));
}

// A number from 0, of any type. Its place is that of its first byte, or the line where it was
// found.
std::int64_t next_integer(Values& values, Kind kind, std::int64_t high, std::string_view expected) {
  const Place start = place_of(values);
  const double value = next_value(values, kind);
  if (!(value >= 0 && value <= static_cast<double>(high)) || value != std::floor(value)) {
    refuse_at(values.is_text ? place_of(values) : start, fmt::format("{}", value),
              fmt::format("{} from 0 to {}", expected, high));
  }
  return static_cast<std::int64_t>(value);
}

// A number of values, each of which takes at least one byte.
std::int64_t next_length(Values& values, const Property& property, std::string_view expected) {
  return next_integer(values, property.count_kind,
                      static_cast<std::int64_t>(values.lines.text.size()), expected);
}

void skip(Values& values, const Property& property) {
  const std::int64_t count = property.is_list ? next_length(values, property, "a list length") : 1;
  for (std::int64_t i = 0; i < count; ++i) (void)next_value(values, property.kind);
}

void read_points(Values& values, const Element& element, Collector& collector) {
  for (std::size_t row = 0; row < element.count; ++row) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    double xyz[3] = {kNone, kNone, kNone};
    const Place start = place_of(values);
    for (const Property& property : element.properties) {
      if (!property.is_list && property.name.size() == 1 && property.name[0] >= 'x' &&
          property.name[0] <= 'z') {
        xyz[property.name[0] - 'x'] = next_value(values, property.kind);
      } else {
        skip(values, property);
      }
    }
    const Vec point{xyz[0], xyz[1], xyz[2]};
    add_point(collector, point, values.is_text ? place_of(values) : start);
  }
}

void read_faces(Values& values, const Element& element, std::size_t points, Collector& collector) {
  std::vector<std::uint32_t> corners;
  for (std::size_t row = 0; row < element.count; ++row) {
    for (const Property& property : element.properties) {
      if (!property.is_list ||
          (property.name != "vertex_indices" && property.name != "vertex_index")) {
        skip(values, property);
        continue;
      }
      const std::int64_t n = next_length(values, property, "a number of corners");
      corners.clear();
      for (std::int64_t i = 0; i < n; ++i) {
        corners.push_back(static_cast<std::uint32_t>(next_integer(
            values, property.kind, static_cast<std::int64_t>(points) - 1, "a point index")));
      }
      add_polygon(collector, corners, place_of(values));
    }
  }
}

}  // namespace

ReadMesh read_ply(std::string_view file, std::string_view bytes) {
  bytes = without_mark(bytes);
  Values values{.lines = {.text = bytes, .file = file}, .bytes = {.bytes = bytes, .file = file}};
  const Header header = read_header(values.lines);
  values.is_text = header.encoding == Encoding::kText;
  if (header.encoding == Encoding::kBig) values.bytes.order = std::endian::big;
  values.bytes.next = std::min(values.lines.next, bytes.size());
  values.lines.rest = {};
  std::size_t points = 0;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") points = element.count;
  }
  Collector collector{.file = file};
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    if (element.name == "vertex") {
      read_points(values, element, collector);
    } else if (element.name == "face") {
      read_faces(values, element, points, collector);
    } else {
      for (std::size_t row = 0; row < element.count; ++row) {
        for (const Property& property : element.properties) skip(values, property);
      }
    }
  }
  if (collector.mesh.points.size() != points) {
    refuse("{}: {} points without coordinates: expected properties x, y, z", file, points);
  }
  return finish(std::move(collector));
}

}  // namespace stylet::offline
