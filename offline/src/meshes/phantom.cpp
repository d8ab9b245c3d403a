// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/phantom.h"

#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/facets_in_complex_3_to_triangle_mesh.h>
#include <CGAL/refine_mesh_3.h>

#include <functional>
#include <map>
#include <random>

#include "meshes/cgal_surface.h"

namespace stylet::offline {
namespace {

using Kernel = CgalKernel;
using Function = std::function<double(Kernel::Point_3)>;  // negative inside
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;

// Gives the mesher its first points, on the surface around `inside`, in asymmetric directions.
// CGAL's own start uses sines and cosines, whose last digit depends on the C library; the whole
// mesh would change with it.
void start_mesh(const Domain& domain, const Kernel::Point_3& inside, double reach,
                Complex& complex) {
  constexpr int kPoints = 12;
  std::mt19937 engine(1);
  const auto coordinate = [&engine] { return static_cast<double>(engine()) * 0x1p-31 - 1; };
  for (int made = 0; made < kPoints;) {
    const Vec way{coordinate(), coordinate(), coordinate()};
    const double size = length(way);
    if (size < 0.1 || size > 1) continue;
    const Vec far = way * (reach / size);
    const Kernel::Segment_3 ray(inside, inside + Kernel::Vector_3(far.x, far.y, far.z));
    const auto [point, index, dimension] = domain.construct_intersection_object()(ray);
    const auto vertex = complex.triangulation().insert(Triangulation::Weighted_point(point));
    complex.set_dimension(vertex, dimension);
    complex.set_index(vertex, index);
    ++made;
  }
}

// `inside` must be a point within the surface; the sphere of `reach` around it must contain it all.
// Uses CGAL's volume mesher and keeps only the boundary: it sorts by time of creation, whereas the
// surface mesher sorts by address and gives another mesh on every call.
Mesh mesh_implicit(const Function& function, Vec inside, double reach, double facet,
                   double tolerance) {
  namespace parameters = CGAL::parameters;
  constexpr double kSmallestAngleDegrees = 30;
  const Kernel::Point_3 middle(inside.x, inside.y, inside.z);
  const Kernel::Sphere_3 bound(middle, reach * reach);
  const Domain domain =
      Domain::create_implicit_mesh_domain(function, bound, parameters::relative_error_bound = 1e-7);
  const CGAL::Mesh_criteria_3<Triangulation> criteria(
      parameters::facet_angle = kSmallestAngleDegrees, parameters::facet_size = facet * 0.7,
      parameters::facet_distance = tolerance);
  Complex complex;
  start_mesh(domain, middle, reach, complex);
  CGAL::refine_mesh_3(complex, domain, criteria, parameters::no_reset_c3t3(),
                      parameters::no_perturb(), parameters::no_exude());
  CgalSurface surface;
  CGAL::facets_in_complex_3_to_triangle_mesh(complex, surface);
  CGAL::Polygon_mesh_processing::orient(surface);
  return mesh_of(surface);
}

double ellipsoid(Vec p, Vec centre, Vec radii) {
  const Vec from = p - centre;
  const Vec once{from.x / radii.x, from.y / radii.y, from.z / radii.z};
  const Vec twice{once.x / radii.x, once.y / radii.y, once.z / radii.z};
  const double slope = length(twice);
  const double level = length(once);
  return slope > 0 ? level * (level - 1) / slope : -std::min({radii.x, radii.y, radii.z});
}

// The smaller of two distances; smoothed if they differ by less than `width`.
double blend(double a, double b, double width) {
  const double closeness = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - closeness * closeness * width / 4;
}

// `p` and the result are in millimetres.
double liver_shape(Vec p) {
  const double right = ellipsoid(p, {0, -30, 0}, {58, 58, 66});
  const double left = ellipsoid(p, {-10, 40, 14}, {36, 52, 30});
  const double gallbladder = ellipsoid(p, {-14, 2, -46}, {22, 16, 30});
  return -blend(-blend(right, left, 30), gallbladder, 8);
}

}  // namespace

Mesh block_phantom(Vec size_m, double facet_m) {
  std::array<std::uint32_t, 3> cells{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cells[axis] =
        static_cast<std::uint32_t>(std::clamp(std::round(size_m[axis] / facet_m), 1.0, 500.0));
  }
  Mesh mesh;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;
  const auto point = [&](std::array<std::uint32_t, 3> at) {
    const auto [entry, is_new] = known.try_emplace(at, mesh.points.size());
    if (is_new) {
      mesh.points.push_back({size_m.x * at[0] / cells[0],
                             size_m.y * at[1] / cells[1] - size_m.y / 2,
                             size_m.z * at[2] / cells[2] - size_m.z / 2});
    }
    return entry->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool far_side : {false, true}) {
      for (std::uint32_t i = 0; i < cells[u]; ++i) {
        for (std::uint32_t j = 0; j < cells[v]; ++j) {
          const auto corner = [&](std::uint32_t du, std::uint32_t dv) {
            std::array<std::uint32_t, 3> at{};
            at[axis] = far_side ? cells[axis] : 0;
            at[u] = i + du;
            at[v] = j + dv;
            return point(at);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1),
                              d = corner(0, 1);
          mesh.triangles.push_back(far_side ? Triangle{a, b, c} : Triangle{a, c, b});
          mesh.triangles.push_back(far_side ? Triangle{a, c, d} : Triangle{a, d, c});
        }
      }
    }
  }
  return mesh;
}

Mesh ball_phantom(double diameter_m, double facet_m) {
  const double radius = diameter_m / 2;
  const Function sphere = [radius](const Kernel::Point_3& p) {
    return length(Vec{p.x(), p.y(), p.z()}) - radius;
  };
  constexpr double kToleranceOfRadius = 0.0025;  // flat facets lose three times that in volume
  return mesh_implicit(sphere, {}, radius * 1.2, facet_m, radius * kToleranceOfRadius);
}

Mesh liver_phantom(double facet_m) {
  constexpr double kMmPerMetre = 1e3;
  constexpr double kToleranceMm = 0.2;
  const Function shape = [](const Kernel::Point_3& p) {
    return liver_shape(Vec{p.x(), p.y(), p.z()});
  };
  Mesh mesh = mesh_implicit(shape, {0, -20, 0}, 150, facet_m * kMmPerMetre, kToleranceMm);
  for (Vec& p : mesh.points) p = p * (1 / kMmPerMetre);
  return mesh;
}

}  // namespace stylet::offline
