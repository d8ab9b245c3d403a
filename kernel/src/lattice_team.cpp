// SPDX-License-Identifier: Apache-2.0
#include "lattice_team.h"

#include <new>

namespace stylet {
namespace {

constexpr std::uint32_t kStep = 256;  // in Team::work
static_assert(kMaxHelpers + 1 < kStep);

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

// Sweeps one slab of the present step; false when all are taken. A value of `work` that was read
// long ago does no harm: the exchange fails, or the slab it names is the next one again.
bool sweep_one(const Kernel& kernel, Team& team) {
  for (std::uint32_t attempt = 0; attempt <= kMaxHelpers; ++attempt) {
    std::uint32_t seen = team.work.load(std::memory_order_acquire);
    const std::uint32_t next = seen % kStep;
    if (next >= team.slab_count) return false;
    if (team.work.compare_exchange_strong(seen, seen + 1, std::memory_order_acq_rel,
                                          std::memory_order_relaxed)) {
      team.sweep(kernel, team.slab[next]);
      team.done.fetch_add(1, std::memory_order_release);
      return true;
    }
  }
  return false;
}

constexpr std::uint32_t kForceParts = 3;  // two in turn, and the one that is kept
struct TeamSizes {
  std::size_t sums, force;  // floats of one slab, in whole blocks
};

TeamSizes team_sizes(const Counts& counts) {
  const auto whole = [](std::size_t floats) { return (floats + kLanes - 1) / kLanes * kLanes; };
  // The lanes before the sums are read by windows, and not used.
  return {kLanes + whole(std::size_t{12} * counts.slots_at_once),
          whole(std::size_t{3} * kForceParts * counts.particles_per_plane)};
}

// One for each thread.
std::uint32_t slabs_of(const Counts& counts, std::uint32_t helpers) {
  return counts.planes < helpers + 1 ? counts.planes : helpers + 1;
}

// What each slab begins with, and every two have between them: as many slots in each as there are
// in all by now, and a plane for each that follows.
void share_planes(const ModelView& model, Team& team) {
  const Counts& counts = model.head->counts;
  std::uint32_t plane = 0;
  for (std::uint32_t s = 0; s < team.slab_count; ++s) {
    const std::uint32_t begin = plane, left = team.slab_count - 1 - s;
    const std::uint64_t wanted = std::uint64_t{counts.slots} * (s + 1);
    for (++plane; plane < counts.planes - left; ++plane) {
      const Plane& p = model.plane[plane];
      if (std::uint64_t{p.slot_begin + p.slot_end} * team.slab_count > 2 * wanted) break;
    }
    Slab& slab = team.slab[s];
    slab.up = s % 2 == 0;
    slab.first = slab.up ? begin : plane - 1;
    slab.between = &team.between[s / 2];
    slab.between->planes += plane - begin - 1;
  }
}

}  // namespace

void sweep_together(const Kernel& kernel, void (*sweep)(const Kernel&, Slab&)) {
  Team& team = team_of(kernel);
  team.sweep = sweep;
  team.done.store(0, std::memory_order_relaxed);
  for (Between& each : team.between) each.taken.store(0, std::memory_order_relaxed);
  const std::uint32_t step = team.work.load(std::memory_order_relaxed) / kStep;
  team.work.store((step + 1) * kStep, std::memory_order_release);
  while (sweep_one(kernel, team)) {
  }
  while (team.done.load(std::memory_order_acquire) != team.slab_count) pause();
}

std::size_t team_bytes(const Kernel& kernel, std::uint32_t helpers) {
  const Counts& counts = counts_of(kernel);
  const TeamSizes size = team_sizes(counts);
  return sizeof(Team) + slabs_of(counts, helpers) * (size.sums + size.force) * sizeof(float);
}

Status set_team(Kernel& kernel, std::uint32_t helpers, std::span<std::byte> memory) {
  if (helpers > kMaxHelpers) return Status::kConfigValueOutOfRange;
  if (helpers == 0) {
    kernel.team = nullptr;
    return Status::kOk;
  }
  if (memory.size() < team_bytes(kernel, helpers)) return Status::kMemoryTooSmall;
  if (reinterpret_cast<std::uintptr_t>(memory.data()) % kBlockAlignment != 0) {
    return Status::kMemoryNotAligned;
  }
  const View view = view_of(kernel);
  const Counts& counts = view.model.head->counts;
  const TeamSizes size = team_sizes(counts);
  Team& team = *new (memory.data()) Team();  // in the caller's memory, between ticks
  team.slab_count = slabs_of(counts, helpers);
  // Nothing to take until the first step.
  team.work.store(team.slab_count, std::memory_order_relaxed);
  auto* floats = reinterpret_cast<float*>(memory.data() + sizeof(Team));
  for (std::uint32_t s = 0; s < team.slab_count; ++s) {
    Slab& slab = team.slab[s];
    slab.sums = floats + kLanes;
    slab.force = floats + size.sums;
    slab.kept = slab.force + std::size_t{3} * (kForceParts - 1) * counts.particles_per_plane;
    floats += size.sums + size.force;
  }
  share_planes(view.model, team);
  kernel.team = memory.data();
  return Status::kOk;
}

bool help(const Kernel& kernel, std::uint32_t looks) {
  Team& team = team_of(kernel);
  for (std::uint32_t look = 0; look < looks; ++look) {
    if (sweep_one(kernel, team)) return true;
    pause();
  }
  return false;
}

}  // namespace stylet
