// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

#include "meshes/repair.h"

namespace stylet::offline {
namespace {

using CgalPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

// Whether `turned` has the points of `original` in the opposite direction.
bool opposite(const Triangle& original, const Triangle& turned) {
  const auto* const first = std::find(turned.begin(), turned.end(), original[0]);
  return turned[static_cast<std::size_t>(first - turned.begin() + 1) % 3] != original[1];
}

}  // namespace

void orient_neighbours(const std::vector<Vec>& points, std::vector<Triangle>& triangles) {
  std::vector<CgalPoint> soup_points;
  soup_points.reserve(points.size());
  for (const Vec& p : points) soup_points.emplace_back(p.x, p.y, p.z);
  std::vector<std::vector<std::size_t>> soup;
  soup.reserve(triangles.size());
  for (const Triangle& t : triangles) soup.push_back({t[0], t[1], t[2]});

  CGAL::Polygon_mesh_processing::orient_polygon_soup(soup_points, soup);

  // CGAL may have cut the soup by appending copies of points; so we take over only the direction
  // of each triangle.
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Triangle turned{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const CgalPoint& p = soup_points[soup[i][corner]];
      for (const std::uint32_t original : triangles[i]) {
        if (points[original] == Vec{p.x(), p.y(), p.z()}) turned[corner] = original;
      }
    }
    if (opposite(triangles[i], turned)) std::swap(triangles[i][1], triangles[i][2]);
  }
}

}  // namespace stylet::offline
