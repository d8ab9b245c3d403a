// SPDX-License-Identifier: GPL-3.0-or-later
// What a recipe takes from a label map beside tissue: bodies that no needle enters, as convex
// hulls, and targets, as the place and size of what is to be reached; and the scene that has both.
// Units: metres. Frame: the patient's (LPS).
#pragma once

#include "hull.h"
#include "label_map.h"
#include "label_recipe.h"

namespace stylet::bake {

struct NamedHull {
  std::string name;
  Hull hull;
};

struct Target {
  std::string name;
  Vec middle_m;  // of its voxel that is nearest to the centroid
  double volume_m3 = 0;
  double radius_m = 0;  // of the ball of this volume
};

// In the recipe's order, without those that are not in the map. `path` is for messages.
std::vector<NamedHull> find_obstacles(const std::string& path, const LabelMap& map,
                                      const Recipe& recipe);
std::vector<Target> find_targets(const LabelMap& map, const Recipe& recipe);

// A scene that runs the organ file `organ`, with the hulls from `hull_files`; its needle goes from
// the front through the first target.
std::string scene_toml(const std::string& organ, const std::vector<std::string>& hull_files,
                       const std::vector<Target>& targets);

}  // namespace stylet::bake
