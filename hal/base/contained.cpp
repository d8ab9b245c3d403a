// SPDX-License-Identifier: Apache-2.0
#include "hal/base/contained.h"

#include <atomic>
#include <cstdio>

namespace stylet::hal {

void tell_escape(const char* who, const char* what) noexcept {
  static std::atomic<int> told{0};
  if (told.fetch_add(1, std::memory_order_relaxed) >= kMostEscapesTold) return;
  (void)std::fprintf(stderr, "stylet: %s: %s\n", who, what);
}

}  // namespace stylet::hal
