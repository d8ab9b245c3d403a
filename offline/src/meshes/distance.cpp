// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/distance.h"

#include "meshes/nearest_tree.h"

namespace stylet::offline {
namespace {

using nearest::point_of;
using nearest::Tree;

double area_of(const Mesh& mesh, const Triangle& t) {
  const Vec a = mesh.points[t[0]];
  return length(cross(mesh.points[t[1]] - a, mesh.points[t[2]] - a)) / 2;
}

struct Sums {
  double area = 0, weighted = 0;
};

// Divides the triangle into parts^2 small ones, `parts` along each side. The samples are their
// corners; the weight of a sample is the number of small triangles that it is a corner of.
void visit(const Tree& tree, const Mesh& mesh, const Triangle& t, int parts, Sums& sums,
           Deviation& out) {
  constexpr double kSmallTriangles[] = {6, 3, 1};  // of a sample inside, on a side, at a corner
  const Vec a = mesh.points[t[0]], ab = mesh.points[t[1]] - a, ac = mesh.points[t[2]] - a;
  const double share = area_of(mesh, t) / (3.0 * parts * parts);
  for (int i = 0; i <= parts; ++i) {
    for (int j = 0; i + j <= parts; ++j) {
      const Vec p = a + ab * (1.0 * i / parts) + ac * (1.0 * j / parts);
      const double away = std::sqrt(tree.squared_distance(point_of(p)));
      const int sides = (i == 0 ? 1 : 0) + (j == 0 ? 1 : 0) + (i + j == parts ? 1 : 0);
      sums.area += share * kSmallTriangles[sides];
      sums.weighted += share * kSmallTriangles[sides] * away;
      ++out.samples;
      if (away <= out.most_m) continue;
      out.most_m = away;
      out.where_m = p;
    }
  }
}

}  // namespace

Deviation deviation(const Mesh& from, const Mesh& to) {
  const nearest::Triangles triangles = nearest::triangles_of(to);
  Tree tree(triangles.cbegin(), triangles.cend());
  tree.accelerate_distance_queries();
  double area = 0;
  for (const Triangle& t : from.triangles) area += area_of(from, t);
  const double spacing = std::sqrt(area / kMostSamples);
  const std::size_t step = 1 + 3 * from.triangles.size() / kMostSamples;
  Deviation out;
  Sums sums;
  for (std::size_t i = 0; i < from.triangles.size(); i += step) {
    const Triangle& t = from.triangles[i];
    const double side = std::sqrt(2 * area_of(from, t));
    const double parts = spacing > 0 ? std::clamp(std::floor(side / spacing), 1.0, 100.0) : 1;
    visit(tree, from, t, static_cast<int>(parts), sums, out);
  }
  out.mean_m = sums.area > 0 ? sums.weighted / sums.area : 0;
  return out;
}

}  // namespace stylet::offline
