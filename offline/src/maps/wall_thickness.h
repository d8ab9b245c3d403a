// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how thick the layers of a wall are on the voxels of a label map: a layer of 2 mm cannot
// be drawn on slices of 3 mm, and one of 5 mm becomes 4 or 6 mm.
//
// Promises: within 2 % of a shell's thickness around bodies that are larger than their wall
// (tests). The innermost layer is not measured where it fills gaps between organs: it has no
// thickness there. Units: metres. Time: linear in voxels. Source: the area of a surface is the sum
// of its projections along the axes, each times its normal's component along that axis; a stepped
// surface of voxels has the same projections as the smooth surface it approximates.
#pragma once

#include <vector>

#include "maps/label_map.h"

namespace stylet::offline {

// Distances of each voxel's middle.
struct WallDistances {
  std::vector<float> from_labels_m, from_outside_m;
  double thickness_m = 0;  // of all layers together, as asked for
};

// Volume divided by the mean area of both sides; NaN for a layer without area. `label_of_layer` is
// ordered from the inside.
std::vector<double> layer_thickness_m(const LabelMap& map, const WallDistances& distances,
                                      const std::vector<std::uint16_t>& label_of_layer);

}  // namespace stylet::offline
