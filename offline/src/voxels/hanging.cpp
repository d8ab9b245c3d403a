// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/hanging.h"

#include "stylet/levels.h"
#include "voxels/attach.h"

namespace stylet::offline {
namespace {

using Place = std::array<std::uint32_t, 3>;  // of a node or a cell in its level

// One flag for each node of a level.
std::vector<bool> nodes_of(const Lattice& lattice) {
  const Grid& grid = lattice.grid;
  std::vector<bool> nodes(corner_index(grid, grid.size[0], grid.size[1], grid.size[2]) + 1, false);
  for (const std::uint32_t cell : lattice.cell_of_voxel) {
    const std::uint32_t x = cell % grid.size[0], row = cell / grid.size[0];
    const std::uint32_t y = row % grid.size[1], z = row / grid.size[1];
    for (std::uint32_t c = 0; c < 8; ++c) {
      nodes[corner_index(grid, x + (c & 1U), y + (c >> 1U & 1U), z + (c >> 2U))] = true;
    }
  }
  return nodes;
}

// A voxel of a coarser level that a node touches. On a face between two cells, either may be it.
bool find_touched(const Lattice& coarser, std::uint32_t ratio, const Place& node, Place& cell_out) {
  const Grid& grid = coarser.grid;
  for (std::uint32_t side = 0; side < 8; ++side) {
    bool within = true;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const bool below = (side >> axis & 1U) != 0;
      const bool on_face = node[axis] % ratio == 0;
      cell_out[axis] =
          node[axis] / ratio - (below && on_face ? 1U : 0U);  // below 0: wraps beyond the size
      within = within && cell_out[axis] < grid.size[axis];
    }
    if (within && coarser.voxel_of_cell[cell_index(grid, cell_out[0], cell_out[1], cell_out[2])] !=
                      kNoVoxel) {
      return true;
    }
  }
  return false;
}

}  // namespace

LatticeSize lattice_size(std::span<const Lattice> levels) {
  const auto count = static_cast<std::uint32_t>(levels.size());
  const Lattice& coarsest = levels.front();
  if (count == 1) return {coarsest.grid.size[0], coarsest.sheet_rows, coarsest.grid.size[2]};
  const auto& finest = levels.back().grid.size;
  return {finest[0], std::max(coarsest.sheet_rows, finest[1]),
          first_plane(coarsest.grid.size[2], count) - 1};
}

namespace {

// A list of each level one behind the other, as the levels lie in the lattice.
template <typename Place>
std::vector<Place> of_all(std::span<const Lattice> levels, std::vector<Place> Lattice::*list) {
  std::vector<Place> all;
  for (std::uint32_t level = 0; level < levels.size(); ++level) {
    const std::uint32_t first = first_plane(levels.front().grid.size[2], level);
    for (Place each : levels[level].*list) {
      each.z = static_cast<std::uint16_t>(first + each.z);
      all.push_back(each);
    }
  }
  return all;
}

}  // namespace

std::vector<OrganRun> runs_of(std::span<const Lattice> levels) {
  return of_all(levels, &Lattice::runs);
}

std::vector<OrganTie> ties_of(std::span<const Lattice> levels) {
  return of_all(levels, &Lattice::ties);
}

std::vector<OrganPart> parts_of(std::span<const Lattice> levels) {
  return of_all(levels, &Lattice::parts);
}

namespace {

// The voxel on which a node of a level hangs, with its place in the lattice; false if on none.
bool find_coarsest(std::span<const Lattice> levels, std::uint32_t level, const Place& node,
                   Place& voxel_out) {
  for (std::uint32_t coarse = 0; coarse < level; ++coarse) {
    if (!find_touched(levels[coarse], 1U << (level - coarse), node, voxel_out)) continue;
    voxel_out[2] += first_plane(levels.front().grid.size[2], coarse);
    return true;
  }
  return false;
}

}  // namespace

std::vector<OrganHanging> hanging_nodes(std::span<const Lattice> levels) {
  std::vector<OrganHanging> hanging;
  const auto u16 = [](std::uint32_t value) { return static_cast<std::uint16_t>(value); };
  for (std::uint32_t level = 1; level < levels.size(); ++level) {
    const std::uint32_t planes = levels.front().grid.size[2], first = first_plane(planes, level);
    if (levels[level].hanging) {
      for (OrganHanging each : *levels[level].hanging) {
        each.z = u16(first + each.z);
        each.voxel_z = u16(first_plane(planes, level - 1) + each.voxel_z);
        hanging.push_back(each);
      }
      continue;
    }
    const std::vector<bool> nodes = nodes_of(levels[level]);
    const auto& size = levels[level].grid.size;
    std::size_t i = 0;
    for (std::uint32_t z = 0; z <= size[2]; ++z) {
      for (std::uint32_t y = 0; y <= size[1]; ++y) {
        for (std::uint32_t x = 0; x <= size[0]; ++x, ++i) {
          Place voxel{};
          if (!nodes[i] || !find_coarsest(levels, level, {x, y, z}, voxel)) continue;
          hanging.push_back(
              {u16(x), u16(y), u16(first + z), u16(voxel[0]), u16(voxel[1]), u16(voxel[2])});
        }
      }
    }
  }
  return hanging;
}

}  // namespace stylet::offline
