// SPDX-License-Identifier: GPL-3.0-or-later
// How thick a structure is at each plane that it was drawn in: half the distance to its own next
// plane on either side; planes of other structures do not matter. A gap wider than usual for the
// structure is taken as empty, unless three or more gaps in a row are alike: then it was drawn with
// that distance.
// Units: metres. Positions are along the normal of the planes.
#pragma once

#include <cmath>
#include <map>
#include <vector>

#include "maps/stack.h"

namespace stylet::offline {

constexpr double kSamePlaneM = 2e-5;  // rounding error of a position in a file

using Slabs = std::map<std::size_t, Slab>;  // by the number of the plane

// Layers for all slabs: as thick as the slabs if these are even, else finer.
struct Layers {
  double low_m = HUGE_VAL, high_m = -HUGE_VAL, step_m = 0;
};

// Distances between successive planes numbered in `own`, ascending; `along_m`: of all planes.
std::vector<double> gaps_of(const std::vector<std::size_t>& own,
                            const std::vector<double>& along_m);
// The usual one of those that are three or more alike in a row; 0 if there are none.
double drawn_gap_m(const std::vector<double>& gaps);
// `otherwise_m`: the distance of planes to assume if a structure has too few planes to tell.
Slabs slabs_of(const std::vector<std::size_t>& own, const std::vector<double>& along_m,
               double otherwise_m);

Layers layers_of(const PixelGrid& grid, const std::vector<Slabs>& slabs);
Span span_of(const Layers& layers, Slab slab);

}  // namespace stylet::offline
