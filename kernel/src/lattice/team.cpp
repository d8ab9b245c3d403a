// SPDX-License-Identifier: Apache-2.0
#include "lattice/team.h"

#include <algorithm>
#include <new>

namespace stylet {
namespace {

constexpr std::uint32_t kStep = 256;  // in Team::work
static_assert(kMostParts < kStep);

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

enum class Found { kNothing, kEmptyPart, kPlanes };

// Sweeps one part of the present step, unless all are taken. A value of `work` read long ago does
// no harm: the exchange fails, or the part that it names is the next one again.
Found sweep_one(const Kernel& kernel, Team& team) {
  for (std::uint32_t attempt = 0; attempt < kMostParts; ++attempt) {
    std::uint32_t seen = team.work.load(std::memory_order_acquire);
    const std::uint32_t next = seen % kStep;
    if (next >= parts_of(team)) return Found::kNothing;
    if (team.work.compare_exchange_strong(seen, seen + 1, std::memory_order_acq_rel,
                                          std::memory_order_relaxed)) {
      Part& part = team.part[next];
      team.sweep(kernel, part);
      const bool empty = part.planes == 0;
      team.done.fetch_add(1, std::memory_order_release);
      return empty ? Found::kEmptyPart : Found::kPlanes;
    }
  }
  return Found::kNothing;
}

constexpr std::uint32_t kForceParts = 3;  // two in turn, and the one that is kept
struct TeamSizes {
  std::uint64_t sums, force, filter;  // floats of one part, in whole blocks
};

TeamSizes team_sizes(const Counts& counts) {
  const auto whole = [](std::uint64_t floats) { return (floats + kLanes - 1) / kLanes * kLanes; };
  // Windows read the lanes before the sums, but do not use them.
  return {kLanes + whole(std::uint64_t{12} * counts.slots_at_once),
          whole(std::uint64_t{3} * kForceParts * counts.particles_per_plane),
          whole(counts.levels > 1 ? 0 : counts.filter_floats)};
}

// One slab per thread.
std::uint32_t slabs_of(const Counts& counts, std::uint32_t helpers) {
  return counts.planes < helpers + 1 ? counts.planes : helpers + 1;
}

// Sets both parts of slab `s`, of planes [begin, end).
void set_slab(Team& team, std::uint32_t s, std::uint32_t begin, std::uint32_t end) {
  const bool up = s % 2 != 0;
  Slab& slab = team.slab[s];
  slab.begin = begin;
  slab.end = end;
  Part &own = team.part[s], &helping = team.part[team.slab_count + s];
  own.slab = helping.slab = &slab;
  own.up = up;
  helping.up = !up;
  own.first = up ? begin : end - 1;
  helping.first = up ? end - 1 : begin;
  helping.helping = true;
  if (!up && s + 1 < team.slab_count) own.apart = &team.part[s + 1];
}

// Equal shares of all slots up to the end of each slab, and a plane for each slab that follows.
void share_planes(const Model& model, Team& team) {
  const Counts& counts = model.head->counts;
  std::uint32_t plane = 0;
  for (std::uint32_t s = 0; s < team.slab_count; ++s) {
    const std::uint32_t begin = plane, left = team.slab_count - 1 - s;
    const std::uint64_t wanted = std::uint64_t{counts.slots} * (s + 1);
    for (++plane; plane < counts.planes - left; ++plane) {
      const Plane& p = model.plane[plane];
      if (std::uint64_t{p.slot_begin + p.slot_end} * team.slab_count > 2 * wanted) break;
    }
    set_slab(team, s, begin, plane);
  }
}

}  // namespace

void sweep_together(const Kernel& kernel, void (*sweep)(const Kernel&, Part&)) {
  Team& team = *team_of(kernel);
  team.sweep = sweep;
  team.done.store(0, std::memory_order_relaxed);
  for (std::uint32_t s = 0; s < team.slab_count; ++s) {
    team.slab[s].taken.store(0, std::memory_order_relaxed);
    team.slab[s].begun.store(0, std::memory_order_relaxed);
  }
  const std::uint32_t step = team.work.load(std::memory_order_relaxed) / kStep;
  team.work.store((step + 1) * kStep, std::memory_order_release);
  while (sweep_one(kernel, team) != Found::kNothing) {
  }
  while (team.done.load(std::memory_order_acquire) != parts_of(team)) pause();
}

std::size_t team_bytes(const Kernel& kernel, std::uint32_t helpers) {
  const Counts& counts = counts_of(kernel);
  const TeamSizes size = team_sizes(counts);
  const std::uint64_t slab = 2 * (size.sums + size.force) + size.filter;
  const std::uint64_t bytes = sizeof(Team) + slabs_of(counts, helpers) * slab * sizeof(float);
  // More than this machine has: set_team refuses any memory.
  return static_cast<std::size_t>(std::min<std::uint64_t>(bytes, SIZE_MAX));
}

Status set_team(Kernel& kernel, std::uint32_t helpers, std::span<std::byte> memory) {
  if (helpers > kMaxHelpers) return Status::kConfigValueOutOfRange;
  ModelHead& head = *reinterpret_cast<ModelHead*>(kernel.model);
  if (helpers == 0) {
    head.team = nullptr;
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
  // There is nothing to take until the first step.
  team.work.store(parts_of(team), std::memory_order_relaxed);
  auto* floats = reinterpret_cast<float*>(memory.data() + sizeof(Team));
  for (std::uint32_t i = 0; i < parts_of(team); ++i) {
    Part& part = team.part[i];
    part.sums = floats + kLanes;
    part.force = floats + size.sums;
    part.kept = part.force + std::size_t{3} * (kForceParts - 1) * counts.particles_per_plane;
    std::fill_n(part.force, size.force, 0.0F);
    floats += size.sums + size.force;
  }
  for (std::uint32_t s = 0; s < team.slab_count; ++s, floats += size.filter) {
    team.part[s].filter = floats;
  }
  share_planes(view.model, team);
  head.team = memory.data();
  return Status::kOk;
}

bool has_team(const Kernel& kernel) {
  return team_of(kernel) != nullptr;
}

bool help(const Kernel& kernel, std::uint32_t looks) {
  Team* const team = team_of(kernel);
  for (std::uint32_t look = 0; look < looks; ++look) {
    if (team != nullptr && sweep_one(kernel, *team) == Found::kPlanes) return true;
    pause();
  }
  return false;
}

}  // namespace stylet
