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

}  // namespace

bool ApartOwners::apart(std::uint32_t sides, std::uint32_t others) const {
  if (!any()) return false;
  for (; sides != 0; sides &= sides - 1) {
    const auto side = static_cast<std::size_t>(std::countr_zero(sides));
    if ((others & ~apart_from[side]) != 0) return false;
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
