// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/implicit_mesh.h"

#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_3/Mesher_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_facet_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/facets_in_complex_3_to_triangle_mesh.h>

#include <optional>
#include <random>

#include "meshes/exact_duals.h"

namespace stylet::offline {
namespace {

using Kernel = CgalKernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;

using Triangulation = ExactDuals<CGAL::Mesh_triangulation_3<Domain, MeshGeometry>::type>;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;

// Nothing is asked of the tetrahedra: only their surface is used.
struct CellCriteria {
  using Cell_quality = double;
  using Is_cell_bad = std::optional<Cell_quality>;
  Is_cell_bad operator()(const Triangulation& /*all*/, Triangulation::Cell_handle /*cell*/) const {
    return {};
  }
};

// The mesher keeps references to both criteria.
struct Criteria {
  using Facet_criteria = CGAL::Mesh_facet_criteria_3<Triangulation>;
  using Cell_criteria = CellCriteria;
  const Facet_criteria& facet_criteria_object() const { return facets; }
  const Cell_criteria& cell_criteria_object() const { return cells; }
  Facet_criteria facets;
  Cell_criteria cells = {};
};

// What refine_mesh_3 calls first. That function also compiles four optimizers of tetrahedra, which
// it is told not to use here: 14 s of 43 s of processor time, and 1.2 GB.
using Mesher = CGAL::Mesh_3::Mesher_3<Complex, Criteria, Domain>;

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

}  // namespace
}  // namespace stylet::offline

// Writes files for debugging, but only if the mesher is given a name for them; ours is not.
template <>
void CGAL::dump_c3t3(const stylet::offline::Complex& /*complex*/, std::string /*name*/) {}

namespace stylet::offline {

Mesh implicit_mesh(const Implicit& implicit, Vec inside, double reach, double facet,
                   double tolerance) {
  namespace parameters = CGAL::parameters;
  constexpr double kSmallestAngleDegrees = 30;
  const Kernel::Point_3 middle(inside.x, inside.y, inside.z);
  const Kernel::Sphere_3 bound(middle, reach * reach);
  const auto function = [&implicit](const Kernel::Point_3& p) {
    return implicit(Vec{p.x(), p.y(), p.z()});
  };
  const Domain domain =
      Domain::create_implicit_mesh_domain(function, bound, parameters::relative_error_bound = 1e-7);
  const Criteria criteria{{kSmallestAngleDegrees, facet * 0.7, tolerance}};
  Complex complex;
  start_mesh(domain, middle, reach, complex);
  Mesher(complex, domain, criteria).refine_mesh();
  SoupPoints points;
  SoupTriangles triangles;
  CGAL::Mesh_3::internal::facets_in_complex_3_to_triangle_soup(complex, points, triangles);
  return outward_surface(points, triangles);
}

}  // namespace stylet::offline
