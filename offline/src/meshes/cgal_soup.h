// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's kernel and soups of triangles in it. Only for the few files that call CGAL: it compiles
// slowly, and this is the part of it that all of them need.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <vector>

#include "base/geometry.h"

namespace stylet::offline {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoint = CgalKernel::Point_3;
using SoupPoints = std::vector<CgalPoint>;
using SoupTriangles = std::vector<std::array<std::size_t, 3>>;

inline SoupPoints cgal_points(const Mesh& mesh) {
  SoupPoints points;
  for (const Vec& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
  return points;
}

// The closed surface of the triangles, turned outward: what CGAL makes of those of a complex by
// facets_in_complex_3_to_triangle_mesh and orient.
Mesh outward_surface(SoupPoints points, SoupTriangles triangles);

}  // namespace stylet::offline
