// SPDX-License-Identifier: Apache-2.0
// The tissue step shared by several threads: slabs of planes, handed out through atomics.
//
// Two slabs that follow each other are swept towards each other, up and down, and end where they
// meet: threads are never equally fast for long (another load on the same core, a cache that
// fills), and so the faster one sweeps more, while each keeps the planes that its cache holds.
//
// The caller of tick publishes a step and takes slabs like everyone else. A plane that no helper
// has taken in time it sweeps itself, so a helper may be late or absent; it waits only for planes
// that a helper has begun. Particles between two slabs move last, when both have sent their forces;
// as their forces from below and above are summed apart anyway, the bits do not depend on slabs.
//
// Promises: no lock, no system call, no allocation; every loop but the wait is bounded by the
// numbers of slabs and planes.
#pragma once

#include <atomic>

#include "layout.h"

namespace stylet {

// Planes that either of two slabs may take, between the first planes of both.
struct Between {
  alignas(64) std::atomic<std::uint32_t> taken;  // in this step; more than `planes` once all are
  std::uint32_t planes;
};

inline bool take_plane(Between& between) {
  return between.taken.fetch_add(1, std::memory_order_relaxed) < between.planes;
}

struct Slab {
  std::uint32_t first;  // voxel plane it is swept from
  bool up;
  Between* between;  // what comes after the first plane
  float* sums;       // scratch of its own: as ScratchView::sums and force
  float* force;
  float* kept;  // and for the forces on the particles where it begins
  // From the last sweep: its lowest voxel plane, forces on the particles at both ends, largest
  // displacement.
  std::uint32_t begin;
  float *low, *high;
  float largest_m;
};

struct Team {
  // Number of the step times 256, plus the number of slabs taken.
  alignas(64) std::atomic<std::uint32_t> work;
  alignas(64) std::atomic<std::uint32_t> done;  // slabs swept in this step
  // Set before `work` is published.
  alignas(64) void (*sweep)(const Kernel&, Slab&);
  std::uint32_t slab_count;
  Slab slab[kMaxHelpers + 1];
  Between between[kMaxHelpers / 2 + 1];  // of slabs 0 and 1, 2 and 3, and so on
};

inline Team& team_of(const Kernel& kernel) {
  return *reinterpret_cast<Team*>(kernel.team);
}

// All slabs swept, by whoever is there.
void sweep_together(const Kernel& kernel, void (*sweep)(const Kernel&, Slab&));

}  // namespace stylet
