// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <utility>

#include "maps/header.h"
#include "maps/readers.h"

namespace stylet::offline {
namespace {

std::string without_blanks(std::string_view text) {
  std::string out = lower(text);
  std::erase(out, ' ');
  return out;
}

// NRRD has several names for each type: int16, short, signed short int.
std::uint64_t bytes_of_type(const std::string& path, const std::string& type) {
  constexpr std::array<std::pair<std::string_view, std::uint64_t>, 10> kParts = {{{"char", 1},
                                                                                  {"int8", 1},
                                                                                  {"short", 2},
                                                                                  {"int16", 2},
                                                                                  {"longlong", 8},
                                                                                  {"int64", 8},
                                                                                  {"double", 8},
                                                                                  {"int32", 4},
                                                                                  {"float", 4},
                                                                                  {"int", 4}}};
  const std::string plain = without_blanks(type);
  for (const auto& [part, bytes] : kParts) {
    if (plain.find(part) != std::string::npos) return bytes;
  }
  refuse("{}: type: {}: expected whole or real numbers", path, type);
}

// The next line of a header, whose length is limited: for each line teem searches all lines before
// it, so 2 MB of keys take 6 s and 20 MB ten minutes. A segmentation of 3D Slicer has 9 to 12 lines
// and 450 bytes for each segment: 6000 lines and 220 kB for kMostLabels of them.
bool next_of_header(const std::string& path, std::string_view& rest, HeaderLine& line,
                    std::size_t& bytes) {
  constexpr std::size_t kMostLines = 16'384, kMostBytes = std::size_t{1} << 21U;
  const std::size_t before = rest.size();
  if (!next_line(path, rest, line)) return false;
  bytes += before - rest.size();
  if (line.number > kMostLines || bytes > kMostBytes) {
    refuse("{}: header line {}: {} bytes: expected a header of at most {} lines and {} bytes", path,
           line.number, bytes, kMostLines, kMostBytes);
  }
  return true;
}

// FIELD: VALUE and KEY:=VALUE up to an empty line; after LIST, the names of the data files.
HeaderFields read_fields(const std::string& path, std::string_view& rest, Claim& claim) {
  HeaderFields fields;
  HeaderLine line;
  std::size_t bytes = 0;
  (void)next_of_header(path, rest, line, bytes);
  if (!line.text.starts_with("NRRD000")) {
    refuse("{}: expected the header of an NRRD (NRRD0001 to NRRD0006)", path);
  }
  while (next_of_header(path, rest, line, bytes) && !line.text.empty()) {
    if (line.text.front() == '#') continue;
    const std::size_t colon = line.text.find(':');
    if (colon == std::string_view::npos) {
      refuse("{}: header line {}: expected FIELD: VALUE", path, line.number);
    }
    const std::string_view value = line.text.substr(colon + 1);
    if (value.starts_with('=')) {
      claim.remarks[std::string(line.text.substr(0, colon))] = value.substr(1);
      continue;
    }
    const std::string name = without_blanks(line.text.substr(0, colon));
    if (!fields.emplace(name, std::pair(std::string(trimmed(value)), line)).second) {
      refuse("{}: header line {}: {}: expected it once", path, line.number, name);
    }
    if (name != "datafile" || !lower(trimmed(value)).starts_with("list")) continue;
    while (next_of_header(path, rest, line, bytes) && !line.text.empty()) {
      claim.files.emplace_back(line.text);
    }
    break;
  }
  return fields;
}

const std::pair<std::string, HeaderLine>& field_of(const std::string& path,
                                                   const HeaderFields& fields, const char* name) {
  const auto found = fields.find(name);
  if (found == fields.end()) refuse("{}: expected the field {} in the header", path, name);
  return found->second;
}

void read_encoding(const std::string& path, const std::string& encoding, Claim& claim) {
  const std::string plain = lower(encoding);
  const auto is = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return plain == n; });
  };
  claim.packed = is({"gz", "gzip"});
  claim.bzip2 = is({"bz2", "bzip2"});
  claim.text = claim.commas = is({"ascii", "text", "txt"});
  claim.hex = is({"hex"});
  if (!claim.packed && !claim.bzip2 && !claim.text && !claim.hex && !is({"raw"})) {
    refuse("{}: encoding: {}: expected raw, gzip, bzip2, ascii or hex", path, encoding);
  }
}

// Reads the type's name in the format's table (real, signed or not) and, if needed, the byte order.
HeaderNumber read_number(const std::string& path, const HeaderFields& fields, const Claim& claim) {
  constexpr std::array<std::string_view, 10> kWhole = {"char",        "int8", "short", "shortint",
                                                       "int16",       "int",  "int32", "longlong",
                                                       "longlongint", "int64"};
  const std::string& type = field_of(path, fields, "type").first;
  const std::string plain = without_blanks(type);
  std::string_view length = plain;
  for (const std::string_view sign : {"unsigned", "signed", "u"}) {
    if (length == plain && plain.starts_with(sign)) length.remove_prefix(sign.size());
  }
  if (length.ends_with("_t")) length.remove_suffix(2);
  HeaderNumber number;
  number.real = plain == "float" || plain == "double";
  number.without_sign = plain.starts_with('u');
  if (!number.real && std::find(kWhole.begin(), kWhole.end(), length) == kWhole.end()) {
    refuse("{}: type: {}: expected whole or real numbers", path, type);
  }
  if (claim.text || claim.bytes_each == 1) return number;
  const auto& [endian, line] = field_of(path, fields, "endian");
  number.big_endian = lower(endian) == "big";
  if (!number.big_endian && lower(endian) != "little") {
    refuse("{}: header line {}: {}: expected little or big", path, line.number, line.text);
  }
  return number;
}

// Each file holds `dimension` axes, and is a slab of the slowest one if these are all.
void check_pieces(const std::string& path, const HeaderLine& line, std::int64_t dimension,
                  const Claim& claim) {
  const std::size_t files = claim.files.size();
  const auto axes = static_cast<std::size_t>(dimension);
  if (axes == claim.sizes.size()) {
    if (claim.sizes.back() % files == 0) return;
    refuse(
        "{}: header line {}: {} files of slabs: expected as many as divide the {} slices of "
        "the last axis",
        path, line.number, files, claim.sizes.back());
  }
  std::uint64_t pieces = 1;  // too many to be counted are too many files, too
  for (std::size_t axis = axes; axis < claim.sizes.size() && pieces <= files; ++axis) {
    pieces = claim.sizes[axis] > files ? files + 1 : pieces * claim.sizes[axis];
  }
  if (pieces == files) return;
  refuse("{}: header line {}: {} files: expected one for each piece of {} axes", path, line.number,
         files, axes);
}

// NAME FROM TO STEP [SUBDIM], LIST [SUBDIM] or one name; SUBDIM is how many axes each file holds.
void read_files(const std::string& path, const HeaderFields& fields, Claim& claim) {
  const auto given = fields.find("datafile");
  if (given == fields.end()) return;
  const auto& [value, line] = given->second;
  std::string_view dimension;
  NumberedFiles numbered;
  if (value.find('%') != std::string::npos) {
    numbered = numbered_files(path, line, value);
    claim.files = numbered.files;
    dimension = numbered.more;
  } else if (lower(value).starts_with("list")) {
    dimension = std::string_view(value).substr(4);
  } else {
    claim.files.emplace_back(value);
  }
  if (claim.files.empty()) {
    refuse("{}: header line {}: expected the names of data files", path, line.number);
  }
  const auto axes = whole_numbers(path, line, dimension, 1, std::ssize(claim.sizes));
  if (axes.size() > 1) refuse("{}: header line {}: expected one number", path, line.number);
  if (!axes.empty()) check_pieces(path, line, axes.front(), claim);
}

// How much before the voxels is to be skipped, from `least` on.
std::int64_t skip_of(const std::string& path, const HeaderFields& fields, const char* name,
                     std::int64_t least) {
  constexpr std::int64_t kMost = std::int64_t{1} << 32U;
  const auto given = fields.find(name);
  if (given == fields.end()) return 0;
  const auto& [value, line] = given->second;
  const auto skip = whole_numbers(path, line, value, least, kMost);
  if (skip.size() != 1) refuse("{}: header line {}: expected one number", path, line.number);
  return skip.front();
}

}  // namespace

Claim nrrd_claim(const std::string& path, std::string_view bytes) {
  constexpr std::int64_t kMostAxes = 16;  // NRRD_DIM_MAX
  Claim claim;
  std::string_view rest = bytes;
  const HeaderFields fields = read_fields(path, rest, claim);
  const auto& [dimension, dimension_line] = field_of(path, fields, "dimension");
  const auto axes = whole_numbers(path, dimension_line, dimension, 1, kMostAxes);
  const auto& [sizes, sizes_line] = field_of(path, fields, "sizes");
  for (const std::int64_t size : whole_numbers(path, sizes_line, sizes, 1, INT64_MAX)) {
    claim.sizes.push_back(static_cast<std::uint64_t>(size));
  }
  if (axes.size() != 1 || claim.sizes.size() != static_cast<std::size_t>(axes.front())) {
    refuse("{}: header line {}: {} sizes: expected as many as the dimension, {}", path,
           sizes_line.number, claim.sizes.size(), dimension);
  }
  claim.bytes_each = bytes_of_type(path, field_of(path, fields, "type").first);
  read_encoding(path, field_of(path, fields, "encoding").first, claim);
  read_files(path, fields, claim);
  claim.behind = rest.size();
  claim.line_skip = skip_of(path, fields, "lineskip", 0);
  claim.byte_skip = skip_of(path, fields, "byteskip", -1);
  claim.skips = claim.line_skip != 0 || claim.byte_skip != 0;
  claim.frame = nrrd_frame(path, fields, claim.sizes);
  if (claim.bzip2 || claim.text) claim.number = read_number(path, fields, claim);
  return claim;
}

}  // namespace stylet::offline
