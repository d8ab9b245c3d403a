// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/soup_surface.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

namespace CGAL::Polygon_mesh_processing {

template bool is_polygon_soup_a_polygon_mesh(const stylet::offline::SoupTriangles&);
template void polygon_soup_to_polygon_mesh(const stylet::offline::SoupPoints&,
                                           const stylet::offline::SoupTriangles&,
                                           stylet::offline::CgalSurface&,
                                           const stylet::offline::NoOptions&,
                                           const stylet::offline::SurfaceOptions&);
template void orient_to_bound_a_volume(stylet::offline::CgalSurface&,
                                       const stylet::offline::SurfaceOptions&);

}  // namespace CGAL::Polygon_mesh_processing

namespace stylet::offline {

Mesh outward_surface(SoupPoints points, SoupTriangles triangles) {
  namespace processing = CGAL::Polygon_mesh_processing;
  if (!processing::is_polygon_soup_a_polygon_mesh(triangles)) {
    processing::orient_polygon_soup(points, triangles);
  }
  CgalSurface surface;
  processing::polygon_soup_to_polygon_mesh(
      points, triangles, surface, CGAL::parameters::default_values(),
      CGAL::parameters::vertex_point_map(get(CGAL::vertex_point, surface)));
  processing::orient(surface);
  return mesh_of(surface);
}

}  // namespace stylet::offline
