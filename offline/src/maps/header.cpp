// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/header.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "maps/readers.h"

namespace stylet::offline {

namespace {

std::string sizes_of(const Claim& claim) {
  std::string sizes;
  for (const std::uint64_t size : claim.sizes) {
    sizes += fmt::format("{}{}", sizes.empty() ? "" : " x ", size);
  }
  return sizes;
}

}  // namespace

void require_held(const std::string& path, const Claim& claim, std::uint64_t held_bytes) {
  constexpr std::uint64_t kDeflateAtMost = 1032;  // zlib.net/zlib_tech.html
  const std::uint64_t most = held_bytes * (claim.packed ? kDeflateAtMost : 1) /
                             (claim.text ? 1 : claim.bytes_each) /  // at least one digit each
                             (claim.hex ? 2 : 1);
  std::uint64_t left = most;
  for (const std::uint64_t size : claim.sizes) left = size == 0 ? 0 : left / size;
  if (left > 0) return;
  refuse(
      "{}: the header promises {} voxels of {} bytes: {} bytes are there, expected more bytes or "
      "smaller sizes",
      path, sizes_of(claim), claim.bytes_each, held_bytes);
}

std::uint64_t skipped_bytes(const Claim& claim, std::string_view voxels) {
  std::size_t at = 0;
  for (std::int64_t line = 0; line < claim.line_skip; ++line) {
    at = voxels.find('\n', at);
    if (at == std::string_view::npos) return voxels.size();
    ++at;
  }
  return std::min<std::uint64_t>(at + static_cast<std::uint64_t>(claim.byte_skip), voxels.size());
}

void require_no_more(const std::string& path, const Claim& claim, std::uint64_t voxel_bytes) {
  const bool at_the_end = claim.byte_skip < 0;
  if (claim.packed || claim.text || claim.hex || at_the_end) return;
  std::uint64_t claimed = claim.bytes_each;
  for (const std::uint64_t size : claim.sizes) claimed *= size;
  if (voxel_bytes <= claimed) return;
  refuse(
      "{}: the header promises {} voxels of {} bytes: {} bytes of voxels are there, expected {} "
      "bytes, or larger sizes",
      path, sizes_of(claim), claim.bytes_each, voxel_bytes, claimed);
}

bool is_gzip(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

std::string inflated(const std::string& path, std::string_view bytes, std::size_t most) {
  constexpr std::size_t kBlock = std::size_t{1} << 20U;
  if (!is_gzip(bytes)) return std::string(bytes);
  std::string out;
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  constexpr int kGzip = 16 + MAX_WBITS;
  int state = inflateInit2(&stream, kGzip);
  while (out.size() < most && (state == Z_OK || (state == Z_STREAM_END && stream.avail_in > 0))) {
    if (state == Z_STREAM_END) state = inflateReset(&stream);
    const std::size_t filled = out.size(), room = std::min(kBlock, most - filled);
    out.resize(filled + room);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + filled);
    stream.avail_out = static_cast<uInt>(room);
    state = inflate(&stream, Z_NO_FLUSH);
    out.resize(filled + room - stream.avail_out);
  }
  (void)inflateEnd(&stream);
  if (state != Z_STREAM_END && out.size() < most) {
    refuse("{}: ends or is damaged after {} unpacked bytes: expected a whole gzip file", path,
           out.size());
  }
  return out;
}

bool next_line(const std::string& path, std::string_view& rest, HeaderLine& line) {
  if (rest.empty()) return false;
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  line.text = rest.substr(0, end);
  ++line.number;
  rest.remove_prefix(std::min(end + 1, rest.size()));
  if (line.text.ends_with('\r')) line.text.remove_suffix(1);
  const bool control = std::any_of(line.text.begin(), line.text.end(),
                                   [](unsigned char c) { return c < ' ' && c != '\t'; });
  if (control) {
    refuse("{}: header line {}: a control character: expected text", path, line.number);
  }
  return true;
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

std::vector<std::int64_t> whole_numbers(const std::string& path, const HeaderLine& line,
                                        std::string_view text, std::int64_t least,
                                        std::int64_t most) {
  std::vector<std::int64_t> numbers;
  for (std::string_view rest = trimmed(text); !rest.empty(); rest = trimmed(rest)) {
    const std::string_view word = rest.substr(0, std::min(rest.find_first_of(" \t"), rest.size()));
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || end != word.data() + word.size() || number < least ||
        number > most) {
      refuse("{}: header line {}: {}: expected whole numbers from {} to {}", path, line.number,
             line.text, least, most);
    }
    numbers.push_back(number);
    rest.remove_prefix(word.size());
  }
  return numbers;
}

std::vector<double> real_numbers(const std::string& path, const HeaderLine& line,
                                 std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (std::string_view rest = trimmed(text); !rest.empty(); rest = trimmed(rest)) {
    const std::string_view word = rest.substr(0, std::min(rest.find_first_of(" \t"), rest.size()));
    const std::string_view plain = word.substr(word.starts_with('+') ? 1 : 0);
    double number = 0;
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), number);
    if (error != std::errc{} || end != plain.data() + plain.size()) break;
    numbers.push_back(number);
    rest.remove_prefix(word.size());
    if (rest.empty() && numbers.size() == count) return numbers;
  }
  refuse("{}: header line {}: {}: expected {} numbers", path, line.number, line.text, count);
}

NumberedFiles numbered_files(const std::string& path, const HeaderLine& line,
                             std::string_view text) {
  constexpr std::int64_t kMostFiles = 65535;
  const auto next_word = [&text] {
    const std::string_view word = text.substr(0, std::min(text.find_first_of(" \t"), text.size()));
    text = trimmed(text.substr(word.size()));
    return word;
  };
  const std::string_view name = next_word();
  std::vector<std::int64_t> range;
  for (const std::int64_t least : {std::int64_t{0}, std::int64_t{0}, -kMostFiles}) {
    for (const std::int64_t number : whole_numbers(path, line, next_word(), least, kMostFiles)) {
      range.push_back(number);
    }
  }
  const std::size_t sign = name.find('%');
  std::size_t width = sign + 1;
  while (width < name.size() && std::isdigit(static_cast<unsigned char>(name[width])) != 0) ++width;
  const bool one =
      width < name.size() && name[width] == 'd' && name.find('%', width) == std::string_view::npos;
  const std::string_view digits = one ? name.substr(sign + 1, width - sign - 1) : "";
  std::uint32_t wide = 0;
  const auto error = std::from_chars(digits.begin(), digits.end(), wide).ec;
  // teem has room for ten digits besides the name, and writes on behind it.
  constexpr std::uint32_t kMostDigits = 10;
  const bool fits = error != std::errc::result_out_of_range && wide <= kMostDigits;
  if (!one || !fits || range.size() != 3 || range[2] == 0) {
    refuse(
        "{}: header line {}: expected a name with one %d or %0Nd, N at most {}, and from, to and "
        "step",
        path, line.number, kMostDigits);
  }
  NumberedFiles out = {{}, range[2], text};
  const auto is_within = [&](std::int64_t i) {
    return range[2] > 0 ? i <= range[1] : i >= range[1];
  };
  for (std::int64_t i = range[0]; is_within(i); i += range[2]) {
    const std::string number =
        digits.starts_with('0') ? fmt::format("{:0{}}", i, wide) : fmt::format("{:{}}", i, wide);
    out.files.emplace_back(std::string(name.substr(0, sign)) + number +
                           std::string(name.substr(width + 1)));
  }
  return out;
}

}  // namespace stylet::offline
