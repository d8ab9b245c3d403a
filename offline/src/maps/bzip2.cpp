// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/bzip2.h"

#include <bzlib.h>

#include <algorithm>
#include <utility>

#include "base/file.h"
#include "maps/readers.h"

namespace stylet::offline {
namespace {

// Unpacks the successive streams of a file, one block at a time.
class Unpacker {
 public:
  Unpacker(const std::string& path, std::string_view packed) : path_(path), packed_(packed) {}
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;
  ~Unpacker() { (void)BZ2_bzDecompressEnd(&stream_); }

  // Fills `block` as far as there are bytes; returns how many it filled.
  std::size_t fill(std::vector<char>& block) {
    std::size_t filled = 0;
    while (filled < block.size() && !(packed_.empty() && state_ == BZ_STREAM_END)) {
      if (state_ == BZ_STREAM_END) open();
      // The library counts in unsigned int; files may be larger.
      const auto offered = static_cast<unsigned>(std::min<std::size_t>(packed_.size(), kOffered));
      stream_.next_in = const_cast<char*>(packed_.data());
      stream_.avail_in = offered;
      stream_.next_out = block.data() + filled;
      stream_.avail_out = static_cast<unsigned>(block.size() - filled);
      if (state_ == BZ_OK) state_ = BZ2_bzDecompress(&stream_);
      const std::size_t made = block.size() - filled - stream_.avail_out;
      const std::size_t taken = offered - stream_.avail_in;
      packed_.remove_prefix(taken);
      filled += made;
      unpacked_ += made;
      const bool stuck = state_ == BZ_OK && made == 0 && taken == 0;
      if (stuck || (state_ != BZ_OK && state_ != BZ_STREAM_END)) {
        refuse("{}: ends or is damaged after {} unpacked bytes: expected whole bzip2 data", path_,
               unpacked_);
      }
    }
    return filled;
  }

 private:
  void open() {
    (void)BZ2_bzDecompressEnd(&stream_);
    stream_ = {};
    state_ = BZ2_bzDecompressInit(&stream_, 0, 0);
  }

  static constexpr std::size_t kOffered = std::size_t{1} << 30U;
  const std::string& path_;
  std::string_view packed_;
  bz_stream stream_{};
  int state_ = BZ_STREAM_END;
  std::uint64_t unpacked_ = 0;
};

// How many voxels have been read.
struct Voxels {
  const std::string& path;
  const Claim& claim;
  std::size_t wanted = 0, taken = 0;  // bytes
  std::set<std::uint16_t> different;
};

[[noreturn]] void refuse_bytes(const Voxels& voxels) {
  refuse(
      "{}: the header promises {} bytes of voxels: {} {} were unpacked, expected as many as "
      "promised",
      voxels.path, voxels.wanted, voxels.taken, voxels.taken > voxels.wanted ? "or more" : "bytes");
}

template <typename WithSign, typename WithoutSign>
void take(Voxels& voxels, const std::vector<char>& bytes, LabelMap& map) {
  const HeaderNumber& number = voxels.claim.number;
  const std::endian order = number.big_endian ? std::endian::big : std::endian::little;
  if (number.without_sign) {
    return take_labels<WithoutSign>(voxels.path, bytes, map, voxels.different, order);
  }
  take_labels<WithSign>(voxels.path, bytes, map, voxels.different, order);
}

void take_numbers(Voxels& voxels, const std::vector<char>& bytes, LabelMap& map) {
  const std::size_t each = voxels.claim.bytes_each;
  if (voxels.claim.number.real) {
    return each == 4 ? take<float, float>(voxels, bytes, map)
                     : take<double, double>(voxels, bytes, map);
  }
  if (each == 1) return take<std::int8_t, std::uint8_t>(voxels, bytes, map);
  if (each == 2) return take<std::int16_t, std::uint16_t>(voxels, bytes, map);
  if (each == 4) return take<std::int32_t, std::uint32_t>(voxels, bytes, map);
  take<std::int64_t, std::uint64_t>(voxels, bytes, map);
}

// What is left of a file without the lines before its packed bytes.
std::string_view behind_lines(const std::string& name, std::int64_t lines, std::string_view bytes) {
  for (std::int64_t i = 0; i < lines; ++i) {
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos) {
      refuse("{}: {} lines before the voxels: expected {}, the header's line skip", name, i, lines);
    }
    bytes.remove_prefix(end + 1);
  }
  return bytes;
}

void unpack(const std::string& name, std::string_view bytes, Voxels& voxels, LabelMap& map) {
  constexpr std::size_t kBlock = std::size_t{1} << 20U;  // a multiple of every type's size
  Unpacker unpacker(name, behind_lines(name, voxels.claim.line_skip, bytes));
  std::vector<char> block;
  // Lines are skipped in the file, bytes in what it unpacks to, as in teem.
  for (auto left = static_cast<std::size_t>(voxels.claim.byte_skip); left > 0;) {
    block.resize(std::min(kBlock, left));
    if (unpacker.fill(block) < block.size()) {
      refuse("{}: fewer than {} bytes were unpacked: expected more than the header's byte skip",
             name, voxels.claim.byte_skip);
    }
    left -= block.size();
  }
  for (std::size_t filled = 1; filled > 0;) {
    block.resize(std::min(kBlock, voxels.wanted - voxels.taken + 1));
    filled = unpacker.fill(block);
    block.resize(filled);
    voxels.taken += filled;
    if (voxels.taken > voxels.wanted || filled % voxels.claim.bytes_each != 0) {
      refuse_bytes(voxels);
    }
    take_numbers(voxels, block, map);
  }
}

// Layers times voxels. bzip2 data may unpack to a million times its size, so a file's size does not
// limit what it unpacks to.
std::size_t values_of(const std::string& path, const Claim& claim) {
  std::size_t values = 1;
  for (const std::uint64_t size : claim.sizes) {
    if (size > kMostMapVoxels || (values *= size) > kMostMapVoxels) {
      refuse("{}: encoding bzip2 with more than {} values: expected fewer values, or encoding gzip",
             path, kMostMapVoxels);
    }
  }
  return values;
}

// Puts the layers of each voxel side by side, wherever their axes are among the file's.
void put_layers_first(const Claim& claim, std::size_t layers, std::vector<std::uint16_t>& label) {
  const std::array<std::size_t, 3>& in_space = claim.frame.axes;
  if (in_space[0] + in_space.size() == claim.sizes.size()) return;
  std::vector<std::size_t> apart;  // neighbours along each axis, afterwards
  std::size_t of_layers = 1, of_voxels = layers;
  for (std::size_t axis = 0; axis < claim.sizes.size(); ++axis) {
    const bool is_layer = std::find(in_space.begin(), in_space.end(), axis) == in_space.end();
    std::size_t& next = is_layer ? of_layers : of_voxels;
    apart.push_back(next);
    next *= claim.sizes[axis];
  }
  std::vector<std::uint16_t> moved(label.size());
  for (std::size_t i = 0; i < label.size(); ++i) {
    std::size_t rest = i, to = 0;
    for (std::size_t axis = 0; axis < apart.size(); ++axis) {
      to += rest % claim.sizes[axis] * apart[axis];
      rest /= claim.sizes[axis];
    }
    moved[to] = label[i];
  }
  label = std::move(moved);
}

}  // namespace

std::size_t read_bzip2(const std::string& path, std::string_view bytes, const Claim& claim,
                       LabelMap& map) {
  constexpr auto kMostSkipped = static_cast<std::int64_t>(kMostMapVoxels);
  if (claim.byte_skip < 0 || claim.byte_skip > kMostSkipped) {
    refuse("{}: encoding bzip2: expected a byte skip from 0 to {}", path, kMostSkipped);
  }
  const std::size_t values = values_of(path, claim);
  for (std::size_t i = 0; i < 3; ++i) {
    map.size[i] = static_cast<std::uint32_t>(claim.sizes[claim.frame.axes[i]]);
  }
  Voxels voxels{path, claim, values * claim.bytes_each, 0, {}};
  if (claim.files.empty()) unpack(path, bytes.substr(bytes.size() - claim.behind), voxels, map);
  for (const std::filesystem::path& file : claim.files) {
    const std::filesystem::path beside = std::filesystem::path(path).parent_path() / file;
    unpack(beside.string(), read_file(beside), voxels, map);
  }
  if (voxels.taken < voxels.wanted) refuse_bytes(voxels);
  const std::size_t layers = values / (std::size_t{map.size[0]} * map.size[1] * map.size[2]);
  put_layers_first(claim, layers, map.label);
  return layers;
}

}  // namespace stylet::offline
