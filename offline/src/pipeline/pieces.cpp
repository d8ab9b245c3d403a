// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pieces.h"

#include <bit>

#include "base/disjoint_set.h"

namespace stylet::offline {
namespace {

bool owns(const Claims& claims, std::uint16_t owner, Vec point_m) {
  const Vec at = to_lattice(claims.grid, point_m);
  std::size_t index = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    const double size = claims.grid.size[axis];
    const double cell = std::clamp(std::floor(at[axis]), 0.0, size - 1);
    index = index * claims.grid.size[axis] + static_cast<std::size_t>(cell);
  }
  return is_kept(claims, index) && claims.owner[index] == owner;
}

// ---- label maps ---------------------------------------------------------------------------------

class MapPieces {
 public:
  MapPieces(const Claims& claims, const LabelMap& map, const Groups& groups)
      : claims_(claims), map_(map), left_(groups) {}

  std::vector<PieceCount> count(std::size_t group_count) {
    std::vector<PieceCount> counts(group_count);
    for (std::size_t i = 0; i < left_.size(); ++i) {
      if (left_[i] == 0) continue;
      PieceCount& of_group = counts[left_[i] - 1U];
      ++of_group.pieces;
      of_group.lost += take_piece(i) ? 0 : 1;
    }
    return counts;
  }

 private:
  // Removes the piece around a map voxel; returns whether any of it is in a lattice voxel it owns.
  bool take_piece(std::size_t seed) {
    const std::uint8_t group = left_[seed];
    bool kept = false;
    left_[seed] = 0;
    stack_.push_back(seed);
    while (!stack_.empty()) {
      const std::size_t i = stack_.back();
      stack_.pop_back();
      const std::array<std::int64_t, 3> at = {
          static_cast<std::int64_t>(i % map_.size[0]),
          static_cast<std::int64_t>(i / map_.size[0] % map_.size[1]),
          static_cast<std::int64_t>(i / map_.size[0] / map_.size[1])};
      kept = kept || owns(claims_, static_cast<std::uint16_t>(group - 1), place_m(at));
      for (int n = 0; n < 27; ++n) {
        take(group, at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1);
      }
    }
    return kept;
  }

  void take(std::uint8_t group, std::int64_t x, std::int64_t y, std::int64_t z) {
    const auto& size = map_.size;
    if (x < 0 || y < 0 || z < 0 || x >= size[0] || y >= size[1] || z >= size[2]) return;
    const auto i = static_cast<std::size_t>((z * size[1] + y) * size[0] + x);
    if (left_[i] != group) return;
    left_[i] = 0;
    stack_.push_back(i);
  }

  Vec place_m(const std::array<std::int64_t, 3>& at) const {
    Vec place = map_.origin_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place = place + map_.step_m[axis] * static_cast<double>(at[axis]);
    }
    return place;
  }

  const Claims& claims_;
  const LabelMap& map_;
  Groups left_;  // groups of voxels not yet visited
  std::vector<std::size_t> stack_;
};

// ---- gaps ---------------------------------------------------------------------------------------

bool is_split(std::uint64_t bits, const Near& near) {
  int large_parts = 0;
  for (const std::uint64_t part : connected_parts(bits, near)) {
    large_parts += std::popcount(part) >= kLeastPart ? 1 : 0;
  }
  return large_parts > 1;
}

bool is_gap(std::uint64_t bits, std::uint64_t next, const Near& across) {
  return std::popcount(bits) >= kLeastNeighbour && std::popcount(next) >= kLeastNeighbour &&
         (reached(bits, across) & next) == 0;
}

}  // namespace

PieceCount mesh_pieces(const Claims& claims, std::uint16_t owner, const Mesh& surface_m) {
  std::vector<std::uint32_t> parent = each_by_itself(surface_m.points.size());
  std::vector<bool> used(surface_m.points.size(), false);
  for (const Triangle& t : surface_m.triangles) {
    join(parent, t[0], t[1]);
    join(parent, t[0], t[2]);
    used[t[0]] = used[t[1]] = used[t[2]] = true;
  }
  std::vector<bool> kept(surface_m.points.size(), false);
  for (std::uint32_t i = 0; i < parent.size(); ++i) {
    if (owns(claims, owner, surface_m.points[i])) kept[root_of(parent, i)] = true;
  }
  PieceCount count;
  for (std::uint32_t i = 0; i < parent.size(); ++i) {
    if (parent[i] != i || !used[i]) continue;
    ++count.pieces;
    count.lost += kept[i] ? 0 : 1;
  }
  return count;
}

std::vector<PieceCount> label_pieces(const Claims& claims, const LabelMap& map,
                                     const Groups& groups, std::size_t group_count) {
  return MapPieces(claims, map, groups).count(group_count);
}

std::size_t closed_gaps(const Claims& claims, const SamplePlaces& places) {
  const Grid& grid = claims.grid;
  const std::size_t row = grid.size[0], plane = row * grid.size[1];
  const Near near = near_samples(places, {}, kReach);
  const Near across[3] = {near_samples(places, {1, 0, 0}, kReach),
                          near_samples(places, {0, 1, 0}, kReach),
                          near_samples(places, {0, 0, 1}, kReach)};
  std::size_t gaps = 0;
  for (std::size_t cell = 0; cell < claims.inside.size(); ++cell) {
    const std::uint64_t bits = claims.inside[cell];
    if (bits == 0) continue;
    gaps += is_split(bits, near) ? 1 : 0;
    const std::size_t steps[3] = {1, row, plane};
    const bool has_next[3] = {cell % row + 1 < row, cell / row % grid.size[1] + 1 < grid.size[1],
                              cell / plane + 1 < grid.size[2]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!has_next[axis]) continue;
      gaps += is_gap(bits, claims.inside[cell + steps[axis]], across[axis]) ? 1 : 0;
    }
  }
  return gaps;
}

}  // namespace stylet::offline
