// SPDX-License-Identifier: GPL-3.0-or-later
// Adds a wall around all labels of a map: segmentations of organs often leave out the skin, fat and
// muscle that a needle meets first. The wall is made up: it is all space without a label nearer to
// a label than the layers' total thickness. Layers are counted from the outside, as thick as the
// recipe says; the innermost also fills what is deeper, such as gaps between organs.
// Units: metres. Time: linear in voxels.
#pragma once

#include "maps/label_map.h"
#include "maps/recipe.h"

namespace stylet::offline {

// Adds the wall to the map as new labels, and their tissues to the recipe. The map grows by the
// wall at the sides that no label reaches (at others the scan cuts off the patient: no wall there).
// Without [[wall]] both are unchanged. Returns a sentence for each layer that the voxels make
// thinner or thicker than asked by more than kMostOff (base/most_off.h).
std::vector<std::string> add_wall(LabelMap& map, Recipe& recipe);

}  // namespace stylet::offline
