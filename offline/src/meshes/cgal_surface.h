// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's surfaces and their conversion. Only for the few files that call CGAL: it compiles slowly.
#pragma once

#include <CGAL/Surface_mesh.h>

#include "meshes/cgal_soup.h"

namespace stylet::offline {

using CgalSurface = CGAL::Surface_mesh<CgalPoint>;

inline Mesh mesh_of(const CgalSurface& surface) {
  Mesh mesh;
  std::vector<std::uint32_t> number(surface.num_vertices());
  for (const auto vertex : surface.vertices()) {
    number[vertex.idx()] = static_cast<std::uint32_t>(mesh.points.size());
    const CgalPoint& p = surface.point(vertex);
    mesh.points.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto face : surface.faces()) {
    Triangle t{};
    std::size_t corner = 0;
    for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) {
      t[corner++] = number[vertex.idx()];
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

}  // namespace stylet::offline
