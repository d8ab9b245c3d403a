// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's tree of triangles, for the point of a surface that is nearest to another point. Its
// constructions are not exact: good for distances, not for which side a point lies on.
#pragma once

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <vector>

#include "base/geometry.h"

namespace stylet::offline::nearest {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

inline Kernel::Point_3 point_of(Vec p) {
  return {p.x, p.y, p.z};
}

inline Triangles triangles_of(const Mesh& mesh) {
  Triangles triangles;
  for (const Triangle& t : mesh.triangles) {
    triangles.emplace_back(point_of(mesh.points[t[0]]), point_of(mesh.points[t[1]]),
                           point_of(mesh.points[t[2]]));
  }
  return triangles;
}

}  // namespace stylet::offline::nearest
