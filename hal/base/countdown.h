// SPDX-License-Identifier: Apache-2.0
// Waits until something has happened a given number of times. std::latch would do this, but without
// a futex (Windows) GCC 12's looks at its number before it takes the lock under which it sleeps: it
// can miss the last call and sleep for ever. Takes a lock: not for a tick.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace stylet::hal {

class Countdown {
 public:
  explicit Countdown(std::uint32_t count) : left_(count) {}

  void count_down() {
    const std::lock_guard lock(mutex_);
    if (--left_ == 0) done_.notify_all();  // under the lock: who waited may end this object's life
  }
  void wait() {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return left_ == 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  std::uint32_t left_;
};

}  // namespace stylet::hal
