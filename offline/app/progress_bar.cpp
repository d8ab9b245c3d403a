// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

namespace stylet::offline {
namespace {

using Clock = std::chrono::steady_clock;

struct Bar {
  Clock::time_point start = Clock::now();
  bool shown = false;
  std::string stage;
  Clock::time_point stage_start;

  Bar() = default;
  Bar(const Bar&) = delete;
  Bar& operator=(const Bar&) = delete;
  ~Bar() {
    if (shown) fmt::print(stderr, "\r\x1b[K");
  }
};

// Estimated from the time that this fraction of the stage took; empty while it is too early.
std::string time_left(const Bar& bar, double fraction) {
  constexpr double kEarly = 0.03;
  const std::chrono::duration<double> taken = Clock::now() - bar.stage_start;
  if (fraction < kEarly) return "";
  const double left = taken.count() * (1 - fraction) / fraction;
  return left < 90 ? fmt::format(", {:.0f} s left", std::ceil(left))
                   : fmt::format(", {:.0f} min left", std::ceil(left / 60));
}

}  // namespace

Progress progress_bar() {
  const char* kind = std::getenv("TERM");
  const bool rewrites = kind != nullptr && std::string_view(kind) != "dumb";
  if (::isatty(STDERR_FILENO) == 0 || !rewrites) return [](const char*, double) {};
  const auto bar = std::make_shared<Bar>();
  return [bar](const char* stage, double fraction) {
    if (bar->stage != stage) {
      bar->stage = stage;
      bar->stage_start = Clock::now();
    }
    if (Clock::now() - bar->start < std::chrono::seconds(1)) return;
    constexpr std::size_t kWidth = 30;
    const auto done = static_cast<std::size_t>(fraction * kWidth);
    fmt::print(stderr, "\r\x1b[K[{}{}] {}{}", std::string(done, '#'),
               std::string(kWidth - done, ' '), stage, time_left(*bar, fraction));
    std::fflush(stderr);
    bar->shown = true;
  };
}

}  // namespace stylet::offline
