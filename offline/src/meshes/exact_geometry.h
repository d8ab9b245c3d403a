// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry of the triangulations of CGAL's alpha wrap and of its mesher: what needs exact
// numbers stands behind calls, and is compiled once and apart from both. With it each took 30 s of
// processor time. Names, arguments and answers are CGAL's: of all its kernel takes,
// exact_geometry.cpp has what the two ask for. Only for wrap.cpp and implicit_mesh.cpp.
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

// The ray from the centre of the sphere through four points, away from the last of them and across
// the plane of the others: what bounds their neighbour at infinity.
CgalKernel::Ray_3 exact_dual_ray(const CgalBall& p, const CgalBall& q, const CgalBall& r,
                                 const CgalBall& s);

}  // namespace stylet::offline

// CGAL would wrap these in exact constructions of circumcentres once more; theirs are exact
// already.
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
