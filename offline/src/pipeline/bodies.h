// SPDX-License-Identifier: GPL-3.0-or-later
// What a recipe takes from a label map besides tissue: obstacles, as convex hulls that no needle
// enters, and targets, as position and size of what is to be reached; and the scene with both.
// Units: metres. Frame: the patient's (LPS).
#pragma once

#include <map>

#include "maps/groups.h"
#include "maps/label_map.h"
#include "maps/recipe.h"
#include "meshes/hull.h"

namespace stylet::offline {

// A convex piece of an obstacle. The hull of a hollow or bent obstacle would hold tissue that the
// needle then cannot enter. So it is cut across its longest axis, where that saves most volume, as
// long as the kernel accepts more bodies.
struct NamedHull {
  std::string name;      // the obstacle's, with a number if it has several pieces
  std::string obstacle;  // its name in the recipe
  Hull hull;
  double label_m3 = 0;                         // volume of the labels in this piece
  std::map<std::string, double> swallowed_m3;  // volume of each tissue in the hull
};

// A hull may have this many times the volume of its labels before it is cut: the hull of a convex
// body of a few voxels has a third more, because of the corners of the voxels.
constexpr double kMostHullRatio = 1.35;

struct Target {
  std::string name;
  Vec middle_m;  // middle of the target's voxel that is nearest to its centroid
  double volume_m3 = 0;
  double radius_m = 0;  // of a ball with this volume
  bool in_tissue = false;
};

// In the recipe's order, without obstacles that are not in the map. `path` is for messages.
std::vector<NamedHull> find_obstacles(const std::string& path, const LabelMap& map,
                                      const Recipe& recipe, const Groups& groups);
// Warns of hulls whose volume differs from that of their labels, and of the tissues in them.
void warn_of_obstacles(const std::vector<NamedHull>& hulls, std::vector<std::string>& warnings);
std::vector<Target> find_targets(const LabelMap& map, const Recipe& recipe);
// Warns of targets that lie outside the organ.
void warn_of_targets(const std::vector<Target>& targets, std::vector<std::string>& warnings);

// A scene with the organ file `organ` and the hulls in `hull_files`; its needle goes from the front
// through the first target that lies in tissue.
std::string scene_toml(const std::string& organ, const std::vector<std::string>& hull_files,
                       const std::vector<Target>& targets);

}  // namespace stylet::offline
