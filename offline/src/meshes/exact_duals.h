// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's regular triangulation, whose exact duals are behind calls as well (exact_geometry.h). The
// mesher asks for them where rounding has put a point of the mesh outside its facet's zone.
#pragma once

#include "meshes/exact_geometry.h"

namespace stylet::offline {

template <typename Base>
struct ExactDuals : Base {
  using typename Base::Bare_point;
  using typename Base::Cell_handle;
  using typename Base::Facet;

  void dual_segment_exact(const Facet& facet, Bare_point& from, Bare_point& to) const {
    from = exact_centre(facet.first);
    to = exact_centre(facet.first->neighbor(facet.second));
  }
  void dual_ray_exact(const Facet& facet, CgalKernel::Ray_3& ray) const {
    const auto [cell, last] = this->is_infinite(facet.first) ? this->mirror_facet(facet) : facet;
    std::array<int, 3> others{(last + 1) % 4, (last + 2) % 4, (last + 3) % 4};
    if (last % 2 == 1) std::swap(others[0], others[1]);
    ray = exact_dual_ray(cell->vertex(others[0])->point(), cell->vertex(others[1])->point(),
                         cell->vertex(others[2])->point(), cell->vertex(last)->point());
  }
  static Bare_point exact_centre(Cell_handle cell) {
    return MeshGeometry::Construct_weighted_circumcenter_3()(
        cell->vertex(0)->point(), cell->vertex(1)->point(), cell->vertex(2)->point(),
        cell->vertex(3)->point(), true);
  }
};

}  // namespace stylet::offline
