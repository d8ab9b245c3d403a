// SPDX-License-Identifier: Apache-2.0
// What a display shows of a tick, and its wait-free way out of the loop, also to another process.
//
// It lies in shared memory that the loop writes and never reads. Promises: the constructor takes
// all memory; publish copies a bounded amount that depends on the organ alone, even with no reader,
// and neither waits nor allocates. One writer (the loop's thread, or another while there is no
// loop), one reader. Units: SI. Frame: world.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <type_traits>

#include "hal/base/channel.h"
#include "hal/base/side_process.h"
#include "hal/loop/record.h"
#include "stylet/kernel.h"

namespace stylet::hal {

constexpr std::size_t kMaxShownParticles = kMaxNeedles * (kMaxConstraintParticles + 1);
constexpr std::size_t kMaxShownTouches = kMaxNeedles * kMaxTouches;

// Plain data that has the same size for any organ.
struct DisplayedTick {
  std::uint32_t needles = 0;
  std::array<TickRecord, kMaxNeedles> hand = {};
  std::array<std::uint32_t, kMaxNeedles> nodes = {};  // of each needle's shape
  std::array<std::array<Vec3, kMaxRods + 1>, kMaxNeedles> node_m = {};
  std::uint32_t constraint_particles = 0;
  std::array<ConstraintParticle, kMaxShownParticles> constraint_particle = {};
  std::uint32_t touches = 0;
  std::array<ObstacleTouch, kMaxShownTouches> touch = {};
  std::uint64_t missed_ticks = 0, lost_records = 0;
  std::int64_t published_ns = 0;  // of the monotonic clock
};

struct DisplayState : DisplayedTick {
  std::span<const Vec3> moved_m;  // displacement of the lattice's particles from rest
};

class Display {
 public:
  explicit Display(const Kernel& kernel);
  // The display of another process, to be read; takes over the descriptor of its memory.
  explicit Display(int descriptor);
  int descriptor() const { return memory_.descriptor(); }

  // `records`: one of each needle, of the present tick.
  void publish(const Kernel& kernel, std::span<const TickRecord> records,
               std::uint64_t missed_ticks, std::uint64_t lost_records);
  // Null: nothing new since the last call. The state stays valid until the next call.
  const DisplayState* take();

 private:
  struct Memory {
    alignas(kCacheLine) std::atomic<std::uint32_t> middle;
    alignas(kCacheLine) std::array<DisplayedTick, 3> slot;
    // After it comes moved_m of each slot.
  };
  static_assert(std::is_trivially_copyable_v<DisplayedTick>);
  Memory& at() const { return *reinterpret_cast<Memory*>(memory_.bytes().data()); }
  std::span<Vec3> moved(std::uint32_t slot) const;

  SharedMemory memory_;
  SlotIndex index_;
  DisplayState taken_;
};

}  // namespace stylet::hal
