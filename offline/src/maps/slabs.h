// SPDX-License-Identifier: GPL-3.0-or-later
// How thick a structure is at each plane that it was drawn in: half of the way to its next plane on
// either side, whatever planes other structures have. Where it was drawn farther apart than is
// usual for it, it is empty between, unless three ways or more in a row are alike: that is how it
// was drawn.
// Units: metres. Places are along the normal of the planes.
#pragma once

#include <cmath>
#include <map>
#include <vector>

#include "maps/stack.h"

namespace stylet::bake {

constexpr double kSamePlaneM = 2e-5;  // what the last digits of a place may be off

using Slabs = std::map<std::size_t, Slab>;  // by the number of the plane

// Layers of all slabs: of the same thickness where they are even, else fine ones.
struct Layers {
  double low_m = HUGE_VAL, high_m = -HUGE_VAL, step_m = 0;
};

// From each plane to the next, of those numbered `own`, ascending; `along_m`: of all planes.
std::vector<double> gaps_of(const std::vector<std::size_t>& own,
                            const std::vector<double>& along_m);
// `otherwise_m`: how far apart planes are where a structure has too few of them to tell.
Slabs slabs_of(const std::vector<std::size_t>& own, const std::vector<double>& along_m,
               double otherwise_m);

Layers layers_of(const PixelGrid& grid, const std::vector<Slabs>& slabs);
Span span_of(const Layers& layers, Slab slab);

}  // namespace stylet::bake
