// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/exact_geometry.h"

namespace stylet::offline {

using P = CgalPoint;
using B = CgalBall;
using Robust = CGAL::Robust_weighted_circumcenter_filtered_traits_3<CgalKernel>;

template <typename... Args>
P WrapGeometry::Construct_circumcenter_3::operator()(const Args&... args) const {
  return Robust().construct_circumcenter_3_object()(args...);
}
template P WrapGeometry::Construct_circumcenter_3::operator()(const P&, const P&, const P&,
                                                              const P&) const;
// CGAL 5.5 computes the centre of three points from the last one and adds it to the first: wrong by
// the way between the two. Its function for points with weights is right.
template <>
P WrapGeometry::Construct_circumcenter_3::operator()(const P& p, const P& q, const P& r) const {
  return Robust().construct_weighted_circumcenter_3_object()(B(p), B(q), B(r));
}

template <typename... Args>
CGAL::Oriented_side WrapGeometry::Side_of_oriented_sphere_3::operator()(const Args&... args) const {
  return CgalKernel().side_of_oriented_sphere_3_object()(args...);
}
template CGAL::Oriented_side WrapGeometry::Side_of_oriented_sphere_3::operator()(const P&, const P&,
                                                                                 const P&, const P&,
                                                                                 const P&) const;

template <typename... Args>
CGAL::Bounded_side WrapGeometry::Coplanar_side_of_bounded_circle_3::operator()(
    const Args&... args) const {
  return CgalKernel().coplanar_side_of_bounded_circle_3_object()(args...);
}
template CGAL::Bounded_side WrapGeometry::Coplanar_side_of_bounded_circle_3::operator()(
    const P&, const P&, const P&, const P&) const;

template <typename... Args>
P MeshGeometry::Construct_weighted_circumcenter_3::operator()(const Args&... args) const {
  return Robust().construct_weighted_circumcenter_3_object()(args...);
}
template P MeshGeometry::Construct_weighted_circumcenter_3::operator()(const B&, const B&, const B&,
                                                                       const B&, const bool&) const;
template P MeshGeometry::Construct_weighted_circumcenter_3::operator()(const B&, const B&, const B&,
                                                                       const B&) const;
template P MeshGeometry::Construct_weighted_circumcenter_3::operator()(const B&, const B&,
                                                                       const B&) const;

template <typename... Args>
double MeshGeometry::Compute_squared_radius_smallest_orthogonal_sphere_3::operator()(
    const Args&... args) const {
  return Robust().compute_squared_radius_smallest_orthogonal_sphere_3_object()(args...);
}
template double MeshGeometry::Compute_squared_radius_smallest_orthogonal_sphere_3::operator()(
    const B&, const B&) const;

template <typename... Args>
CGAL::Oriented_side MeshGeometry::Power_side_of_oriented_power_sphere_3::operator()(
    const Args&... args) const {
  return CgalKernel().power_side_of_oriented_power_sphere_3_object()(args...);
}
template CGAL::Oriented_side MeshGeometry::Power_side_of_oriented_power_sphere_3::operator()(
    const B&, const B&, const B&, const B&, const B&) const;
template CGAL::Oriented_side MeshGeometry::Power_side_of_oriented_power_sphere_3::operator()(
    const B&, const B&, const B&, const B&) const;
template CGAL::Oriented_side MeshGeometry::Power_side_of_oriented_power_sphere_3::operator()(
    const B&, const B&, const B&) const;
template CGAL::Oriented_side MeshGeometry::Power_side_of_oriented_power_sphere_3::operator()(
    const B&, const B&) const;

template <typename... Args>
CGAL::Comparison_result MeshGeometry::Compare_power_distance_3::operator()(
    const Args&... args) const {
  return CgalKernel().compare_power_distance_3_object()(args...);
}
template CGAL::Comparison_result MeshGeometry::Compare_power_distance_3::operator()(const P&,
                                                                                    const B&,
                                                                                    const B&) const;

template <typename... Args>
CGAL::Comparison_result MeshGeometry::Compare_weighted_squared_radius_3::operator()(
    const Args&... args) const {
  return CgalKernel().compare_weighted_squared_radius_3_object()(args...);
}
template CGAL::Comparison_result MeshGeometry::Compare_weighted_squared_radius_3::operator()(
    const B&, const B&, const B&, const double&) const;
template CGAL::Comparison_result MeshGeometry::Compare_weighted_squared_radius_3::operator()(
    const B&, const B&, const double&) const;
template CGAL::Comparison_result MeshGeometry::Compare_weighted_squared_radius_3::operator()(
    const B&, const double&) const;

CgalKernel::Ray_3 exact_dual_ray(const B& p, const B& q, const B& r, const B& s) {
  using Lazy = CGAL::Exact_predicates_exact_constructions_kernel;
  const CGAL::Cartesian_converter<CgalKernel, Lazy> exact;
  const auto centre = Lazy().construct_weighted_circumcenter_3_object();
  const auto ball = [&exact](const B& b) {
    return Lazy::Weighted_point_3(exact(b.point()), exact(b.weight()));
  };
  const Lazy::Plane_3 plane(exact(p.point()), exact(q.point()), exact(r.point()));
  const Lazy::Line_3 across = plane.perpendicular_line(centre(ball(p), ball(q), ball(r)));
  const Lazy::Ray_3 ray(centre(ball(p), ball(q), ball(r), ball(s)), across);
  return CGAL::Cartesian_converter<Lazy, CgalKernel>()(ray);
}

}  // namespace stylet::offline
