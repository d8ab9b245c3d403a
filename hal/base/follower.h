// SPDX-License-Identifier: Apache-2.0
// A second reader of a ring: it sees the items too, without taking any.
//
// Promises: neither writer nor reader notices it; items come in order, whole or not at all. If it
// falls more than half the ring behind, it skips items and counts those it missed.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "hal/base/channel.h"

namespace stylet::hal {

template <typename T>
class Follower {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  // Starts from the next item.
  explicit Follower(const Ring<T>& ring) : ring_(ring), next_(ring.pushed()) {}

  bool next(T& item_out) {
    const std::uint64_t end = ring_.pushed();
    if (next_ == end) return false;
    std::atomic_thread_fence(std::memory_order_acquire);
    const std::uint64_t most = ring_.capacity() / 2;
    if (end - next_ > most) {
      lost_ += end - next_ - most;
      next_ = end - most;
    }
    copy(ring_.item(next_), item_out);
    std::atomic_thread_fence(std::memory_order_acquire);
    // It was overwritten meanwhile: the next call starts from where the writer is.
    if (ring_.pushed() - next_ >= ring_.capacity()) return false;
    ++next_;
    return true;
  }
  std::uint64_t lost() const { return lost_; }

 private:
  // Copies what the writer may be writing just now; whether it is whole is checked afterwards.
  // So a sanitizer should not report this as a race.
  __attribute__((no_sanitize("thread"))) static void copy(const T& from, T& to) {
    const auto* bytes = reinterpret_cast<const volatile unsigned char*>(&from);
    auto* out = reinterpret_cast<unsigned char*>(&to);
    for (std::size_t i = 0; i < sizeof(T); ++i) out[i] = bytes[i];
  }

  const Ring<T>& ring_;
  std::uint64_t next_, lost_ = 0;
};

}  // namespace stylet::hal
