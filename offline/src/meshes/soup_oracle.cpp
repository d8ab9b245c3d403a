// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/soup_oracle.h"

#include <CGAL/Alpha_wrap_3/internal/Triangle_soup_oracle.h>

namespace stylet::offline {

struct SoupOracle::Soup : CGAL::Alpha_wraps_3::internal::Triangle_soup_oracle<CgalKernel> {
  using Triangle_soup_oracle::Triangle_soup_oracle;
};

SoupOracle::SoupOracle(const Mesh& mesh, double gap) : soup_(std::make_unique<Soup>(gap)) {
  soup_->add_triangle_soup(cgal_points(mesh), mesh.triangles);
}
SoupOracle::~SoupOracle() = default;

CGAL::Bbox_3 SoupOracle::bbox() const {
  return soup_->bbox();
}

bool SoupOracle::do_intersect(const Cell& cell) const {
  return soup_->do_intersect(cell);
}

bool SoupOracle::do_intersect(const Ball& ball) const {
  return soup_->do_intersect(ball);
}

SoupOracle::Point SoupOracle::closest_point(const Point& p) const {
  return soup_->closest_point(p);
}

double SoupOracle::squared_distance(const Point& p) const {
  return soup_->squared_distance(p);
}

bool SoupOracle::first_intersection(const Point& from, const Point& to, Point& found_out,
                                    double offset) const {
  return soup_->first_intersection(from, to, found_out, offset);
}

}  // namespace stylet::offline
