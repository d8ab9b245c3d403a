// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "platform.h"

namespace stylet::test {

void put(const char* text) {
  std::fputs(text, stdout);
}

std::uint32_t clock() {
  return 0;
}

}  // namespace stylet::test

int main(int argc, char** argv) {
  using namespace stylet::test;
  Words words = {};
  for (int i = 1; i < argc && words.count < kMaxWords; ++i) words.word[words.count++] = argv[i];
  return replay(words);
}
