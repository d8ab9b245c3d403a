// SPDX-License-Identifier: GPL-3.0-or-later
// Voxels that are packed or written as text, before a library takes them: libraries take a number
// that does not fit its type for another one, what is left of half a text from nowhere, and say
// nothing of what is too much.
// Promises: voxels pass that are as many as the header says, each a whole number of its type where
// they are text; all others are refused with the place. Memory does not grow with them; time is
// linear in the bytes and in what they unpack to, at most as many as the header says.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "maps/header.h"

namespace stylet::bake {

// Of a claim that can be held. `part`: the voxels of one file, in their order.
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

}  // namespace stylet::bake
