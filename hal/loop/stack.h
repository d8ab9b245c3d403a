// SPDX-License-Identifier: Apache-2.0
// The stack of the loop's thread, on every system.
#pragma once

#include <cstddef>

namespace stylet::hal {

constexpr std::size_t kStackBytes = 256 * 1024;  // more than the loop and a device ever use

// Writes once in each page, so that the loop never meets a page of its stack for the first time.
inline void touch_stack() {
  volatile unsigned char stack[kStackBytes];
  for (std::size_t i = 0; i < kStackBytes; i += 1024) stack[i] = 0;
  (void)stack[0];
}

}  // namespace stylet::hal
