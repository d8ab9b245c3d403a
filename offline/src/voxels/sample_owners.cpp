// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/sample_owners.h"

#include <bit>
#include <tuple>

namespace stylet::offline {

SampleOwners::SampleOwners(const Claims& claims) : claims_(claims), shares_(claims.shares) {
  // Among equal shares the first input is the strongest, as in add_claim.
  std::stable_sort(shares_.begin(), shares_.end(), [](const auto& a, const auto& b) {
    return std::make_tuple(a.cell, a.priority, std::popcount(a.inside), b.owner) <
           std::make_tuple(b.cell, b.priority, std::popcount(b.inside), a.owner);
  });
}

std::vector<Claims::Share>::const_iterator SampleOwners::first_share(std::size_t cell) const {
  return std::lower_bound(
      shares_.begin(), shares_.end(), cell,
      [](const Claims::Share& each, std::size_t wanted) { return each.cell < wanted; });
}

// The strongest owner is put last, over the others.
OfSamples SampleOwners::in(std::size_t cell) const {
  OfSamples owner{};
  owner.fill(kNoOwner);
  const std::uint64_t inside = claims_.inside[cell];
  const auto take = [&](std::uint64_t samples, std::uint16_t of) {
    for (std::uint32_t s = 0; s < kCellSamples; ++s) {
      if ((samples >> s & 1U) != 0) owner[s] = of;
    }
  };
  take(inside, claims_.owner[cell]);  // also samples that no input filled (fill_gaps)
  for (auto share = first_share(cell); share != shares_.end() && share->cell == cell; ++share) {
    take(share->inside & inside, share->owner);
  }
  return owner;
}

}  // namespace stylet::offline
