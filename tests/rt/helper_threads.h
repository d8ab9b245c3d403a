// SPDX-License-Identifier: Apache-2.0
// Threads that help a kernel with its tissue step, for tests: they yield when there is nothing to
// do.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "stylet/kernel.h"

namespace stylet::test {

// Threads that help a kernel as long as this object lives.
class Helpers {
 public:
  Helpers(const Kernel& kernel, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      threads_.emplace_back([this, &kernel] {
        while (!stop_.load()) {
          if (help(kernel, 200)) {
            helped_.fetch_add(1);
          } else {
            std::this_thread::yield();  // the machine may have fewer processors than threads
          }
        }
      });
    }
  }
  ~Helpers() {
    stop_.store(true);
    for (std::thread& thread : threads_) thread.join();
  }
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;
  std::uint64_t helped() const { return helped_.load(); }

 private:
  std::atomic<bool> stop_ = false;
  std::atomic<std::uint64_t> helped_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace stylet::test
