// SPDX-License-Identifier: GPL-3.0-or-later
// How thick the layers of a wall have become on the voxels of a label map: a layer of 2 mm cannot
// be drawn on slices of 3 mm, and one of 5 mm becomes 4 or 6 mm.
//
// Promises: within 2 % of a shell's thickness around bodies that are larger than their wall
// (tests). Where the innermost layer fills gaps between organs it has no thickness, and is not
// measured. Units: metres. Time: linear in voxels. Source: the area of a surface is the sum of its
// projections along the axes, each times its normal's part along that axis; steps of voxels have
// the same projections as what they stand for.
#pragma once

#include <vector>

#include "maps/label_map.h"

namespace stylet::bake {

// Of each voxel's middle.
struct WallDistances {
  std::vector<float> from_labels_m, from_outside_m;
  double thickness_m = 0;  // of all layers, as they were asked for
};

// Volume over the mean area between both sides; not a number where a layer has none. Labels of the
// layers from the inside.
std::vector<double> layer_thickness_m(const LabelMap& map, const WallDistances& distances,
                                      const std::vector<std::uint16_t>& label_of_layer);

}  // namespace stylet::bake
