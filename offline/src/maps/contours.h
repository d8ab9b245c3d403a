// SPDX-License-Identifier: GPL-3.0-or-later
// Closed contours in planes: which of them are the same, and which pixels they hold.
//
// Promise: memory follows points and pixels, however often a contour crosses a row. Units: metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "maps/stack.h"

namespace stylet::offline {

struct Contour {
  std::vector<Vec> points_m;
  double along_m = 0;
  std::size_t plane = 0;
};

// A vector along the normal with twice the area as its length (Newell).
Vec area_of(const Contour& contour);

// Removes repeated contours, because a contour inside itself would be a hole: those that lie on
// another within 10 um, wherever they begin, whichever way they go and however they are rounded.
// Returns how many were removed.
std::size_t drop_repeated(std::vector<Contour>& contours);

// Directions and size of pixels, the position of one, and the distance of planes; 0: not known.
struct Raster {
  PixelGrid grid;
  Vec anchor_m;
  double step_m = 0;
};

// Successive pixels of a row that are inside.
struct Run {
  std::size_t plane = 0;
  std::uint32_t row = 0, first = 0, end = 0;
};

// Even-odd rule over all contours of a plane; a pixel is inside if its centre is. `low`: the first
// pixel's place in columns and rows. In the order of planes and rows.
std::vector<Run> runs_of(const Raster& raster, std::array<double, 2> low,
                         const std::vector<Contour>& contours);

}  // namespace stylet::offline
