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

CellParts::CellParts(const Claims& claims, const SamplePlaces& places, const Lattice& lattice,
                     const Connections& connections)
    : claims_(claims),
      places_(places),
      lattice_(lattice),
      gaps_part_(connections.gaps_part),
      sides_(claims, connections.apart) {
  constexpr double kAnywhere = 10;  // farther than any sample of a cell beside it
  for (int i = 0; i < 27; ++i) {
    const CellStep step = step_of(i);
    near_[step.index()] = near_samples(places, step.vec(), gaps_part_ ? kReach : kAnywhere);
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

// The samples `bits` of a cell divided into connected parts.
std::vector<std::uint64_t> CellParts::connected(std::uint32_t cell, std::uint64_t bits) const {
  constexpr std::size_t kHere = 13;
  const std::span<const SideSamples> sides = sides_.in(cell);
  if (sides.size() == 1) return connected_parts(bits, near_[kHere]);
  std::vector<std::uint64_t> found;
  while (bits != 0) {
    std::uint64_t part = bits & (~bits + 1), before = 0;
    while (part != before) {
      before = part;
      for (const SideSamples& from : sides) {
        part |= reached(part & from.samples, near_[kHere]) & sides_.joined(cell, from.side) & bits;
      }
    }
    found.push_back(part);
    bits &= ~part;
  }
  return found;
}

void CellParts::find_parts() {
  for (const std::uint32_t cell : lattice_.cell_of_voxel) {
    first.push_back(static_cast<std::uint32_t>(parts.size()));
    const std::uint64_t bits = claims_.inside[cell];
    if (bits == 0 || (bits == kFullCell && sides_.in(cell).size() == 1)) {
      parts.push_back(
          {cell, kNoPart, kNoSheet, false, bits, sides_.sides(cell, bits), kFullCell, {}});
      continue;
    }
    for (const std::uint64_t part : connected(cell, bits)) {
      parts.push_back(
          {cell, kNoPart, kNoSheet, false, part, sides_.sides(cell, part), kFullCell, {}});
    }
  }
  first.push_back(static_cast<std::uint32_t>(parts.size()));
}

// Joins specks to a larger part of their cell: to the connected part, or, if none is connected, to
// the nearest part that they are not apart from.
std::vector<CellPart> CellParts::settled(std::size_t voxel) {
  std::vector<CellPart> own(parts.begin() + first[voxel], parts.begin() + first[voxel + 1]);
  if (own.size() == 1) return own;
  const Block block = block_around({own[0].cell});
  std::vector<std::uint32_t> order(own.size());
  std::iota(order.begin(), order.end(), first[voxel]);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::popcount(parts[a].inside) > std::popcount(parts[b].inside);
  });
  std::vector<CellPart> kept;
  std::vector<std::uint32_t> kept_set;
  for (const std::uint32_t i : order) {
    const CellPart& part = parts[i];
    const std::uint32_t set = set_of(block, i);
    const auto same = same_set(kept, kept_set, part, set);
    const bool is_alone = std::count(block.set.begin(), block.set.end(), set) == 1;
    if (kept.empty() || std::popcount(part.inside) >= kLeastPart ||
        (same == kept.size() && !is_alone)) {
      kept.push_back(part);
      kept_set.push_back(set);
    } else if (same < kept.size()) {
      kept[same].inside |= part.inside;
      kept[same].sides |= part.sides;
    } else {
      join_nearest(part, kept);
    }
  }
  std::vector<std::uint64_t> bits;
  for (const CellPart& each : kept) bits.push_back(each.inside);
  const auto quarters = divide(kept.size(), [&](Vec centre) { return nearest(bits, centre); });
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i].quarters = quarters[i];
  return kept;
}

// The index in `kept` of the first part of a set that `part` is not apart from; kept.size() if
// there is none.
std::size_t CellParts::same_set(const std::vector<CellPart>& kept,
                                const std::vector<std::uint32_t>& kept_set, const CellPart& part,
                                std::uint32_t set) const {
  std::size_t i = 0;
  while (i < kept.size() && (kept_set[i] != set || apart(kept[i], part))) ++i;
  return i;
}

void CellParts::join_nearest(const CellPart& speck, std::vector<CellPart>& kept) {
  std::vector<std::uint64_t> bits;
  for (const CellPart& each : kept) bits.push_back(apart(each, speck) ? 0 : each.inside);
  CellPart& there =
      kept[nearest(bits, places_[static_cast<unsigned>(std::countr_zero(speck.inside))])];
  if (apart(there, speck)) {
    strays.push_back({speck.cell, speck.inside});
  } else {
    there.inside |= speck.inside;
    there.sides |= speck.sides;
  }
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
  const std::vector<std::uint32_t> set = sets_around(empty.cell, around);
  std::vector<std::uint32_t> sets, hosts;  // hosts: the fullest part of each set
  std::vector<std::size_t> number;         // for each part around: the number of its set
  for (std::size_t n = 0; n < around.size(); ++n) {
    const std::uint32_t i = around[n];
    const auto known = std::find(sets.begin(), sets.end(), set[n]);
    number.push_back(static_cast<std::size_t>(known - sets.begin()));
    if (known == sets.end()) {
      sets.push_back(set[n]);
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
    own[i].sides = parts[hosts[i]].sides;
    own[i].quarters = quarters[i];
  }
  return own;
}

// Which of the parts around a cell without samples are connected, as numbers of sets.
std::vector<std::uint32_t> CellParts::sets_around(std::uint32_t cell,
                                                  const std::vector<std::uint32_t>& around) const {
  const Block block = block_around({cell});
  std::vector<std::uint32_t> parent = each_by_itself(around.size());
  for (std::uint32_t i = 0; i < around.size(); ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      const bool near = !gaps_part_ || set_of(block, around[i]) == set_of(block, around[j]);
      if (near && !apart(parts[around[i]], parts[around[j]])) join(parent, i, j);
    }
  }
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root_of(parent, i);
  return parent;
}

bool CellParts::apart(const CellPart& a, const CellPart& b) const {
  return sides_.owners().apart(a.sides, b.sides);
}

// Whether two parts of neighbouring cells touch; both have samples.
bool CellParts::touch(const CellPart& a, const CellPart& b) const {
  if (apart(a, b)) return false;
  const std::span<const SideSamples> sides = sides_.in(a.cell);
  const bool simple = sides.size() == 1 && sides_.in(b.cell).size() == 1;
  if (simple && a.inside == kFullCell && b.inside == kFullCell) return true;
  const Near& near = near_[between(a, b).index()];
  if (simple) return (reached(a.inside, near) & b.inside) != 0;
  return std::ranges::any_of(sides, [&](const SideSamples& from) {
    const std::uint64_t there = sides_.joined(b.cell, from.side) & b.inside;
    return (reached(a.inside & from.samples, near) & there) != 0;
  });
}

CellParts::Block CellParts::block_around(const std::vector<std::uint32_t>& cells) const {
  Block block;
  for (const std::uint32_t cell : cells) {
    for (int n = 0; n < 27; ++n) {
      each_part(place_of(cell), step_of(n), [&](std::uint32_t i) {
        if (parts[i].inside != 0) block.part.push_back(i);
      });
    }
  }
  std::sort(block.part.begin(), block.part.end());
  block.part.erase(std::unique(block.part.begin(), block.part.end()), block.part.end());
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
  if (apart(a, b)) return false;
  const int samples = std::min(std::popcount(a.inside), std::popcount(b.inside));
  const bool touching = samples > 0 && touch(a, b);
  if (touching || samples >= kLeastNeighbour) return touching;
  if (!gaps_part_) return samples == 0;
  const std::uint32_t k = a.inside != 0 ? i : a.host, l = b.inside != 0 ? j : b.host;
  if (k == kNoPart || l == kNoPart || k == l) return true;
  const Block block = block_around({a.cell, b.cell});
  return set_of(block, k) == set_of(block, l);
}

}  // namespace stylet::offline
