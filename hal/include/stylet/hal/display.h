// SPDX-License-Identifier: Apache-2.0
// What a display sees of a tick, and its wait-free way out of the loop.
//
// Promises: all memory is taken by the constructor; publish copies a bounded amount that depends on
// the organ alone, whether anybody looks or not, and neither waits nor allocates. One writer (the
// loop's thread, or another while there is none), one reader. Units: SI. Frame: world.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "stylet/hal/channel.h"
#include "stylet/hal/record.h"
#include "stylet/kernel.h"

namespace stylet::hal {

constexpr std::size_t kMaxShownParticles = kMaxNeedles * (kMaxConstraintParticles + 1);
constexpr std::size_t kMaxShownTouches = kMaxNeedles * kMaxTouches;

struct DisplayState {
  std::uint32_t needles = 0;
  std::array<TickRecord, kMaxNeedles> hand = {};
  std::array<std::uint32_t, kMaxNeedles> nodes = {};  // of each needle's shape
  std::array<std::array<Vec3, kMaxRods + 1>, kMaxNeedles> node_m = {};
  std::uint32_t constraint_particles = 0;
  std::array<ConstraintParticle, kMaxShownParticles> constraint_particle = {};
  std::uint32_t touches = 0;
  std::array<ObstacleTouch, kMaxShownTouches> touch = {};
  std::uint64_t missed_ticks = 0, lost_records = 0;
  std::vector<Vec3> moved_m;  // of the lattice's particles, from rest
};

class Display {
 public:
  explicit Display(const Kernel& kernel);

  // Records: of each needle, in the present tick.
  void publish(const Kernel& kernel, std::span<const TickRecord> records,
               std::uint64_t missed_ticks, std::uint64_t lost_records);
  // Null: nothing new since the last call.
  const DisplayState* take() { return slots_.take(); }

 private:
  Slots<DisplayState> slots_;
};

}  // namespace stylet::hal
