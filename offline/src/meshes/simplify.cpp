// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/simplify.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "meshes/cgal_surface.h"

namespace stylet::offline {

Mesh with_fewer_triangles(const Mesh& mesh, std::size_t most) {
  if (mesh.triangles.size() <= most) return mesh;
  std::vector<CgalKernel::Point_3> points = cgal_points(mesh);
  std::vector<Triangle> triangles = mesh.triangles;
  CGAL::Polygon_mesh_processing::orient_polygon_soup(points, triangles);  // may also cut the soup
  CgalSurface surface;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, surface);
  const std::size_t edges = most + most / 2;  // a closed surface has 3 edges for 2 triangles
  CGAL::Surface_mesh_simplification::edge_collapse(
      surface, CGAL::Surface_mesh_simplification::Count_stop_predicate<CgalSurface>(edges));
  surface.collect_garbage();
  return mesh_of(surface);
}

}  // namespace stylet::offline
