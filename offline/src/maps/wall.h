// SPDX-License-Identifier: GPL-3.0-or-later
// A wall around what a label map holds, where the map says nothing: segmentations of organs often
// leave out the skin, fat and muscle that a needle meets first. It is made up: all that is nearer
// to a label than its layers are thick together, in layers as deep below its outside as the recipe
// says; the innermost also fills what is deeper, such as gaps between organs.
// Units: metres. Time: linear in voxels.
#pragma once

#include "maps/label_map.h"
#include "maps/recipe.h"

namespace stylet::bake {

// The map with the wall as labels of its own, larger by it at the sides that no label reaches (at
// the others the scan cuts the patient off, and there is no wall); and the recipe with their
// tissues. Both come back as they are without [[wall]]. Returns a sentence for each layer that the
// voxels make 5 % thinner or thicker (base/most_off.h).
std::vector<std::string> add_wall(LabelMap& map, Recipe& recipe);

}  // namespace stylet::bake
