// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/hull.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <queue>

#include "base/refusal.h"
#include "meshes/quickhull.h"

namespace stylet::offline {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

// A mesh thinner than this fraction of its length is flat, and its hull is not a body.
constexpr double kFlat = 1e-6;
// The kernel refuses vertices farther from the origin (kernel/src/needle/obstacle.cpp).
constexpr double kFarthestM = 10;

// Always begins at the last corner: from another corner the sums round differently, so that among
// equally far vertices another would be chosen, and existing organs would get other hulls.
std::array<Vec, 3> corners_of(const Mesh& body, const Triangle& t) {
  return {body.points[t[2]], body.points[t[0]], body.points[t[1]]};
}

double volume_of(const Mesh& body, Vec inside) {
  double six_volumes = 0;
  for (const Triangle& t : body.triangles) {
    const auto [a, b, c] = corners_of(body, t);
    six_volumes += dot(a - inside, cross(b - inside, c - inside));
  }
  return six_volumes / 6;
}

template <typename Measure>
std::size_t largest(const std::vector<Vec>& points, Measure measure) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (measure(points[i]) > measure(points[best])) best = i;
  }
  return best;
}

// Four points that span much volume: the first body, from which distances are measured.
std::array<std::size_t, 4> first_corners(const std::string& name, const std::vector<Vec>& points) {
  const std::size_t a = largest(points, [](Vec p) { return -p.x; });
  const Vec from = points[a];
  const std::size_t b = largest(points, [&](Vec p) { return length(p - from); });
  const Vec along = points[b] - from;
  const std::size_t c = largest(points, [&](Vec p) { return length(cross(p - from, along)); });
  const Vec across = cross(points[c] - from, along);
  const std::size_t d = largest(points, [&](Vec p) { return std::fabs(dot(p - from, across)); });
  const double size = length(along);
  if (!(std::fabs(dot(points[d] - from, across)) > kFlat * size * size * size)) {
    refuse("{}: all points lie in one plane: expected a mesh with an inside", name);
  }
  return {a, b, c, d};
}

// A vertex that is left out; sorted so that the farthest from the body comes first, then the lower
// number. Distances from earlier rounds are upper bounds, because the body only grows.
struct Left {
  double distance;
  std::size_t vertex, round;
  bool operator<(const Left& other) const {
    return distance != other.distance ? distance < other.distance : vertex > other.vertex;
  }
};

Kernel::Point_3 point_of(Vec p) {
  return {p.x, p.y, p.z};
}

double distance_to(const std::vector<Kernel::Triangle_3>& triangles, Vec p) {
  const Kernel::Point_3 point = point_of(p);
  double square = std::numeric_limits<double>::infinity();
  for (const Kernel::Triangle_3& t : triangles) {
    square = std::min(square, CGAL::squared_distance(point, t));
  }
  return std::sqrt(square);
}

// Takes the vertex farthest from the body; its distance has been measured in this round.
Left farthest(const std::vector<Vec>& points, const Mesh& body, std::size_t round,
              std::priority_queue<Left>& left) {
  std::vector<Kernel::Triangle_3> triangles;
  triangles.reserve(body.triangles.size());
  for (const Triangle& t : body.triangles) {
    const auto [a, b, c] = corners_of(body, t);
    triangles.emplace_back(point_of(a), point_of(b), point_of(c));
  }
  while (left.top().round != round) {
    const std::size_t vertex = left.top().vertex;
    left.pop();
    left.push({distance_to(triangles, points[vertex]), vertex, round});
  }
  return left.top();
}

std::vector<Vec> sorted(std::vector<Vec> points) {
  std::sort(points.begin(), points.end(), [](Vec a, Vec b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
  });
  return points;
}

}  // namespace

Hull simple_hull(const std::string& name, const std::vector<Vec>& points_m,
                 std::size_t most_vertices) {
  if (points_m.size() < kLeastHullVertices) {
    refuse("{}: {} points: expected at least {}", name, points_m.size(), kLeastHullVertices);
  }
  const Vec far = points_m[largest(points_m, [](Vec p) { return length(p); })];
  if (!(length(far) <= kFarthestM)) {
    refuse("{}: reaches {:.6g} m from the origin: expected at most {} m; check --units", name,
           length(far), kFarthestM);
  }
  (void)first_corners(name, points_m);  // refuses flat points, of which CGAL would make a polygon
  const std::vector<Vec> all = sorted(quickhull(points_m).points);
  Hull hull;
  hull.hull_vertices = all.size();
  std::priority_queue<Left> left;
  for (std::size_t i = 0; i < all.size(); ++i) {
    left.push({std::numeric_limits<double>::infinity(), i, 0});
  }
  for (const std::size_t corner : first_corners(name, all)) hull.vertices_m.push_back(all[corner]);
  for (std::size_t round = 1;; ++round) {
    const Mesh body = quickhull(hull.vertices_m);
    const Left next = farthest(all, body, round, left);
    hull.deviation_m = next.distance;
    hull.volume_m3 = std::fabs(volume_of(body, hull.vertices_m[0]));
    if (!(hull.deviation_m > 0) || hull.vertices_m.size() >= most_vertices) return hull;
    hull.vertices_m.push_back(all[next.vertex]);
  }
}

double hull_volume_m3(const std::vector<Vec>& points_m) {
  if (points_m.size() < kLeastHullVertices) return 0;
  return std::fabs(volume_of(quickhull(points_m), points_m.front()));
}

std::vector<HullPlane> hull_planes(const Hull& hull) {
  const Mesh mesh = hull_mesh(hull);
  std::vector<HullPlane> planes;
  for (const Triangle& t : mesh.triangles) {
    const Vec a = mesh.points[t[0]];
    const Vec normal = cross(mesh.points[t[1]] - a, mesh.points[t[2]] - a);
    planes.push_back({normal, dot(normal, a)});  // faces of the hull point outward
  }
  return planes;
}

Mesh hull_mesh(const Hull& hull) {
  return quickhull(hull.vertices_m);
}

}  // namespace stylet::offline
