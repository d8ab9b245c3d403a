// SPDX-License-Identifier: GPL-3.0-or-later
// The exact arithmetic of the triangulations of CGAL's alpha wrap and of its mesher, behind calls:
// so it is compiled once. Compiled in wrap.cpp and in implicit_mesh.cpp, it made each of them take
// 30 s of processor time. Names, arguments and answers are CGAL's; exact_geometry.cpp has only the
// arguments that these two files use. Nobody else includes this.
#pragma once

#include <CGAL/Alpha_wrap_3/internal/Alpha_wrap_AABB_traits.h>
#include <CGAL/Robust_weighted_circumcenter_filtered_traits_3.h>

#include "meshes/cgal_soup.h"

namespace stylet::offline {

using CgalBall = CgalKernel::Weighted_point_3;

class WrapGeometry : public CGAL::Alpha_wraps_3::internal::Alpha_wrap_AABB_traits<CgalKernel> {
 public:
  struct Construct_circumcenter_3 {
    template <typename... Args>
    CgalPoint operator()(const Args&... args) const;
  };
  struct Side_of_oriented_sphere_3 {
    template <typename... Args>
    CGAL::Oriented_side operator()(const Args&... args) const;
  };
  struct Coplanar_side_of_bounded_circle_3 {
    template <typename... Args>
    CGAL::Bounded_side operator()(const Args&... args) const;
  };

  static Construct_circumcenter_3 construct_circumcenter_3_object() { return {}; }
  static Side_of_oriented_sphere_3 side_of_oriented_sphere_3_object() { return {}; }
  static Coplanar_side_of_bounded_circle_3 coplanar_side_of_bounded_circle_3_object() { return {}; }
};

template <>
CgalPoint WrapGeometry::Construct_circumcenter_3::operator()(const CgalPoint& p, const CgalPoint& q,
                                                             const CgalPoint& r) const;

class MeshGeometry : public CgalKernel {
 public:
  struct Construct_weighted_circumcenter_3 {
    using result_type = CgalPoint;
    template <typename... Args>
    CgalPoint operator()(const Args&... args) const;
  };
  struct Compute_squared_radius_smallest_orthogonal_sphere_3 {
    template <typename... Args>
    double operator()(const Args&... args) const;
  };
  struct Power_side_of_oriented_power_sphere_3 {
    template <typename... Args>
    CGAL::Oriented_side operator()(const Args&... args) const;
  };
  struct Compare_power_distance_3 {
    template <typename... Args>
    CGAL::Comparison_result operator()(const Args&... args) const;
  };
  struct Compare_weighted_squared_radius_3 {
    template <typename... Args>
    CGAL::Comparison_result operator()(const Args&... args) const;
  };

  static Construct_weighted_circumcenter_3 construct_weighted_circumcenter_3_object() { return {}; }
  static Compute_squared_radius_smallest_orthogonal_sphere_3
  compute_squared_radius_smallest_orthogonal_sphere_3_object() {
    return {};
  }
  static Power_side_of_oriented_power_sphere_3 power_side_of_oriented_power_sphere_3_object() {
    return {};
  }
  static Compare_power_distance_3 compare_power_distance_3_object() { return {}; }
  static Compare_weighted_squared_radius_3 compare_weighted_squared_radius_3_object() { return {}; }
};

// The ray from the centre of the sphere through four points, square to the plane of the first three
// and away from the last: the dual of their facet where it has no neighbour but infinity.
CgalKernel::Ray_3 exact_dual_ray(const CgalBall& p, const CgalBall& q, const CgalBall& r,
                                 const CgalBall& s);

}  // namespace stylet::offline

// CGAL would add exact constructions of circumcentres to these geometries. They are exact already.
template <>
class CGAL::Robust_circumcenter_filtered_traits_3<stylet::offline::WrapGeometry>
    : public stylet::offline::WrapGeometry {
 public:
  explicit Robust_circumcenter_filtered_traits_3(const stylet::offline::WrapGeometry& /*all*/) {}
  Robust_circumcenter_filtered_traits_3() = default;
};

template <>
class CGAL::Robust_weighted_circumcenter_filtered_traits_3<stylet::offline::MeshGeometry>
    : public stylet::offline::MeshGeometry {};
