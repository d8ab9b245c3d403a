// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps inputs apart that are never connected with one another, however near they are: tissues that
// slide. Each of these tissues is a side, numbered from 1. All other inputs are on side 0, which is
// joined to every side.
// Time: linear in the cells with samples of several sides.
#pragma once

#include <unordered_map>

#include "voxels/sample_owners.h"

namespace stylet::offline {

constexpr std::size_t kMostSides = 31;

struct ApartOwners {
  std::vector<std::uint32_t> side;        // of each owner; owners beyond the list are on side 0
  std::vector<std::uint32_t> apart_from;  // of each side: the sides it stays apart from, as bits

  bool any() const { return !apart_from.empty(); }
  std::uint32_t side_of(std::uint16_t owner) const { return owner < side.size() ? side[owner] : 0; }
  // Whether no side of one set joins a side of the other.
  bool apart(std::uint32_t sides, std::uint32_t others) const;
};

// Calls visit(voxel) for each voxel of a cell.
template <typename Visit>
void each_voxel(const Lattice& lattice, std::size_t cell, Visit visit) {
  const std::uint32_t voxel = lattice.voxel_of_cell[cell];
  if (voxel == kNoVoxel) return;
  const std::span<const SharedCell> shared = shared_in(lattice, cell);
  if (shared.empty()) visit(voxel);
  for (const SharedCell& each : shared) visit(each.voxel);
}

// Gives each voxel an owner on one of its sides: also those without samples of their own, or whose
// samples several inputs claim. `owner_io` is as from `owners`, which sorts the shares.
void settle_owners(const Claims& claims, const Lattice& lattice, const ApartOwners& apart,
                   std::vector<std::uint16_t>& owner_io);

// Whether a voxel shares its cell, or a face of it, with one that it is apart from.
bool meets_apart(const Lattice& lattice, std::uint32_t voxel, const ApartOwners& apart);

// The samples of a cell that are on one side.
struct SideSamples {
  std::uint32_t side;
  std::uint64_t samples;
};

// The sides of all cells' samples.
class SampleSides {
 public:
  // `apart` must outlive the object.
  SampleSides(const Claims& claims, const ApartOwners& apart);

  const ApartOwners& owners() const { return apart_; }
  // At least one entry; in a cell with one side, the entry has all 64 samples.
  std::span<const SideSamples> in(std::uint32_t cell) const;
  // The samples of a cell that a side joins.
  std::uint64_t joined(std::uint32_t cell, std::uint32_t side) const;
  // The sides of some of a cell's samples, as bits; for no samples, the sides of the cell itself.
  std::uint32_t sides(std::uint32_t cell, std::uint64_t samples) const;

 private:
  const ApartOwners& apart_;
  std::vector<SideSamples> alone_;  // of each cell; empty: all on side 0
  std::unordered_map<std::uint32_t, std::vector<SideSamples>> several_;  // by cell
};

}  // namespace stylet::offline
