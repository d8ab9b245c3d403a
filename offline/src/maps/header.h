// SPDX-License-Identifier: GPL-3.0-or-later
// Compares what the header of a label map claims with the bytes of the file before a library reads
// it: libraries allocate what a header claims, and some never return after a wrong number.
// Promise: header text that its format does not allow is refused with `file: header line N: ...`;
// no memory is allocated according to a claim.
// Sources: NRRD, teem.sourceforge.net/nrrd/format.html; MetaImage, the documentation of MetaIO.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/geometry.h"

namespace stylet::offline {

// Position of the voxels in the patient's frame (LPS).
struct HeaderFrame {
  Vec origin_m;                    // centre of the first voxel
  std::array<Vec, 3> step_m;       // from a voxel to the next one along each index
  std::vector<std::string> notes;  // what the header leaves open, one sentence for each
  std::array<std::size_t, 3> axes = {0, 1, 2};  // which of the file's lie in space
};

// How the number of a voxel is stored.
struct HeaderNumber {
  bool real = false, without_sign = false, big_endian = false;
};

// What a header says about the voxels, and where they are.
struct Claim {
  std::vector<std::uint64_t> sizes;  // first axis fastest
  std::uint64_t bytes_each = 1;
  bool packed = false;                         // by deflate
  bool bzip2 = false;                          // by bzip2, which we unpack ourselves
  bool text = false;                           // numbers as text, with separators
  bool commas = false;                         // separators may be commas
  bool hex = false;                            // two digits a byte
  std::vector<std::filesystem::path> files;    // with the voxels; empty: they follow the header
  std::uint64_t behind = 0;                    // bytes after the header
  bool skips = false;                          // other bytes precede the voxels of each file:
  std::int64_t line_skip = 0, byte_skip = 0;   // so many; bytes -1: all but the voxels
  std::map<std::string, std::string> remarks;  // NRRD's KEY:=VALUE
  HeaderNumber number;                         // of voxels packed by bzip2, or of text
  HeaderFrame frame;
};

// Refuses a claim that does not fit into `held_bytes`.
void require_held(const std::string& path, const Claim& claim, std::uint64_t held_bytes);

// How many bytes of `voxels` a claim's skips leave out before the voxels; all of them, if there are
// not so many.
std::uint64_t skipped_bytes(const Claim& claim, std::string_view voxels);

// Refuses unpacked voxels if there are more than claimed: wrong sizes would shift all of them. Only
// for a claim that require_held has accepted. `voxel_bytes`: without what is skipped.
void require_no_more(const std::string& path, const Claim& claim, std::uint64_t voxel_bytes);

// `bytes` are the whole file. The caller calls require_held, since it knows the files' sizes.
Claim nrrd_claim(const std::string& path, std::string_view bytes);
Claim meta_claim(const std::string& path, std::string_view bytes);

// ---- what the readers of headers share ----------------------------------------------------------

struct HeaderLine {
  std::string_view text;  // without its end
  std::size_t number = 0;
};

using HeaderFields = std::map<std::string, std::pair<std::string, HeaderLine>>;  // value, line

// maps/nrrd_frame.cpp, maps/meta_frame.cpp. Not left to ITK, which takes every unit for
// millimetres, a missing spacing for 1, and turns left-anterior-superior the wrong way.
HeaderFrame nrrd_frame(const std::string& path, const HeaderFields& fields,
                       const std::vector<std::uint64_t>& sizes);
HeaderFrame meta_frame(const std::string& path, const HeaderFields& fields, std::size_t axes);

bool is_gzip(std::string_view bytes);
// The content of a gzip file, all members, but at most `most` bytes of it: a small file may unpack
// to a thousand times its size. Bytes that are not gzip are returned unchanged.
std::string inflated(const std::string& path, std::string_view bytes, std::size_t most);

// Removes the next line from `rest`; refuses control characters. False at the end.
bool next_line(const std::string& path, std::string_view& rest, HeaderLine& line);

std::string_view trimmed(std::string_view text);
std::string lower(std::string_view text);
// Whole numbers with blanks between them, each from `least` to `most`.
std::vector<std::int64_t> whole_numbers(const std::string& path, const HeaderLine& line,
                                        std::string_view text, std::int64_t least,
                                        std::int64_t most);
// `count` numbers with blanks between them; "nan" is allowed.
std::vector<double> real_numbers(const std::string& path, const HeaderLine& line,
                                 std::string_view text, std::size_t count);
// The files of a text "NAME FROM TO STEP", where NAME has %d or %0Nd, N up to 10; both formats
// allow this.
struct NumberedFiles {
  std::vector<std::filesystem::path> files;
  std::int64_t step = 0;
  std::string_view more;  // of the text, behind the step
};
NumberedFiles numbered_files(const std::string& path, const HeaderLine& line,
                             std::string_view text);

}  // namespace stylet::offline
