// SPDX-License-Identifier: Apache-2.0
// What replay.cpp needs of the machine below it: words in, text out, a clock. One implementation
// for systems with a C library, one for a bare Cortex-M7.
#pragma once

#include <cstdint>

namespace stylet::test {

constexpr int kMaxWords = 5;
struct Words {
  const char* word[kMaxWords];
  int count;
};

void put(const char* text);
// Instructions since some moment, modulo kClockWrap; always 0 where time is not virtual.
std::uint32_t clock();
constexpr std::uint32_t kClockWrap = 1U << 24U;

// Returns the exit code. In replay.cpp; the platform calls it.
int replay(const Words& words);

}  // namespace stylet::test
