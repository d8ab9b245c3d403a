// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/cell_parts.h"

#include <bit>
#include <numeric>

#include "base/disjoint_set.h"

namespace stylet::offline {
namespace {

constexpr std::array<CellStep, 6> kFaces{CellStep{-1, 0, 0}, CellStep{1, 0, 0},  CellStep{0, -1, 0},
                                         CellStep{0, 1, 0},  CellStep{0, 0, -1}, CellStep{0, 0, 1}};

// For each number below `count`: bits of the cell's sub-samples for which choose(centre) is it.
template <typename Choose>
std::vector<std::uint64_t> divide(std::size_t count, Choose choose) {
  std::vector<std::uint64_t> quarters(count, 0);
  for (std::uint32_t q = 0; q < 64; ++q) {
    const Vec centre = Vec{q % 4 + 0.5, q / 4 % 4 + 0.5, q / 16 + 0.5} * 0.25;
    quarters[choose(centre)] |= std::uint64_t{1} << q;
  }
  return quarters;
}

}  // namespace

CellParts::CellParts(const Claims& claims, const SamplePlaces& places, const Lattice& lattice)
    : claims_(claims), places_(places), lattice_(lattice) {
  for (int i = 0; i < 27; ++i) {
    const CellStep step = step_of(i);
    near_[step.index()] = near_samples(places, step.vec(), kReach);
  }
  find_parts();
  settle_specks();
  find_empty_parts();
}

CellPlace CellParts::place_of(std::uint32_t cell) const {
  const auto& size = lattice_.grid.size;
  return {cell % size[0], cell / size[0] % size[1], cell / size[0] / size[1]};
}

CellStep CellParts::between(const CellPart& a, const CellPart& b) const {
  const CellPlace from = place_of(a.cell), to = place_of(b.cell);
  const auto step = [](std::uint32_t f, std::uint32_t t) {
    return static_cast<int>(t) - static_cast<int>(f);
  };
  return {step(from.x, to.x), step(from.y, to.y), step(from.z, to.z)};
}

std::size_t CellParts::nearest(const std::vector<std::uint64_t>& bits, Vec place) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < bits.size(); ++i) {
    if (distance_to(bits[i], places_, {}, place) < distance_to(bits[best], places_, {}, place))
      best = i;
  }
  return best;
}

void CellParts::find_parts() {
  constexpr std::size_t kHere = 13;
  for (const std::uint32_t cell : lattice_.cell_of_voxel) {
    first.push_back(static_cast<std::uint32_t>(parts.size()));
    const std::uint64_t bits = claims_.inside[cell];
    if (bits == 0 || bits == kFullCell) {
      parts.push_back({cell, kNoPart, kNoSheet, false, bits, kFullCell, {}});
      continue;
    }
    for (const std::uint64_t part : connected_parts(bits, near_[kHere])) {
      parts.push_back({cell, kNoPart, kNoSheet, false, part, kFullCell, {}});
    }
  }
  first.push_back(static_cast<std::uint32_t>(parts.size()));
}

// Joins specks to a larger part of their cell: to the connected one, or if alone to the nearest.
std::vector<CellPart> CellParts::settled(std::size_t voxel) const {
  std::vector<CellPart> own(parts.begin() + first[voxel], parts.begin() + first[voxel + 1]);
  if (own.size() == 1) return own;
  const Block block = block_around(own[0].cell);
  std::vector<std::uint32_t> order(own.size());
  std::iota(order.begin(), order.end(), first[voxel]);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::popcount(parts[a].inside) > std::popcount(parts[b].inside);
  });
  std::vector<std::uint64_t> kept;
  std::vector<std::uint32_t> kept_set;
  for (const std::uint32_t i : order) {
    const std::uint64_t inside = parts[i].inside;
    const std::uint32_t set = set_of(block, i);
    const auto same = std::find(kept_set.begin(), kept_set.end(), set);
    const bool is_alone = std::count(block.set.begin(), block.set.end(), set) == 1;
    if (kept.empty() || std::popcount(inside) >= kLeastPart ||
        (same == kept_set.end() && !is_alone)) {
      kept.push_back(inside);
      kept_set.push_back(set);
    } else if (same != kept_set.end()) {
      kept[static_cast<std::size_t>(same - kept_set.begin())] |= inside;
    } else {
      kept[nearest(kept, places_[static_cast<unsigned>(std::countr_zero(inside))])] |= inside;
    }
  }
  const auto quarters = divide(kept.size(), [&](Vec centre) { return nearest(kept, centre); });
  own.resize(kept.size(), own[0]);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    own[i].inside = kept[i];
    own[i].quarters = quarters[i];
  }
  return own;
}

void CellParts::settle_specks() {
  std::vector<CellPart> all;
  std::vector<std::uint32_t> first_of_all;
  for (std::size_t voxel = 0; voxel + 1 < first.size(); ++voxel) {
    first_of_all.push_back(static_cast<std::uint32_t>(all.size()));
    for (const CellPart& part : settled(voxel)) all.push_back(part);
  }
  first_of_all.push_back(static_cast<std::uint32_t>(all.size()));
  parts = std::move(all);
  first = std::move(first_of_all);
}

// A cell with surface but no samples gets one part for each unconnected part of its neighbours.
void CellParts::find_empty_parts() {
  std::vector<CellPart> all;
  std::vector<std::uint32_t> first_of_all, renumbered(parts.size(), kNoPart);
  for (std::size_t voxel = 0; voxel + 1 < first.size(); ++voxel) {
    first_of_all.push_back(static_cast<std::uint32_t>(all.size()));
    const CellPart& part = parts[first[voxel]];
    if (part.inside == 0) {
      for (const CellPart& each : empty_parts(part)) all.push_back(each);
      continue;
    }
    for (std::uint32_t i = first[voxel]; i < first[voxel + 1]; ++i) {
      renumbered[i] = static_cast<std::uint32_t>(all.size());
      all.push_back(parts[i]);
    }
  }
  first_of_all.push_back(static_cast<std::uint32_t>(all.size()));
  for (CellPart& part : all) {
    if (part.host != kNoPart) part.host = renumbered[part.host];
  }
  parts = std::move(all);
  first = std::move(first_of_all);
}

std::vector<CellPart> CellParts::empty_parts(const CellPart& empty) const {
  std::vector<std::uint32_t> around;
  for (const CellStep& face : kFaces) {
    each_part(place_of(empty.cell), face, [&](std::uint32_t i) {
      if (parts[i].inside != 0) around.push_back(i);
    });
  }
  if (around.empty()) return {empty};
  const Block block = block_around(empty.cell);
  std::vector<std::uint32_t> sets, hosts;  // hosts: the fullest part of each set
  std::vector<std::size_t> number;         // for each part around: the number of its set
  for (const std::uint32_t i : around) {
    const std::uint32_t set = set_of(block, i);
    const auto known = std::find(sets.begin(), sets.end(), set);
    number.push_back(static_cast<std::size_t>(known - sets.begin()));
    if (known == sets.end()) {
      sets.push_back(set);
      hosts.push_back(i);
    }
    std::uint32_t& host = hosts[number.back()];
    if (std::popcount(parts[i].inside) > std::popcount(parts[host].inside)) host = i;
  }
  const auto quarters = divide(hosts.size(), [&](Vec centre) {
    const auto away = [&](std::uint32_t i) {
      return distance_to(parts[i].inside, places_, between(empty, parts[i]).vec(), centre);
    };
    const auto best =
        std::min_element(around.begin(), around.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return away(a) < away(b); });
    return number[static_cast<std::size_t>(best - around.begin())];
  });
  std::vector<CellPart> own(hosts.size(), empty);
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    own[i].host = hosts[i];
    own[i].quarters = quarters[i];
  }
  return own;
}

// Whether two parts of neighbouring cells touch; both have samples.
bool CellParts::touch(const CellPart& a, const CellPart& b) const {
  if (a.inside == kFullCell && b.inside == kFullCell) return true;
  return (reached(a.inside, near_[between(a, b).index()]) & b.inside) != 0;
}

CellParts::Block CellParts::block_around(std::uint32_t cell) const {
  Block block;
  for (int n = 0; n < 27; ++n) {
    each_part(place_of(cell), step_of(n), [&](std::uint32_t i) {
      if (parts[i].inside != 0) block.part.push_back(i);
    });
  }
  block.set = each_by_itself(block.part.size());
  for (std::uint32_t i = 0; i < block.part.size(); ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      const CellPart &a = parts[block.part[i]], &b = parts[block.part[j]];
      if (a.cell != b.cell && between(a, b).is_small() && touch(a, b)) join(block.set, i, j);
    }
  }
  for (std::uint32_t i = 0; i < block.set.size(); ++i) block.set[i] = root_of(block.set, i);
  return block;
}

std::uint32_t CellParts::set_of(const Block& block, std::uint32_t part) {
  const auto found = std::find(block.part.begin(), block.part.end(), part);
  if (found == block.part.end()) return kNoPart;
  return block.set[static_cast<std::size_t>(found - block.part.begin())];
}

bool CellParts::linked(std::uint32_t i, std::uint32_t j) const {
  if (i > j) std::swap(i, j);
  const CellPart &a = parts[i], &b = parts[j];
  if (a.cell == b.cell) return i == j;
  const int samples = std::min(std::popcount(a.inside), std::popcount(b.inside));
  const bool touching = samples > 0 && touch(a, b);
  if (touching || samples >= kLeastNeighbour) return touching;
  const std::uint32_t k = a.inside != 0 ? i : a.host, l = b.inside != 0 ? j : b.host;
  if (k == kNoPart || l == kNoPart || k == l) return true;
  const Block block = block_around(a.inside == 0 || b.inside != 0 ? a.cell : b.cell);
  const std::uint32_t one = set_of(block, k), other = set_of(block, l);
  return one == other || other == kNoPart;  // only the other cell's host can be out of the block
}

}  // namespace stylet::offline
