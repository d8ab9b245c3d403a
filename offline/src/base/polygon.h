// SPDX-License-Identifier: GPL-3.0-or-later
// Convex polygons in space, cut by planes across the axes.
#pragma once

#include <vector>

#include "base/geometry.h"

namespace stylet::offline {

using Polygon = std::vector<Vec>;

// The part between two planes across an axis; may be empty.
Polygon between(const Polygon& polygon, std::size_t axis, double low, double high);

// Half the sum of the cross products: as long as the area, along the normal.
Vec area_vector(const Polygon& polygon);
double area_of(const Polygon& polygon);

}  // namespace stylet::offline
