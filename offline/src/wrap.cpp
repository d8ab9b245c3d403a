// SPDX-License-Identifier: GPL-3.0-or-later
#include "wrap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

namespace stylet::bake {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

}  // namespace

Mesh alpha_wrap(const Mesh& mesh, double gap, double offset) {
  std::vector<Kernel::Point_3> points;
  for (const Vec& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
  Surface wrapped;
  CGAL::alpha_wrap_3(points, mesh.triangles, gap, offset, wrapped);

  Mesh result;
  std::vector<std::uint32_t> number(wrapped.num_vertices());
  for (const auto vertex : wrapped.vertices()) {
    number[vertex.idx()] = static_cast<std::uint32_t>(result.points.size());
    const Kernel::Point_3& p = wrapped.point(vertex);
    result.points.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto face : wrapped.faces()) {
    Triangle t{};
    std::size_t corner = 0;
    for (const auto vertex : wrapped.vertices_around_face(wrapped.halfedge(face))) {
      t[corner++] = number[vertex.idx()];
    }
    result.triangles.push_back(t);
  }
  return result;
}

}  // namespace stylet::bake
