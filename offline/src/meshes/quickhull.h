// SPDX-License-Identifier: GPL-3.0-or-later
// The convex hull of points as a surface, faces outward. The same points in the same order give the
// same vertices and faces in the same order: the result does not depend on addresses of memory.
// Source: CGAL's convex_hull_3 (quickhull).
#pragma once

#include <vector>

#include "base/geometry.h"

namespace stylet::offline {

Mesh quickhull(const std::vector<Vec>& points);

}  // namespace stylet::offline
