// SPDX-License-Identifier: Apache-2.0
// The tissue step shared by several threads: slabs of planes, handed out through atomics.
//
// There is one slab per thread. Two neighbouring slabs begin at the particles between them and are
// swept apart, down and up. So these particles have all their forces early and move during the
// sweep, and a thread sees the same planes in every step, which its cache holds. (Slabs swept
// towards each other met at a different place each time: planes there changed caches, and one
// thread waited for the other to end, then moved the particles between them. At 20 000 voxels that
// was an eighth of the step of two threads.)
//
// Threads are not equally fast: another load on the same core, a late start. A thread that is done
// with its slab helps with the other slabs, plane by plane from each slab's far end, except for the
// last few planes.
//
// The caller of tick publishes a step and takes slabs like every other thread. It also sweeps the
// slabs that no helper has taken in time. So a helper may be late or absent: the caller waits only
// for helpers that have begun a slab. Forces on particles from below and from above are summed
// separately in any case, so the bits do not depend on slabs.
//
// Promises: no lock, no system call, no allocation; every loop but the wait is bounded by the
// numbers of slabs and planes.
#pragma once

#include <atomic>

#include "state/layout.h"

namespace stylet {

struct Slab {
  // `taken`: how many planes after its first are taken in this step, or more once all are. `begun`:
  // its coupled voxels are matched and its first plane is swept.
  alignas(64) std::atomic<std::uint32_t> taken;
  std::atomic<std::uint32_t> begun;
  std::uint32_t begin, end;  // voxel planes
};

// A slab is swept in two parts: its own, and the planes that another thread helps with.
struct alignas(64) Part {
  Slab* slab;
  std::uint32_t first;  // voxel plane where its sweep begins
  bool up, helping;
  // Its own scratch: as Scratch::sums and force, and for the forces on the particles where
  // it begins. Forces are zero between steps.
  float *sums, *force, *kept;
  float* filter;      // as Scratch::filter, in a slab's own part
  const Part* apart;  // begins at the same particles, which this one moves; or null
  // From the last sweep: the lowest voxel plane that it swept, and how many planes; the forces on
  // the particles at both ends; whether it fetched and moved the particles where it begins; the
  // largest displacement.
  std::uint32_t begin, planes;
  float *low, *high;
  bool fetched, moved;
  float largest_m;
};
constexpr std::uint32_t kMostParts = 2 * (kMaxHelpers + 1);

struct Team {
  // Number of the step times 256, plus the number of parts taken.
  alignas(64) std::atomic<std::uint32_t> work;
  alignas(64) std::atomic<std::uint32_t> done;  // parts swept in this step
  // Set before `work` is published.
  alignas(64) void (*sweep)(const Kernel&, Part&);
  std::uint32_t slab_count;
  Part part[kMostParts];  // first each slab's own part, then each slab's other part
  Slab slab[kMaxHelpers + 1];
};

inline std::uint32_t parts_of(const Team& team) {
  return 2 * team.slab_count;
}

// Nobody helps with a slab's last planes: its thread sweeps them sooner than another could fetch
// them from its cache and join them. (With 1, two threads took 1 to 2 % more time at 20 000 voxels;
// 2 to 4 were alike.)
constexpr std::uint32_t kLeftAlone = 3;

// Takes another plane for a part, if there is one.
inline bool take_plane(const Part& part) {
  Slab& slab = *part.slab;
  const std::uint32_t planes = slab.end - slab.begin - 1;
  if (part.helping && (slab.begun.load(std::memory_order_acquire) == 0 ||
                       slab.taken.load(std::memory_order_relaxed) + kLeftAlone >= planes)) {
    return false;
  }
  return slab.taken.fetch_add(1, std::memory_order_relaxed) < planes;
}

// Null if nobody helps. A library that is built for one thread (STYLET_ALONE) never has a team, and
// sweeps all planes up: the compiler then leaves out what is for a team.
#if defined(STYLET_ALONE)
inline Team* team_of(const Kernel&) {
  return nullptr;
}
inline bool goes_up(const Part&) {
  return true;
}
#else
inline Team* team_of(const Kernel& kernel) {
  return reinterpret_cast<Team*>(reinterpret_cast<const ModelHead*>(kernel.model)->team);
}
inline bool goes_up(const Part& part) {
  return part.up;
}
#endif

// Sweeps all slabs, with every thread that is there.
void sweep_together(const Kernel& kernel, void (*sweep)(const Kernel&, Part&));

}  // namespace stylet
