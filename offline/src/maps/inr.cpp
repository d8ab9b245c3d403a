// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Image_3.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <new>

#include "maps/header.h"
#include "maps/readers.h"

namespace stylet::offline {
namespace {

void take_words(const std::string& path, const _image& image, LabelMap& map) {
  const auto* first = static_cast<const char*>(image.data);
  const std::vector<char> bytes(first,
                                first + map.size[0] * map.size[1] * map.size[2] * image.wdim);
  std::set<std::uint16_t> different;
  const bool is_signed = image.sign == SGN_SIGNED, is_real = image.wordKind == WK_FLOAT;
  if (!is_real && image.wdim == 1) {
    if (is_signed) return take_labels<std::int8_t>(path, bytes, map, different);
    return take_labels<std::uint8_t>(path, bytes, map, different);
  }
  if (!is_real && image.wdim == 2) {
    if (is_signed) return take_labels<std::int16_t>(path, bytes, map, different);
    return take_labels<std::uint16_t>(path, bytes, map, different);
  }
  if (!is_real && image.wdim == 4) {
    if (is_signed) return take_labels<std::int32_t>(path, bytes, map, different);
    return take_labels<std::uint32_t>(path, bytes, map, different);
  }
  if (is_real && image.wdim == 4) return take_labels<float>(path, bytes, map, different);
  if (is_real && image.wdim == 8) return take_labels<double>(path, bytes, map, different);
  refuse("{}: voxels of {} bytes: expected 1, 2 or 4, or real numbers of 4 or 8", path, image.wdim);
}

struct Freed {
  void operator()(_image* image) const { _freeImage(image); }
};
using Image = std::unique_ptr<_image, Freed>;

Image opened(const std::string& path) {
  const Silence silence;
  return Image(_readImageHeader(path.c_str()));
}

// False: the file ends early or is damaged. CGAL gives no reason; without memory it says the same.
bool read_voxels(_image& image) {
  const Silence silence;
  errno = 0;
  const bool whole = _readImageData(&image) > 0;
  const bool memory_was_short = !whole && errno == ENOMEM;
  ImageIO_close(&image);
  if (memory_was_short) throw std::bad_alloc();
  return whole;
}

// Needed because CGAL takes a missing spacing as 1 and does not apply rotations.
void check_frame(const std::string& path, const HeaderFields& fields) {
  for (const char* name : {"VX", "VY", "VZ"}) {
    if (!fields.contains(name)) refuse("{}: expected {} in the header of an Inrimage", path, name);
  }
  for (const char* name : {"RX", "RY", "RZ"}) {
    const auto found = fields.find(name);
    if (found == fields.end()) continue;
    const auto& [value, line] = found->second;
    if (real_numbers(path, line, value, 1).front() == 0) continue;
    refuse(
        "{}: header line {}: {}: expected 0, as the format does not define what is rotated; "
        "resample the image first",
        path, line.number, line.text);
  }
}

// Checks the header: NAME=VALUE up to an empty line or a comment, no line longer than CGAL accepts.
// Only the header of a packed file is unpacked here; CGAL unpacks as much as the header claims.
void check_claim(const std::string& path, std::string_view bytes) {
  constexpr std::size_t kLongest = 255, kMostHeader = 64 * 1024;
  const std::string begin = inflated(path, bytes, kMostHeader);
  std::string_view rest = begin;
  HeaderLine line;
  if (!next_line(path, rest, line) || line.text != "#INRIMAGE-4#{") {
    refuse("{}: expected the header of an Inrimage (#INRIMAGE-4) with one value a voxel", path);
  }
  Claim claim;
  std::map<std::string, std::int64_t> fields = {
      {"XDIM", 0}, {"YDIM", 0}, {"ZDIM", 0}, {"VDIM", 0}, {"PIXSIZE", 0}};
  HeaderFields others;
  while (next_line(path, rest, line) && !line.text.empty() && line.text.front() != '#') {
    if (line.text.size() > kLongest) {
      refuse("{}: header line {}: expected at most {} characters", path, line.number, kLongest);
    }
    const std::size_t sign = line.text.find('=');
    const auto field = fields.find(std::string(line.text.substr(0, sign)));
    if (sign == std::string_view::npos) continue;
    std::string_view value = line.text.substr(sign + 1);
    if (field == fields.end()) {
      others.insert_or_assign(std::string(line.text.substr(0, sign)), std::pair(value, line));
      continue;
    }
    if (field->first == "PIXSIZE") value = value.substr(0, value.find(' '));
    const auto numbers = whole_numbers(path, line, value, 1, INT32_MAX);
    if (numbers.size() != 1 || field->second != 0) {
      refuse("{}: header line {}: {}: expected it once, and one number", path, line.number,
             field->first);
    }
    field->second = numbers.front();
  }
  for (const auto& [name, value] : fields) {
    if (value == 0) refuse("{}: expected {} in the header of an Inrimage", path, name);
    if (name.ends_with("DIM") && name != "VDIM")
      claim.sizes.push_back(static_cast<std::uint64_t>(value));
  }
  constexpr std::int64_t kBitsOfByte = 8;
  claim.bytes_each =
      static_cast<std::uint64_t>(std::max<std::int64_t>(1, fields["PIXSIZE"] / kBitsOfByte));
  const auto size = [&](const char* name) { return static_cast<std::size_t>(fields[name]); };
  require_map_size(path, {size("XDIM"), size("YDIM"), size("ZDIM")});
  claim.packed = is_gzip(bytes);
  require_held(path, claim, bytes.size());
  check_frame(path, others);
}

}  // namespace

LabelMap read_inr(const std::string& path, std::string_view bytes) {
  check_claim(path, bytes);
  constexpr double kMetresPerMm = 1e-3;
  const Image image = opened(path);
  if (!image || image->vdim != 1) {
    refuse("{}: expected the header of an Inrimage (#INRIMAGE-4) with one value a voxel", path);
  }
  require_map_size(path, {image->xdim, image->ydim, image->zdim});
  LabelMap map;
  map.size = {static_cast<std::uint32_t>(image->xdim), static_cast<std::uint32_t>(image->ydim),
              static_cast<std::uint32_t>(image->zdim)};
  map.step_m = {Vec{image->vx, 0, 0} * kMetresPerMm, Vec{0, image->vy, 0} * kMetresPerMm,
                Vec{0, 0, image->vz} * kMetresPerMm};
  map.origin_m = Vec{static_cast<double>(image->tx), static_cast<double>(image->ty),
                     static_cast<double>(image->tz)} *
                 kMetresPerMm;
  require_frame(path, map);
  map.notes = {fmt::format("{}: an Inrimage has no directions: {}", path, kAxesTaken)};
  if (!read_voxels(*image)) {
    refuse("{}: the voxels end early or are damaged: expected {} x {} x {} of {} bytes", path,
           map.size[0], map.size[1], map.size[2], image->wdim);
  }
  take_words(path, *image, map);
  return map;
}

}  // namespace stylet::offline
