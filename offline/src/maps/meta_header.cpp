// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <utility>

#include "maps/header.h"
#include "maps/readers.h"

namespace stylet::offline {
namespace {

// Keys whose values MetaIO reads number by number. Values of all other keys it copies as text, even
// if they consist of digits.
bool is_list(std::string_view key) {
  constexpr std::string_view kLists[] = {
      "DimSize",  "ElementSpacing",  "ElementSize", "Offset",      "Origin",
      "Position", "TransformMatrix", "Rotation",    "Orientation", "CenterOfRotation"};
  return std::find(std::begin(kLists), std::end(kLists), key) != std::end(kLists);
}

// KEY = VALUE up to ElementDataFile, which is the last. MetaIO also accepts a colon for "=".
HeaderFields read_fields(const std::string& path, std::string_view& rest) {
  constexpr std::size_t kLongest = 250;       // MetaIO's texts are fields of 255 characters
  constexpr std::size_t kLongestList = 4000;  // and its lists of 4096
  HeaderFields fields;
  HeaderLine line;
  while (next_line(path, rest, line)) {
    const std::size_t sign = line.text.find_first_of("=:");
    if (trimmed(line.text).empty()) continue;
    if (sign == std::string_view::npos || sign > kLongest) {
      refuse("{}: header line {}: expected KEY = VALUE", path, line.number);
    }
    const std::string key(trimmed(line.text.substr(0, sign)));
    const std::string value(trimmed(line.text.substr(sign + 1)));
    const std::size_t longest = is_list(key) ? kLongestList : kLongest;
    if (value.size() > longest) {
      refuse("{}: header line {}: {}: {} characters: expected at most {}", path, line.number, key,
             value.size(), longest);
    }
    if (!fields.emplace(key, std::pair(value, line)).second) {
      refuse("{}: header line {}: {}: expected it once", path, line.number, key);
    }
    if (key == "ElementDataFile") return fields;
  }
  refuse("{}: expected ElementDataFile in the header of a MetaImage", path);
}

// The single number of a key; `otherwise` if the key is missing.
std::int64_t number_of(const std::string& path, const HeaderFields& fields, const char* key,
                       std::int64_t least, std::int64_t most, std::int64_t otherwise) {
  const auto found = fields.find(key);
  if (found == fields.end()) return otherwise;
  const auto& [value, line] = found->second;
  const auto numbers = whole_numbers(path, line, value, least, most);
  if (numbers.size() != 1) refuse("{}: header line {}: expected one number", path, line.number);
  return numbers.front();
}

bool is_true(const HeaderFields& fields, const char* key, bool otherwise) {
  const auto found = fields.find(key);
  if (found == fields.end() || found->second.first.empty()) return otherwise;
  return std::string_view("Tt1").find(found->second.first.front()) != std::string_view::npos;
}

std::uint64_t bytes_of_type(const std::string& path, const HeaderFields& fields) {
  constexpr std::array<std::pair<std::string_view, std::uint64_t>, 12> kTypes = {
      {{"MET_CHAR", 1},
       {"MET_UCHAR", 1},
       {"MET_SHORT", 2},
       {"MET_USHORT", 2},
       {"MET_INT", 4},
       {"MET_UINT", 4},
       {"MET_LONG", 4},
       {"MET_ULONG", 4},
       {"MET_LONG_LONG", 8},
       {"MET_ULONG_LONG", 8},
       {"MET_FLOAT", 4},
       {"MET_DOUBLE", 8}}};
  const auto found = fields.find("ElementType");
  const std::string type = found == fields.end() ? "" : found->second.first;
  for (const auto& [name, bytes] : kTypes) {
    if (type == name) return bytes;
  }
  refuse("{}: ElementType '{}': expected MET_UCHAR or another whole or real number", path, type);
}

void read_files(const std::string& path, const HeaderFields& fields, std::string_view rest,
                Claim& claim) {
  auto [value, line] = fields.at("ElementDataFile");
  if (lower(value) == "local") return;
  if (value.starts_with("LIST")) {
    const auto axes = whole_numbers(path, line, value.substr(4), 1, INT32_MAX);
    if (axes.size() > 1 || (!axes.empty() && axes.front() >= std::ssize(claim.sizes))) {
      // MetaIO reads nothing of a file that holds all axes.
      refuse("{}: header line {}: {}: expected LIST and a file for each slice, or one file's name",
             path, line.number, line.text);
    }
    while (next_line(path, rest, line)) {
      if (!trimmed(line.text).empty()) claim.files.emplace_back(trimmed(line.text));
    }
  } else if (value.find('%') != std::string::npos) {
    const NumberedFiles numbered = numbered_files(path, line, value);
    if (numbered.step < 0 || !numbered.more.empty()) {
      refuse("{}: header line {}: {}: expected from, to and a step upwards", path, line.number,
             line.text);
    }
    claim.files = numbered.files;
  } else {
    claim.files.emplace_back(value);
  }
  if (claim.files.empty() || value.empty()) {
    refuse("{}: header line {}: expected LOCAL or the names of data files", path, line.number);
  }
}

// ITK ignores how values are to be scaled; so only stored values that are the labels are accepted.
void check_values(const std::string& path, const HeaderFields& fields) {
  constexpr std::array<std::pair<const char*, double>, 2> kPlain = {
      {{"ElementToIntensityFunctionSlope", 1}, {"ElementToIntensityFunctionOffset", 0}}};
  for (const auto& [key, plain] : kPlain) {
    const auto found = fields.find(key);
    if (found == fields.end()) continue;
    const auto& [value, line] = found->second;
    if (real_numbers(path, line, value, 1).front() == plain) continue;
    refuse("{}: header line {}: {}: expected {}, as labels are numbers as they are stored", path,
           line.number, line.text, plain);
  }
}

}  // namespace

Claim meta_claim(const std::string& path, std::string_view bytes) {
  constexpr std::int64_t kMostAxes = 10;  // the size of MetaIO's arrays
  Claim claim;
  std::string_view rest = bytes;
  const HeaderFields fields = read_fields(path, rest);
  const std::int64_t axes = number_of(path, fields, "NDims", 1, kMostAxes, 0);
  const auto sizes = fields.find("DimSize");
  if (axes == 0 || sizes == fields.end()) {
    refuse("{}: expected NDims and DimSize in the header of a MetaImage", path);
  }
  for (const std::int64_t size :
       whole_numbers(path, sizes->second.second, sizes->second.first, 1, INT32_MAX)) {
    claim.sizes.push_back(static_cast<std::uint64_t>(size));
  }
  if (claim.sizes.size() != static_cast<std::size_t>(axes)) {
    refuse("{}: header line {}: {} sizes: expected as many as NDims, {}", path,
           sizes->second.second.number, claim.sizes.size(), axes);
  }
  if (number_of(path, fields, "ElementNumberOfChannels", 1, INT32_MAX, 1) != 1) {
    refuse("{}: several values a voxel: expected labels, which have one value a voxel", path);
  }
  claim.bytes_each = bytes_of_type(path, fields);
  const std::string& type = fields.at("ElementType").first;
  claim.number.real = type == "MET_FLOAT" || type == "MET_DOUBLE";
  claim.number.without_sign = type.starts_with("MET_U");
  claim.packed = is_true(fields, "CompressedData", false);
  claim.text = !claim.packed && !is_true(fields, "BinaryData", true);
  read_files(path, fields, rest, claim);
  const auto held = static_cast<std::int64_t>(bytes.size());
  claim.behind = rest.size();
  claim.byte_skip = number_of(path, fields, "HeaderSize", -1, INT32_MAX, 0);
  claim.skips = claim.byte_skip != 0;
  if (claim.files.empty()) {
    const auto packed = number_of(path, fields, "CompressedDataSize", 0, held, 0);
    if (claim.packed && packed == 0) {  // else MetaIO reads nothing
      refuse("{}: packed voxels: expected CompressedDataSize = {}, the bytes after the header",
             path, rest.size());
    }
  }
  check_values(path, fields);
  claim.frame = meta_frame(path, fields, claim.sizes.size());
  return claim;
}

}  // namespace stylet::offline
