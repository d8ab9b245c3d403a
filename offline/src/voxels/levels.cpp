// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/levels.h"

#include "base/refusal.h"
#include "stylet/levels.h"
#include "stylet/limits.h"

namespace stylet::offline {

std::vector<Grid> level_grids(const Grid& coarsest, std::uint32_t halvings) {
  std::vector<Grid> grids = {coarsest};
  if (halvings == 0) return grids;
  constexpr std::size_t kMostPerAxis = 65535;
  const auto& size = coarsest.size;
  const std::size_t planes = first_plane(size[2], halvings + 1) - 1;
  const std::size_t rows = (std::size_t{size[1]} << halvings) * planes;
  const std::size_t cells = cell_count(coarsest) << (3 * halvings);
  const double finest_m = coarsest.edge_m / (1U << halvings);
  if (std::max(size[0], size[1]) << halvings > kMostPerAxis || planes > kMostPerAxis ||
      rows > kMaxRows || cells > kMaxCells || static_cast<float>(finest_m) < kMinVoxelEdgeM) {
    refuse<TooFine>(
        "--refine: voxel edge {:.6g} mm, halved {} times: {:.6g} mm, and {} lattice cells: "
        "expected at least {:g} mm and at most {} cells: fewer LEVELS, or a larger voxel edge",
        coarsest.edge_m * 1e3, halvings, finest_m * 1e3, cells,
        static_cast<double>(kMinVoxelEdgeM) * 1e3, kMaxCells);
  }
  for (std::uint32_t level = 1; level <= halvings; ++level) {
    Grid finer = grids.back();
    finer.edge_m /= 2;
    for (std::uint32_t& each : finer.size) each *= 2;
    grids.push_back(finer);
  }
  return grids;
}

std::vector<std::uint8_t> inherited(const std::vector<std::uint8_t>& coarsest, const Grid& grid,
                                    std::uint32_t level) {
  if (level == 0 || coarsest.empty()) return coarsest;
  Grid whole = grid;
  for (std::uint32_t& each : whole.size) each >>= level;
  std::vector<std::uint8_t> of_cells(cell_count(grid));
  std::size_t cell = 0;
  for (std::uint32_t z = 0; z < grid.size[2]; ++z) {
    for (std::uint32_t y = 0; y < grid.size[1]; ++y) {
      for (std::uint32_t x = 0; x < grid.size[0]; ++x, ++cell) {
        of_cells[cell] = coarsest[cell_index(whole, x >> level, y >> level, z >> level)];
      }
    }
  }
  return of_cells;
}

Splitting::Splitting(const std::vector<Claims>& levels, const std::vector<Vec>& points_m,
                     const std::vector<std::uint8_t>& cut)
    : cut_(cut) {
  for (const Claims& claims : levels) {
    grids_.push_back(claims.grid);
    split_.emplace_back(cell_count(claims.grid), std::uint8_t{0});
    occupied_.push_back(split_.back());
    for (const Vec& point_m : points_m) occupied_.back()[cell_of(claims.grid, point_m)] = 1;
  }
  for (std::uint32_t level = static_cast<std::uint32_t>(levels.size()); level-- > 0;) {
    const std::vector<std::uint8_t> gone = inherited(cut, grids_[level], level);
    for (std::size_t cell = 0; cell < occupied_[level].size(); ++cell) {
      std::uint8_t& here = occupied_[level][cell];
      here = (here != 0 || is_kept(levels[level], cell)) && (gone.empty() || gone[cell] == 0);
      if (here != 0 && level > 0) occupied_[level - 1][around(level, place(level, cell))] = 1;
    }
  }
}

std::array<std::uint32_t, 3> Splitting::place(std::uint32_t level, std::size_t cell) const {
  const auto& size = grids_[level].size;
  const auto x = static_cast<std::uint32_t>(cell % size[0]);
  const auto row = static_cast<std::uint32_t>(cell / size[0]);
  return {x, row % size[1], row / size[1]};
}

std::size_t Splitting::around(std::uint32_t level, const std::array<std::uint32_t, 3>& at) const {
  return cell_index(grids_[level - 1], at[0] / 2, at[1] / 2, at[2] / 2);
}

void Splitting::split_around(std::uint32_t level, std::size_t cell) {
  split(level - 1, around(level, place(level, cell)));
}

// All cells that touch this one must be of its level: so those around them are split.
void Splitting::split_beside(std::uint32_t level, std::size_t cell) {
  const auto& size = grids_[level].size;
  const auto [x, y, z] = place(level, cell);
  for (std::uint32_t n = 0; n < 27; ++n) {
    // An index below 0 wraps to one beyond the size.
    const std::array<std::uint32_t, 3> at = {x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1};
    if (at[0] < size[0] && at[1] < size[1] && at[2] < size[2]) split(level - 1, around(level, at));
  }
}

LevelCells Splitting::balanced() {
  for (auto level = static_cast<std::uint32_t>(grids_.size() - 1); level-- > 1;) {
    for (std::size_t cell = 0; cell < split_[level].size(); ++cell) {
      if (split_[level][cell] != 0) split_beside(level, cell);
    }
  }
  LevelCells absent = split_;
  for (std::uint32_t level = 0; level < absent.size(); ++level) {
    const std::vector<std::uint8_t> gone = inherited(cut_, grids_[level], level);
    for (std::size_t cell = 0; cell < absent[level].size(); ++cell) {
      const bool too_fine = level > 0 && split_[level - 1][around(level, place(level, cell))] == 0;
      const bool is_gone = !gone.empty() && gone[cell] != 0;
      if (too_fine || is_gone) absent[level][cell] = 1;
    }
  }
  return absent;
}

}  // namespace stylet::offline
