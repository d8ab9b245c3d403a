// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/quickhull.h"

#include <CGAL/convex_hull_3.h>

#include "meshes/cgal_surface.h"

namespace stylet::offline {
namespace {

// CGAL's quickhull keeps the rim of what a point sees in a map sorted by the vertices' addresses.
// So the heap would decide which of several points in a plane become vertices and how its faces are
// divided: the hull of a rib changed after other allocations. A type of our own in the traits makes
// the vertices a type of our own, whose order is defined below.
struct OrderedByPlace;
using Traits = CGAL::Convex_hull_traits_3<CgalKernel, OrderedByPlace, CGAL::Tag_true>;
using QuickhullVertex =
    CGAL::Triangulation_data_structure_2<CGAL::Convex_hull_vertex_base_2<CGAL::GT3_for_CH3<Traits>>,
                                         CGAL::Convex_hull_face_base_2<Traits>>::Vertex_handle;

}  // namespace
}  // namespace stylet::offline

// This is an order, since no two vertices of a hull have the same position.
template <>
struct std::less<stylet::offline::QuickhullVertex> {
  bool operator()(const stylet::offline::QuickhullVertex& a,
                  const stylet::offline::QuickhullVertex& b) const {
    return a->point() < b->point();
  }
};

namespace stylet::offline {

Mesh quickhull(const std::vector<Vec>& points) {
  std::vector<CgalKernel::Point_3> given;
  given.reserve(points.size());
  for (const Vec& p : points) given.emplace_back(p.x, p.y, p.z);
  CgalSurface surface;
  CGAL::convex_hull_3(given.begin(), given.end(), surface, Traits());
  return mesh_of(surface);
}

}  // namespace stylet::offline
