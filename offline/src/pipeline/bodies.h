// SPDX-License-Identifier: GPL-3.0-or-later
// What a recipe takes from a label map beside tissue: bodies that no needle enters, as convex
// hulls, and targets, as the place and size of what is to be reached; and the scene that has both.
// Units: metres. Frame: the patient's (LPS).
#pragma once

#include <map>

#include "maps/groups.h"
#include "maps/label_map.h"
#include "maps/recipe.h"
#include "meshes/hull.h"

namespace stylet::bake {

// A convex piece of an obstacle. What is hollow or bent would fill its hull with tissue that no
// needle enters: it is cut across its longest axis, where that saves most, as long as the kernel
// takes more bodies.
struct NamedHull {
  std::string name;      // of the obstacle, with a number where it has several pieces
  std::string obstacle;  // of the recipe
  Hull hull;
  double label_m3 = 0;                         // of the labels in this piece
  std::map<std::string, double> swallowed_m3;  // tissues in the hull
};

// A hull may hold so much more than its labels before it is cut: a convex body of a few voxels has
// a third more, by the corners of their steps.
constexpr double kMostHullRatio = 1.35;

struct Target {
  std::string name;
  Vec middle_m;  // of its voxel that is nearest to the centroid
  double volume_m3 = 0;
  double radius_m = 0;  // of the ball of this volume
};

// In the recipe's order, without those that are not in the map. `path` is for messages.
std::vector<NamedHull> find_obstacles(const std::string& path, const LabelMap& map,
                                      const Recipe& recipe, const Groups& groups);
// Of hulls that are off the volume of their labels, and which tissues lie in them.
void warn_of_obstacles(const std::vector<NamedHull>& hulls, std::vector<std::string>& warnings);
std::vector<Target> find_targets(const LabelMap& map, const Recipe& recipe);

// A scene that runs the organ file `organ`, with the hulls from `hull_files`; its needle goes from
// the front through the first target.
std::string scene_toml(const std::string& organ, const std::vector<std::string>& hull_files,
                       const std::vector<Target>& targets);

}  // namespace stylet::bake
