// SPDX-License-Identifier: Apache-2.0
#include "lattice/shadow_walk.h"

namespace stylet {
namespace {

// Whether a row of a level is within its space.
bool has_row(const Organ& organ, std::uint32_t level, std::uint32_t y, std::uint32_t z) {
  return y < organ.sheet_rows && z < std::uint32_t{organ.level_planes} << level;
}
bool has_voxel(const Organ& organ, const LevelPlace& at) {
  if (!has_row(organ, at.level, at.y, at.z)) return false;
  const LatticePlace place = place_in_lattice(organ, at);
  return has_voxel(organ, {at.x, at.x + 1}, place.y, place.z);
}

// Whether a level has a voxel in a coarser cell, in the first `rows` rows of the cell (y first,
// then z).
bool has_voxel_in(const Organ& organ, const LevelPlace& cell, std::uint32_t level,
                  std::uint32_t rows) {
  const std::uint32_t ratio = 1U << (level - cell.level);
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::uint32_t y = cell.y * ratio + row % ratio, z = cell.z * ratio + row / ratio;
    if (!has_row(organ, level, y, z)) continue;
    const LatticePlace at = place_in_lattice(organ, {level, cell.sheet, cell.x * ratio, y, z});
    if (has_voxel(organ, {at.x, at.x + ratio}, at.y, at.z)) return true;
  }
  return false;
}
// Whether a run is the first with a voxel in a cell: no run of a coarser level has one, and no run
// of the same level before it.
bool is_first_in(const Organ& organ, const LevelPlace& cell, const OrganRun& run) {
  const LevelPlace own = place_in_level(organ, {run.x, run.y, run.z});
  for (std::uint32_t level = cell.level + 1; level < own.level; ++level) {
    const std::uint32_t ratio = 1U << (level - cell.level);
    if (has_voxel_in(organ, cell, level, ratio * ratio)) return false;
  }
  const std::uint32_t ratio = 1U << (own.level - cell.level);
  const std::uint32_t row = own.z % ratio * ratio + own.y % ratio;
  if (has_voxel_in(organ, cell, own.level, row)) return false;
  const std::uint32_t begin = cell.x * ratio;
  return run.x <= begin || !has_voxel(organ, {begin, run.x}, run.y, run.z);
}

// Whether a cell is the first of those around its corner (bits x, y, z) for which exists(cell).
bool owns_corner(const LevelPlace& cell, std::uint32_t corner,
                 Function<bool(const LevelPlace&)> exists) {
  const std::uint32_t x = cell.x + (corner & 1U), y = cell.y + ((corner >> 1U) & 1U),
                      z = cell.z + (corner >> 2U);
  for (std::uint32_t side = 7; side > corner; --side) {  // the lowest cell first
    const std::uint32_t dx = side & 1U, dy = (side >> 1U) & 1U, dz = side >> 2U;
    if (x < dx || y < dy || z < dz) continue;
    if (exists(LevelPlace{cell.level, cell.sheet, x - dx, y - dy, z - dz})) return false;
  }
  return true;
}

}  // namespace

bool is_shadow_cell(const Organ& organ, const LevelPlace& cell) {
  for (std::uint32_t level = cell.level + 1; level < organ.levels; ++level) {
    const std::uint32_t ratio = 1U << (level - cell.level);
    if (has_voxel_in(organ, cell, level, ratio * ratio)) return true;
  }
  return false;
}

void for_each_shadow_cell(const Organ& organ, std::uint32_t level, VisitPlace visit) {
  for (const OrganRun& run : organ.runs) {
    const LevelPlace own = place_in_level(organ, {run.x, run.y, run.z});
    if (own.level <= level) continue;
    const std::uint32_t finer = own.level - level;
    const std::uint32_t end = (own.x + run.count - 1U) >> finer;
    for (std::uint32_t x = own.x >> finer; x <= end; ++x) {
      const LevelPlace cell = {level, own.sheet, x, own.y >> finer, own.z >> finer};
      if (is_first_in(organ, cell, run)) visit(cell);
    }
  }
}

LevelPlace corner_of(const LevelPlace& cell, std::uint32_t corner) {
  return {cell.level, cell.sheet, cell.x + (corner & 1U), cell.y + ((corner >> 1U) & 1U),
          cell.z + (corner >> 2U)};
}

void for_each_shadow_corner(const Organ& organ, std::uint32_t level, VisitPlace visit) {
  for_each_shadow_cell(organ, level, [&](const LevelPlace& cell) {
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      const auto exists = [&](const LevelPlace& other) { return is_shadow_cell(organ, other); };
      if (owns_corner(cell, corner, exists)) visit(corner_of(cell, corner));
    }
  });
}

void for_each_level_node(const Organ& organ, std::uint32_t level, VisitPlace visit) {
  for (const OrganRun& run : organ.runs) {
    const LevelPlace first = place_in_level(organ, {run.x, run.y, run.z});
    if (first.level != level) continue;
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const LevelPlace cell = {level, first.sheet, first.x + i, first.y, first.z};
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const auto exists = [&](const LevelPlace& other) { return has_voxel(organ, other); };
        if (owns_corner(cell, corner, exists)) visit(corner_of(cell, corner));
      }
    }
  }
}

void for_each_parent(const LevelPlace& node, Function<void(const LevelPlace&, float)> visit) {
  const std::uint32_t odd = (node.x & 1U) | ((node.y & 1U) << 1U) | ((node.z & 1U) << 2U);
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    if ((corner & ~odd) != 0) continue;
    float weight = 1;
    for (std::uint32_t a = 0; a < 3; ++a) weight *= ((odd >> a) & 1U) != 0 ? 0.5F : 1.0F;
    visit(LevelPlace{node.level - 1, node.sheet, node.x / 2 + (corner & 1U),
                     node.y / 2 + ((corner >> 1U) & 1U), node.z / 2 + (corner >> 2U)},
          weight);
  }
}

}  // namespace stylet
