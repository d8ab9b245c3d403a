// SPDX-License-Identifier: GPL-3.0-or-later
// The surface on which a function of space is 0, as triangles.
//
// Promises: deterministic; closed, oriented outward. Units: those of the function.
#pragma once

#include <functional>

#include "base/geometry.h"

namespace stylet::offline {

using Implicit = std::function<double(Vec)>;  // negative inside

// `inside` must be a point within the surface; the sphere of `reach` around it must contain it all.
// Triangles are about `facet` large and no farther than `tolerance` from the surface.
// Uses CGAL's volume mesher and keeps only the boundary: it sorts by time of creation, whereas the
// surface mesher sorts by address and gives another mesh on every call.
Mesh implicit_mesh(const Implicit& implicit, Vec inside, double reach, double facet,
                   double tolerance);

}  // namespace stylet::offline
