// SPDX-License-Identifier: Apache-2.0
#include "hal/base/lasting_pages.h"

#include <sys/mman.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <mutex>

namespace stylet::hal {
namespace {

constexpr std::uintptr_t kPage = 4096;  // the smallest page size; mappings begin at a page

std::array<std::atomic<std::uintptr_t>, kMostLastingMaps> mapped{};
struct sigaction before;

// Runs in the thread that touched a missing page; does only what POSIX and Linux allow a handler.
void replace_pages(int /*signal*/, siginfo_t* info, void* /*context*/) {
  const int error = errno;
  const std::uintptr_t page = reinterpret_cast<std::uintptr_t>(info->si_addr) / kPage * kPage;
  for (const auto& each : mapped) {
    if (page == 0 || each.load() != page) continue;
    void* at = reinterpret_cast<void*>(page);
    constexpr int kOwn = MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED;
    if (mmap(at, kPage, PROT_READ | PROT_WRITE, kOwn, -1, 0) != at) break;
    errno = error;
    return;
  }
  sigaction(SIGBUS, &before, nullptr);  // the signal is raised again, and goes to that handler
  errno = error;
}

void look_out_for_lost_pages() {
  static std::once_flag once;
  std::call_once(once, [] {
    struct sigaction action = {};
    action.sa_sigaction = replace_pages;
    action.sa_flags = SA_SIGINFO | SA_RESTART | SA_ONSTACK;
    sigaction(SIGBUS, &action, &before);
  });
}

}  // namespace

void* map_lasting(int file, std::size_t bytes) {
  look_out_for_lost_pages();
  void* at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (at == MAP_FAILED) return nullptr;
  for (auto& each : mapped) {
    std::uintptr_t none = 0;
    if (each.compare_exchange_strong(none, reinterpret_cast<std::uintptr_t>(at))) return at;
  }
  munmap(at, bytes);
  errno = ENOMEM;
  return nullptr;
}

void unmap_lasting(void* at, std::size_t bytes) {
  for (auto& each : mapped) {
    std::uintptr_t mine = reinterpret_cast<std::uintptr_t>(at);
    if (each.compare_exchange_strong(mine, 0)) break;
  }
  munmap(at, bytes);
}

}  // namespace stylet::hal
