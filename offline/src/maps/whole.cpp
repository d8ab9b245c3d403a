// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/whole.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/refusal.h"

namespace stylet::offline {
namespace {

// Separators of numbers; only NRRD also has commas.
constexpr std::string_view kBlanks = " \t\r\n\v\f";

double largest_of(const Claim& claim) {
  const auto bits = static_cast<int>(8 * claim.bytes_each) - (claim.number.without_sign ? 0 : 1);
  return claim.number.real ? std::ldexp(1.0, 127) : std::ldexp(1.0, bits) - 1;
}

}  // namespace

WholeVoxels::WholeVoxels(const std::string& path, const Claim& claim) : path_(path), claim_(claim) {
  if (claim.skips) {
    refuse(
        "{}: voxels as text, but the header says to skip something before them: expected nothing "
        "to skip",
        path);
  }
  for (const std::uint64_t size : claim.sizes) claimed_ *= size;
  if (claim.packed) claimed_ *= claim.bytes_each;
  if (claim.hex) claimed_ *= 2 * claim.bytes_each;
}

bool WholeVoxels::concern(const Claim& claim) {
  return claim.text || claim.hex || (claim.packed && !claim.skips);
}

void WholeVoxels::add(const std::string& name, std::string_view part) {
  if (claim_.packed) return add_packed(name, part);
  if (claim_.hex) return add_hex(name, part);
  add_text(name, part);
}

void WholeVoxels::finish() const {
  if (found_ < claimed_) refuse_count("");
}

void WholeVoxels::refuse_count(const char* there) const {
  refuse("{}: the header promises {} {} of voxels: {}{} are there, expected as many as promised",
         path_, claimed_,
         claim_.packed ? "bytes"
         : claim_.hex  ? "digits"
                       : "numbers",
         found_, there);
}

void WholeVoxels::add_packed(const std::string& name, std::string_view part) {
  constexpr int kEither = 32 + MAX_WBITS;  // gzip or zlib
  constexpr std::size_t kOffered = std::size_t{1} << 30U;
  std::array<Bytef, 1U << 16U> room;
  z_stream stream{};
  int state = inflateInit2(&stream, kEither);
  while (found_ <= claimed_ && (state == Z_OK || (state == Z_STREAM_END && !part.empty()))) {
    if (state == Z_STREAM_END) state = inflateReset(&stream);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));
    const auto offered = static_cast<uInt>(std::min(part.size(), kOffered));
    stream.avail_in = offered;
    stream.next_out = room.data();
    stream.avail_out = static_cast<uInt>(room.size());
    state = inflate(&stream, Z_NO_FLUSH);
    part.remove_prefix(offered - stream.avail_in);
    found_ += room.size() - stream.avail_out;
  }
  (void)inflateEnd(&stream);
  if (found_ > claimed_) refuse_count(" or more");
  if (state == Z_STREAM_END) return;
  refuse("{}: ends or is damaged after {} unpacked bytes: expected whole packed voxels", name,
         found_);
}

void WholeVoxels::add_text(const std::string& name, std::string_view part) {
  const std::string between = std::string(kBlanks) + (claim_.commas ? "," : "");
  for (std::size_t at = part.find_first_not_of(between); at != std::string_view::npos;
       at = part.find_first_not_of(between, at)) {
    const std::size_t end = std::min(part.find_first_of(between, at), part.size());
    check_number(name, part.substr(at, end - at));
    at = end;
    if (++found_ > claimed_) refuse_count(" or more");
  }
}

void WholeVoxels::check_number(const std::string& name, std::string_view word) {
  double number = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_number = error == std::errc{} && end == word.data() + word.size();
  // Libraries read only the digits of a whole number.
  const bool spelled =
      claim_.number.real || word.find_first_not_of("0123456789") == std::string_view::npos;
  if (is_number && spelled && number >= 0 && number <= largest_of(claim_)) return;
  constexpr std::size_t kShown = 40;
  refuse("{}: voxel {}: {}: expected a number from 0 to {:g}, as the header's type has it", name,
         found_, word.substr(0, kShown), largest_of(claim_));
}

void WholeVoxels::add_hex(const std::string& name, std::string_view part) {
  for (const char c : part) {
    if (kBlanks.find(c) != std::string_view::npos) continue;
    if (std::string_view("0123456789abcdefABCDEF").find(c) == std::string_view::npos) {
      refuse("{}: digit {} of the voxels: expected 0 to 9 or a to f", name, found_);
    }
    if (++found_ > claimed_) refuse_count(" or more");
  }
}

}  // namespace stylet::offline
