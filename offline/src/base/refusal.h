// SPDX-License-Identifier: GPL-3.0-or-later
// The only way in which a stage refuses: one line for the user that names the file, the place, the
// value and what was expected. The program prints it and ends with exit code 1.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace stylet::offline {

struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Refused, but a coarser voxel edge would be accepted: a search for an edge continues.
struct TooFine : Refusal {
  using Refusal::Refusal;
};

// Text quoted from a file may contain line ends and other control characters: they become '?'.
template <typename Kind = Refusal, typename... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> format, Args&&... args) {
  std::string text = fmt::format(format, std::forward<Args>(args)...);
  const auto control = [](unsigned char c) { return c < ' '; };
  std::replace_if(text.begin(), text.end(), control, '?');
  throw Kind(text);
}

}  // namespace stylet::offline
