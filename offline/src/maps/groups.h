// SPDX-License-Identifier: GPL-3.0-or-later
// Which tissue of a recipe each voxel of a label map belongs to, and which voxel a place is in.
// Units: metres. Frame: the patient's (LPS).
#pragma once

#include "maps/label_map.h"
#include "maps/recipe.h"

namespace stylet::offline {

// For each voxel: the index of its group in the recipe plus one; 0 means no group.
using Groups = std::vector<std::uint8_t>;

// The part of the map in the box (along its axes) around the recipe's crop labels with the margin.
LabelMap cropped(const std::string& path, const LabelMap& map, const Recipe& recipe);

// `path` is for messages. Refuses a recipe none of whose labels is in the map.
Groups groups_of(const std::string& path, const LabelMap& map, const Recipe& recipe);

// From the patient's frame to the map's indices.
struct ToIndex {
  Vec origin_m;
  std::array<Vec, 3> row;

  explicit ToIndex(const LabelMap& map);
};

// Group of the voxel around a place; 0 outside the map.
std::uint8_t group_at(const LabelMap& map, const Groups& groups, const ToIndex& to_index,
                      Vec point_m);

}  // namespace stylet::offline
