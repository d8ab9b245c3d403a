// SPDX-License-Identifier: GPL-3.0-or-later
// What CGAL's alpha wrap asks about the triangles that it wraps, for wrap.cpp alone. The search
// tree behind it is compiled here, because wrap.cpp took 30 s of processor time with it. Names,
// types and answers are those of CGAL's Triangle_soup_oracle.
#pragma once

#include <memory>

#include "meshes/exact_geometry.h"

namespace stylet::offline {

class SoupOracle {
 public:
  using Geom_traits = WrapGeometry;
  using Point = CgalKernel::Point_3;
  using Ball = Geom_traits::Ball_3;
  // A cell of the wrap's triangulation.
  using Cell = CGAL::Alpha_wraps_3::internal::Tetrahedron_with_outside_info<
      CGAL::Robust_circumcenter_filtered_traits_3<Geom_traits>>;

  // Large triangles are divided for a wrap with this `gap`.
  SoupOracle(const Mesh& mesh, double gap);
  ~SoupOracle();

  Geom_traits geom_traits() const { return {}; }
  CGAL::Bbox_3 bbox() const;
  bool do_intersect(const Cell& cell) const;
  bool do_intersect(const Ball& ball) const;
  Point closest_point(const Point& p) const;
  double squared_distance(const Point& p) const;
  // The first point between `from` and `to` that is `offset` away from the triangles.
  bool first_intersection(const Point& from, const Point& to, Point& found_out,
                          double offset) const;

 private:
  struct Soup;
  std::unique_ptr<Soup> soup_;
};

}  // namespace stylet::offline
