// SPDX-License-Identifier: Apache-2.0
// Two ways out of the real-time thread that never make it wait.
//
// Ring: every item, in order, for one reader; when it is full push refuses, so no loss goes unseen.
// Latest: only the newest item, for one reader that looks when it likes. Slots: the same for items
// that are filled and read in place.
// Each also works in memory that two processes share, which is zero at first. There either side may
// write anything at any time, so each side keeps for itself what it relies on, and holds the one
// number that it reads from the other within bounds. A reader gone mad loses items, nothing else.
// Promises: wait-free for both sides, no allocation after construction, one writer and one reader.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace stylet::hal {

constexpr std::size_t kCacheLine = 64;

template <typename T>
class Ring {
  static_assert(std::is_trivially_copyable_v<T>);
  struct Ends {
    alignas(kCacheLine) std::atomic<std::uint64_t> begin;
    alignas(kCacheLine) std::atomic<std::uint64_t> end;
  };
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

 public:
  // Touches every item, so that the writer never meets a page for the first time.
  explicit Ring(std::size_t capacity) : own_(capacity), items_(own_), ends_(&own_ends_) {}
  // Takes shared memory of bytes(capacity), on a cache line. One side pushes, the other pops.
  explicit Ring(std::span<std::byte> shared)
      : items_(reinterpret_cast<T*>(shared.data() + sizeof(Ends)),
               (shared.size() - sizeof(Ends)) / sizeof(T)),
        ends_(reinterpret_cast<Ends*>(shared.data())) {}
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  static constexpr std::size_t bytes(std::size_t capacity) {
    return sizeof(Ends) + capacity * sizeof(T);
  }

  bool push(const T& item) {
    if (end_ - ends_->begin.load(std::memory_order_acquire) >= items_.size()) return false;
    items_[end_ % items_.size()] = item;
    ends_->end.store(++end_, std::memory_order_release);
    return true;
  }

  bool pop(T& item_out) {
    const std::uint64_t ready = ends_->end.load(std::memory_order_acquire) - begin_;
    if (ready == 0 || ready > items_.size()) return false;
    item_out = items_[begin_ % items_.size()];
    ends_->begin.store(++begin_, std::memory_order_release);
    return true;
  }

  std::size_t capacity() const { return items_.size(); }
  // For any thread. The item with this number, counted from 0; the writer may be overwriting it.
  const T& item(std::uint64_t number) const { return items_[number % items_.size()]; }
  // How many items were ever pushed, and how many the reader says it has taken.
  std::uint64_t pushed() const { return ends_->end.load(std::memory_order_relaxed); }
  std::uint64_t popped() const { return ends_->begin.load(std::memory_order_relaxed); }

 private:
  std::vector<T> own_;
  Ends own_ends_ = {};
  std::span<T> items_;
  Ends* ends_;
  alignas(kCacheLine) std::uint64_t begin_ = 0;  // written by the reader
  alignas(kCacheLine) std::uint64_t end_ = 0;    // written by the writer
};

// Tells which of three slots belongs to whom: writer and reader own one each and swap it with the
// one in the middle.
class SlotIndex {
 public:
  SlotIndex() = default;
  explicit SlotIndex(std::atomic<std::uint32_t>& shared) : middle_(&shared) {}
  SlotIndex(const SlotIndex&) = delete;
  SlotIndex& operator=(const SlotIndex&) = delete;

  // Writer: the slot it fills; publish() says that it is full.
  std::uint32_t draft() const { return write_; }
  void publish() {
    write_ = slot_of(middle_->exchange(write_ | kFresh, std::memory_order_acq_rel));
  }
  // Reader: take() is false if nothing is new; taken() is the slot it reads.
  bool take() {
    if ((middle_->load(std::memory_order_relaxed) & kFresh) == 0) return false;
    read_ = slot_of(middle_->exchange(read_, std::memory_order_acq_rel));
    return true;
  }
  std::uint32_t taken() const { return read_; }

 private:
  static constexpr std::uint32_t kFresh = 4;
  static std::uint32_t slot_of(std::uint32_t word) { return std::min(word & ~kFresh, 2U); }

  std::atomic<std::uint32_t> own_{0};
  std::atomic<std::uint32_t>* middle_ = &own_;
  alignas(kCacheLine) std::uint32_t write_ = 1;
  alignas(kCacheLine) std::uint32_t read_ = 2;
};

// Triple buffer.
template <typename T>
class Slots {
 public:
  Slots() = default;
  explicit Slots(const T& each) { slots_.fill(each); }

  // Writer: the slot to fill; publish() says that it is full. The next draft holds older content.
  T& draft() { return slots_[index_.draft()]; }
  void publish() { index_.publish(); }

  // Reader: the newest item, its own until the next call; null: nothing new since the last call.
  const T* take() { return index_.take() ? &slots_[index_.taken()] : nullptr; }

 private:
  std::array<T, 3> slots_{};
  SlotIndex index_;
};

template <typename T>
class Latest {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void publish(const T& item) {
    slots_.draft() = item;
    slots_.publish();
  }

  // False: nothing is new since the last call, and `item_out` is untouched.
  bool take(T& item_out) {
    const T* newest = slots_.take();
    if (newest != nullptr) item_out = *newest;
    return newest != nullptr;
  }

 private:
  Slots<T> slots_;
};

// The same as Latest, in shared memory.
template <typename T>
class SharedLatest {
  static_assert(std::is_trivially_copyable_v<T>);
  struct Memory {
    alignas(kCacheLine) std::atomic<std::uint32_t> middle;
    alignas(kCacheLine) std::array<T, 3> slot;
  };

 public:
  // Takes shared memory of bytes(), aligned to a cache line.
  explicit SharedLatest(std::span<std::byte> shared)
      : memory_(reinterpret_cast<Memory*>(shared.data())), index_(memory_->middle) {}
  static constexpr std::size_t bytes() { return sizeof(Memory); }

  T& draft() { return memory_->slot[index_.draft()]; }
  void publish() { index_.publish(); }
  const T* take() { return index_.take() ? &memory_->slot[index_.taken()] : nullptr; }

 private:
  Memory* memory_;
  SlotIndex index_;
};

}  // namespace stylet::hal
