// SPDX-License-Identifier: GPL-3.0-or-later
// What the header of a label map claims, held against the bytes there are before a library believes
// it: libraries take memory for what a header says, and some never return from a wrong number.
// Promise: text of a header is refused with `file: header line N: ...` where it is not what its
// format allows; nothing is allocated for what is claimed.
// Sources: NRRD, teem.sourceforge.net/nrrd/format.html; MetaImage, the documentation of MetaIO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stylet::bake {

// What a header says of the voxels, and where they are.
struct Claim {
  std::vector<std::uint64_t> sizes;  // first axis fastest
  std::uint64_t bytes_each = 1;
  bool packed = false;                         // by deflate
  bool text = false;                           // numbers, with something between them
  std::vector<std::filesystem::path> files;    // of the voxels; none: behind the header
  std::map<std::string, std::string> remarks;  // NRRD's KEY:=VALUE
};

// Refuses a claim that cannot lie in so many bytes.
void require_held(const std::string& path, const Claim& claim, std::uint64_t held_bytes);

// Both of a whole file; require_held is the caller's, who knows the files' sizes.
Claim nrrd_claim(const std::string& path, std::string_view bytes);
Claim meta_claim(const std::string& path, std::string_view bytes);

// ---- what the readers of headers share ----------------------------------------------------------

struct HeaderLine {
  std::string_view text;  // without its end
  std::size_t number = 0;
};

// All members of a gzip file; the bytes as they are where they are none.
std::string inflated(const std::string& path, std::string_view bytes);

// Takes the next line off `rest`; refuses control characters. False at the end.
bool next_line(const std::string& path, std::string_view& rest, HeaderLine& line);

std::string_view trimmed(std::string_view text);
std::string lower(std::string_view text);
// Whole numbers with blanks between them, each from `least` to `most`.
std::vector<std::int64_t> whole_numbers(const std::string& path, const HeaderLine& line,
                                        std::string_view text, std::int64_t least,
                                        std::int64_t most);
// Of the files NAME with %d or %0Nd in it, from, to, step; as both formats have it.
std::vector<std::filesystem::path> numbered_files(const std::string& path, const HeaderLine& line,
                                                  std::string_view text);

}  // namespace stylet::bake
