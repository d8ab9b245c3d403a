// SPDX-License-Identifier: GPL-3.0-or-later
// Checks voxels that are packed or written as text before a library reads them: libraries change a
// number that does not fit its type, fill up a text that ends early with arbitrary values, and
// ignore surplus data.
// Promises: voxels pass if there are exactly as many as the header says and if each number written
// as text fits its type; all others are refused with the place. Constant memory; time is
// linear in the bytes and in what they unpack to, which is at most what the header says.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "maps/header.h"

namespace stylet::offline {

// For a claim that require_held accepts. `part`: the voxels of one file; files come in order.
class WholeVoxels {
 public:
  WholeVoxels(const std::string& path, const Claim& claim);
  static bool concern(const Claim& claim);

  void add(const std::string& name, std::string_view part);
  void finish() const;

 private:
  void add_packed(const std::string& name, std::string_view part);
  void add_text(const std::string& name, std::string_view part);
  void add_hex(const std::string& name, std::string_view part);
  void check_number(const std::string& name, std::string_view word);
  [[noreturn]] void refuse_count(const char* there) const;

  const std::string& path_;
  const Claim& claim_;
  std::uint64_t claimed_ = 1, found_ = 0;  // bytes; numbers of text; digits of hex
};

}  // namespace stylet::offline
