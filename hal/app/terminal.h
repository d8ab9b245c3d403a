// SPDX-License-Identifier: Apache-2.0
// A progress line that rewrites itself, if somebody looks at it and the terminal can do it.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace stylet::app {

inline bool terminal_rewrites_lines() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && kind != nullptr && std::string_view(kind) != "dumb";
}

// An empty text removes the line.
inline void rewrite_line(const std::string& text) {
  fmt::print(stderr, "\r\033[K{}", text);
}

}  // namespace stylet::app
