// SPDX-License-Identifier: Apache-2.0
// To be preloaded: in threads with the name STYLET_STARVE_THREAD every allocation by `new` fails,
// beginning with number STYLET_STARVE_AFTER.
#include <pthread.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

bool fails() {
  static const char* const starved = std::getenv("STYLET_STARVE_THREAD");
  static const char* const after = std::getenv("STYLET_STARVE_AFTER");
  static std::atomic<long> count{0};
  char name[16] = {};
  if (starved == nullptr || pthread_getname_np(pthread_self(), name, sizeof name) != 0 ||
      std::strcmp(name, starved) != 0) {
    return false;
  }
  return count.fetch_add(1) >= (after == nullptr ? 0 : std::atol(after));
}

}  // namespace

void* operator new(std::size_t size) {
  void* block = fails() ? nullptr : std::malloc(size);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
void* operator new[](std::size_t size) {
  return operator new(size);
}
void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete[](void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}
void operator delete[](void* block, std::size_t) noexcept {
  std::free(block);
}
