// SPDX-License-Identifier: GPL-3.0-or-later
// What the header of a label map claims, held against the bytes there are before a library believes
// it: libraries take memory for what a header says, and some never return from a wrong number.
// Promise: text of a header is refused with `file: header line N: ...` where it is not what its
// format allows; nothing is allocated for what is claimed.
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

namespace stylet::bake {

// Where the voxels lie in the patient's frame (LPS).
struct HeaderFrame {
  Vec origin_m;                    // centre of the first voxel
  std::array<Vec, 3> step_m;       // from a voxel to the next one along each index
  std::vector<std::string> notes;  // what the header leaves open, a sentence each
  bool space_last = true;          // layers and components come before the axes in space
};

// How a number of the voxels is stored.
struct HeaderNumber {
  bool real = false, without_sign = false, big_endian = false;
};

// What a header says of the voxels, and where they are.
struct Claim {
  std::vector<std::uint64_t> sizes;  // first axis fastest
  std::uint64_t bytes_each = 1;
  bool packed = false;                         // by deflate
  bool bzip2 = false;                          // by bzip2, which we unpack ourselves
  bool text = false;                           // numbers, with something between them
  bool commas = false;                         // which may be commas
  bool hex = false;                            // two digits a byte
  std::vector<std::filesystem::path> files;    // of the voxels; none: behind the header
  std::uint64_t behind = 0;                    // bytes after the header
  bool skips = false;                          // something in front of the voxels
  std::map<std::string, std::string> remarks;  // NRRD's KEY:=VALUE
  HeaderNumber number;                         // of voxels packed by bzip2, or of text
  HeaderFrame frame;
};

// Refuses a claim that cannot lie in so many bytes.
void require_held(const std::string& path, const Claim& claim, std::uint64_t held_bytes);

// Refuses voxels as they are, of which there are more than claimed: sizes that are wrong would
// shift all of them. Only of a claim that can be held.
void require_no_more(const std::string& path, const Claim& claim, std::uint64_t voxel_bytes);

// Both of a whole file; require_held is the caller's, who knows the files' sizes.
Claim nrrd_claim(const std::string& path, std::string_view bytes);
Claim meta_claim(const std::string& path, std::string_view bytes);

// ---- what the readers of headers share ----------------------------------------------------------

struct HeaderLine {
  std::string_view text;  // without its end
  std::size_t number = 0;
};

using HeaderFields = std::map<std::string, std::pair<std::string, HeaderLine>>;  // value, line

// maps/nrrd_frame.cpp, maps/meta_frame.cpp: read by ourselves, as ITK takes every unit for
// millimetres and no spacing for one, and turns left-anterior-superior the wrong way.
HeaderFrame nrrd_frame(const std::string& path, const HeaderFields& fields,
                       const std::vector<std::uint64_t>& sizes);
HeaderFrame meta_frame(const std::string& path, const HeaderFields& fields, std::size_t axes);

bool is_gzip(std::string_view bytes);
// What a gzip file holds, all its members, or as much of it as `most` bytes: a small file may hold
// a thousand times as much. The bytes as they are where they are none.
std::string inflated(const std::string& path, std::string_view bytes, std::size_t most);

// Takes the next line off `rest`; refuses control characters. False at the end.
bool next_line(const std::string& path, std::string_view& rest, HeaderLine& line);

std::string_view trimmed(std::string_view text);
std::string lower(std::string_view text);
// Whole numbers with blanks between them, each from `least` to `most`.
std::vector<std::int64_t> whole_numbers(const std::string& path, const HeaderLine& line,
                                        std::string_view text, std::int64_t least,
                                        std::int64_t most);
// So many numbers with blanks between them; also nan.
std::vector<double> real_numbers(const std::string& path, const HeaderLine& line,
                                 std::string_view text, std::size_t count);
// Of the files NAME with %d or %0Nd in it, from, to, step; as both formats have it.
std::vector<std::filesystem::path> numbered_files(const std::string& path, const HeaderLine& line,
                                                  std::string_view text);

}  // namespace stylet::bake
