// SPDX-License-Identifier: GPL-3.0-or-later
// Which input each of a cell's 64 samples belongs to. Time: n log n in the shares of the claims.
#pragma once

#include <array>

#include "voxels/lattice.h"

namespace stylet::offline {

constexpr std::uint32_t kCellSamples = 64;
constexpr std::uint16_t kNoOwner = 0xFFFF;
using OfSamples = std::array<std::uint16_t, kCellSamples>;  // an owner or a material of each

class SampleOwners {
 public:
  // `claims` must outlive the object.
  explicit SampleOwners(const Claims& claims);

  // Where several inputs have a sample, it is the strongest one's.
  OfSamples in(std::size_t cell) const;

  // Calls visit(owner) for each input that has samples of the cell, and for the cell's own.
  template <typename Visit>
  void each_owner(std::size_t cell, Visit visit) const {
    visit(claims_.owner[cell]);
    for (auto share = first_share(cell); share != shares_.end() && share->cell == cell; ++share) {
      visit(share->owner);
    }
  }

 private:
  std::vector<Claims::Share>::const_iterator first_share(std::size_t cell) const;

  const Claims& claims_;
  std::vector<Claims::Share> shares_;  // by cell, weakest first
};

}  // namespace stylet::offline
