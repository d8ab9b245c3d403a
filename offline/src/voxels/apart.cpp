// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/apart.h"

#include <bit>

namespace stylet::offline {
namespace {

constexpr SideSamples kSideNought = {0, kFullCell};

std::vector<SideSamples> sides_in(const OfSamples& owner, const ApartOwners& apart) {
  std::vector<SideSamples> found;
  for (std::uint32_t s = 0; s < kCellSamples; ++s) {
    if (owner[s] == kNoOwner) continue;
    const std::uint32_t side = apart.side_of(owner[s]);
    auto same = std::ranges::find(found, side, &SideSamples::side);
    if (same == found.end()) same = found.insert(found.end(), {side, 0});
    same->samples |= std::uint64_t{1} << s;
  }
  return found;
}

// The owner on one of these sides that has most samples in a cell.
struct BestOwner {
  std::uint16_t owner = kNoOwner;
  int samples = 0;

  void offer(std::uint16_t other, int of_other) {
    if (of_other <= samples) return;
    owner = other;
    samples = of_other;
  }
};

void offer_cell(const Claims& claims, std::uint32_t cell, const ApartOwners& apart,
                std::uint32_t sides, BestOwner& best) {
  const auto offer = [&](std::uint16_t owner, int samples) {
    if ((sides >> apart.side_of(owner) & 1U) != 0) best.offer(owner, samples);
  };
  offer(claims.owner[cell], claims.owner_fill[cell]);
  // Not equal_range, whose subrange clang 14 cannot read with the library of GCC 12.
  const auto& shares = claims.shares;
  auto share = std::ranges::lower_bound(shares, cell, {}, &Claims::Share::cell);
  for (; share != shares.end() && share->cell == cell; ++share) {
    offer(share->owner, std::popcount(share->inside));
  }
}

// The owner on these sides that has most samples in the cell, or, if none has any, in the cells
// around it.
std::uint16_t owner_on(const Claims& claims, std::uint32_t cell, const ApartOwners& apart,
                       std::uint32_t sides) {
  BestOwner best;
  offer_cell(claims, cell, apart, sides, best);
  if (best.owner != kNoOwner) return best.owner;
  const auto& size = claims.grid.size;
  const std::uint32_t x = cell % size[0], y = cell / size[0] % size[1],
                      z = cell / size[0] / size[1];
  for (std::uint32_t n = 0; n < 27; ++n) {
    // An index below 0 wraps to one beyond the size.
    const std::uint32_t cx = x + n % 3 - 1, cy = y + n / 3 % 3 - 1, cz = z + n / 9 - 1;
    if (cx >= size[0] || cy >= size[1] || cz >= size[2]) continue;
    offer_cell(claims, static_cast<std::uint32_t>(cell_index(claims.grid, cx, cy, cz)), apart,
               sides, best);
  }
  return best.owner;
}

}  // namespace

void settle_owners(const Claims& claims, const Lattice& lattice, const ApartOwners& apart,
                   std::vector<std::uint16_t>& owner_io) {
  for (std::uint32_t voxel = 0; voxel < lattice.sides.size(); ++voxel) {
    const std::uint32_t sides = lattice.sides[voxel];
    if ((sides >> apart.side_of(owner_io[voxel]) & 1U) != 0) continue;
    const std::uint16_t owner = owner_on(claims, lattice.cell_of_voxel[voxel], apart, sides);
    if (owner != kNoOwner) owner_io[voxel] = owner;
  }
}

bool meets_apart(const Lattice& lattice, std::uint32_t voxel, const ApartOwners& apart) {
  if (!apart.any()) return false;
  const Grid& grid = lattice.grid;
  const std::size_t cell = lattice.cell_of_voxel[voxel];
  bool meets = false;
  const auto look = [&](std::size_t there) {
    each_voxel(lattice, there, [&](std::uint32_t other) {
      meets = meets || apart.apart(lattice.sides[voxel], lattice.sides[other]);
    });
  };
  look(cell);
  const std::size_t steps[3] = {1, grid.size[0], std::size_t{grid.size[0]} * grid.size[1]};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t at = cell / steps[axis] % grid.size[axis];
    if (at > 0) look(cell - steps[axis]);
    if (at + 1 < grid.size[axis]) look(cell + steps[axis]);
  }
  return meets;
}

bool ApartOwners::apart(std::uint32_t sides, std::uint32_t others) const {
  if (!any()) return false;
  for (; sides != 0; sides &= sides - 1) {
    const auto one = static_cast<std::size_t>(std::countr_zero(sides));
    if ((others & ~apart_from[one]) != 0) return false;
  }
  return true;
}

SampleSides::SampleSides(const Claims& claims, const ApartOwners& apart) : apart_(apart) {
  if (!apart.any()) return;
  const SampleOwners owners(claims);
  alone_.assign(claims.inside.size(), kSideNought);
  for (std::uint32_t cell = 0; cell < alone_.size(); ++cell) {
    if (!is_kept(claims, cell)) continue;
    alone_[cell].side = apart.side_of(claims.owner[cell]);
    std::uint32_t mentioned = 0;
    owners.each_owner(cell, [&](std::uint16_t owner) { mentioned |= 1U << apart.side_of(owner); });
    if (claims.inside[cell] == 0 || std::has_single_bit(mentioned)) continue;
    std::vector<SideSamples> found = sides_in(owners.in(cell), apart);
    if (found.size() > 1) {
      several_.emplace(cell, std::move(found));
    } else {
      alone_[cell].side = found.front().side;
    }
  }
}

std::span<const SideSamples> SampleSides::in(std::uint32_t cell) const {
  if (alone_.empty()) return {&kSideNought, 1};
  const auto found = several_.find(cell);
  if (found != several_.end()) return found->second;
  return {&alone_[cell], 1};
}

std::uint64_t SampleSides::joined(std::uint32_t cell, std::uint32_t side) const {
  std::uint64_t samples = 0;
  for (const SideSamples& each : in(cell)) {
    if (!apart_.apart(1U << side, 1U << each.side)) samples |= each.samples;
  }
  return samples;
}

std::uint32_t SampleSides::sides(std::uint32_t cell, std::uint64_t samples) const {
  std::uint32_t bits = 0;
  const std::span<const SideSamples> all = in(cell);
  for (const SideSamples& each : all) {
    if (all.size() == 1 || (each.samples & samples) != 0) bits |= 1U << each.side;
  }
  return bits;
}

}  // namespace stylet::offline
