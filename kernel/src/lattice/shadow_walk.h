// SPDX-License-Identifier: Apache-2.0
// Shadows of a graded lattice (lattice/shadow.h), found from the organ's runs.
//
// A shadow cell is a cell of some level in which there are finer voxels. A place is given as in the
// file: x and y in edges of its level, y with its sheet, z in the lattice.
//
// Promises: each cell, corner and node is visited once, in an order that depends on the runs alone;
// no allocation. At creation only.
#pragma once

#include <cstdint>

#include "base/function.h"
#include "organ/runs.h"
#include "state/layout.h"

namespace stylet {

struct LatticePlace {
  std::uint32_t x, y, z;
};

// The same in space: y without its sheet, z from where its level begins.
struct LevelPlace {
  std::uint32_t level, sheet, x, y, z;
};

inline LevelPlace place_in_level(const Organ& organ, const LatticePlace& at) {
  const std::uint32_t level = level_of(organ.level_planes, at.z);
  const std::uint32_t y = line_in_space(organ, at.y);
  return {level, (at.y - y) / organ.sheet_rows, at.x, y,
          at.z - first_plane(organ.level_planes, level)};
}
inline LatticePlace place_in_lattice(const Organ& organ, const LevelPlace& at) {
  return {at.x, at.y + at.sheet * organ.sheet_rows,
          at.z + first_plane(organ.level_planes, at.level)};
}

bool is_shadow_cell(const Organ& organ, const LevelPlace& cell);
// The corner (bits x, y, z) of a cell.
LevelPlace corner_of(const LevelPlace& cell, std::uint32_t corner);

using VisitPlace = Function<void(const LevelPlace&)>;
// Calls visit(place) for each shadow cell of a level; below, for each corner of these.
void for_each_shadow_cell(const Organ& organ, std::uint32_t level, VisitPlace visit);
void for_each_shadow_corner(const Organ& organ, std::uint32_t level, VisitPlace visit);
// Calls visit(place) for each node of a level's voxels.
void for_each_level_node(const Organ& organ, std::uint32_t level, VisitPlace visit);
// Calls visit(place of a level coarser by one, weight) for the places that a node lies between.
void for_each_parent(const LevelPlace& node, Function<void(const LevelPlace&, float)> visit);

}  // namespace stylet
