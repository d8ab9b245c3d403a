// SPDX-License-Identifier: Apache-2.0
// Two ways out of the real-time thread that never make it wait.
//
// Ring: every item, in order, for one reader; full: push says no and nothing is lost silently.
// Latest: only the newest item, for one reader that looks when it likes. Slots: the same for items
// that are filled and read in place.
// Promises: wait-free for both sides, no allocation after construction, one writer and one reader.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace stylet::hal {

constexpr std::size_t kCacheLine = 64;

template <typename T>
class Ring {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  // Touches every item, so that the writer meets no page for the first time.
  explicit Ring(std::size_t capacity) : items_(capacity) {}

  bool push(const T& item) {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == items_.size()) return false;
    items_[end % items_.size()] = item;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  bool pop(T& item_out) {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    item_out = items_[begin % items_.size()];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

  std::size_t capacity() const { return items_.size(); }

 private:
  std::vector<T> items_;
  alignas(kCacheLine) std::atomic<std::size_t> begin_{0};
  alignas(kCacheLine) std::atomic<std::size_t> end_{0};
};

// Triple buffer: writer and reader own one slot each and swap it with the one in the middle.
template <typename T>
class Slots {
 public:
  Slots() = default;
  explicit Slots(const T& each) { slots_.fill(each); }

  // Writer: what it fills, and that it is full. The next draft holds something older.
  T& draft() { return slots_[write_]; }
  void publish() {
    write_ = middle_.exchange(write_ | kFresh, std::memory_order_acq_rel) & ~kFresh;
  }

  // Reader: the newest, its own until the next call; null: nothing new since the last one.
  const T* take() {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return nullptr;
    read_ = middle_.exchange(read_, std::memory_order_acq_rel) & ~kFresh;
    return &slots_[read_];
  }

 private:
  static constexpr std::uint32_t kFresh = 4;
  std::array<T, 3> slots_{};
  alignas(kCacheLine) std::uint32_t write_ = 0;
  alignas(kCacheLine) std::atomic<std::uint32_t> middle_{1};
  alignas(kCacheLine) std::uint32_t read_ = 2;
};

template <typename T>
class Latest {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void publish(const T& item) {
    slots_.draft() = item;
    slots_.publish();
  }

  // False: nothing new since the last call; `item_out` is untouched.
  bool take(T& item_out) {
    const T* newest = slots_.take();
    if (newest != nullptr) item_out = *newest;
    return newest != nullptr;
  }

 private:
  Slots<T> slots_;
};

}  // namespace stylet::hal
