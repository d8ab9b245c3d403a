// SPDX-License-Identifier: Apache-2.0
// The tissue step shared by several threads: slabs of planes, handed out through two atomics.
//
// The caller of tick publishes a step and takes slabs like everyone else; a slab that no helper has
// taken in time it sweeps itself, so a helper may be late or absent. It waits only for slabs that a
// helper has begun. Particles between two slabs move last, when both have sent their forces; as
// their forces from below and above are summed apart anyway, the bits do not depend on slabs.
//
// Promises: no lock, no system call, no allocation; every loop but the wait is bounded by the
// number of slabs.
#pragma once

#include <atomic>

#include "layout.h"

namespace stylet {

struct Slab {
  std::uint32_t begin, end;  // voxel planes
  float* sums;               // scratch of its own: as ScratchView::sums and force,
  float* force;              // with a third part for the particles at its low end
  // From the last sweep: largest displacement, forces on the particles at its high end.
  float largest_m;
  float* high;
};
constexpr std::uint32_t kForceParts = 3;

struct Team {
  // Number of the step times 256, plus the number of slabs taken.
  alignas(64) std::atomic<std::uint32_t> work;
  alignas(64) std::atomic<std::uint32_t> done;  // slabs swept in this step
  // Set before `work` is published.
  alignas(64) void (*sweep)(const Kernel&, Slab&);
  std::uint32_t slab_count;
  Slab slab[kMaxHelpers + 1];
};

inline Team& team_of(const Kernel& kernel) {
  return *reinterpret_cast<Team*>(kernel.team);
}

// All slabs swept, by whoever is there.
void sweep_together(const Kernel& kernel, void (*sweep)(const Kernel&, Slab&));

}  // namespace stylet
