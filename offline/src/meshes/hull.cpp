// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/hull.h"

#include <CGAL/convex_hull_3.h>
#include <CGAL/squared_distance_3.h>

#include <queue>

#include "base/refusal.h"
#include "meshes/cgal_surface.h"

namespace stylet::offline {
namespace {

using Kernel = CgalKernel;
using Point = Kernel::Point_3;
using Surface = CgalSurface;

// CGAL's quickhull keeps the rim of what a point sees in a map sorted by the vertices' addresses.
// So the heap would decide which of several points in a plane become vertices and how its faces are
// divided: the hull of a rib changed after other allocations. A type of our own in the traits makes
// the vertices a type of our own, whose order is defined below.
struct OrderedByPlace;
using Traits = CGAL::Convex_hull_traits_3<Kernel, OrderedByPlace, CGAL::Tag_true>;
using QuickhullVertex =
    CGAL::Triangulation_data_structure_2<CGAL::Convex_hull_vertex_base_2<CGAL::GT3_for_CH3<Traits>>,
                                         CGAL::Convex_hull_face_base_2<Traits>>::Vertex_handle;

}  // namespace
}  // namespace stylet::offline

// This is an order, since no two vertices of a hull have the same position.
template <>
struct std::less<stylet::offline::QuickhullVertex> {
  bool operator()(const stylet::offline::QuickhullVertex& a,
                  const stylet::offline::QuickhullVertex& b) const {
    return a->point() < b->point();
  }
};

namespace stylet::offline {
namespace {

// A mesh thinner than this fraction of its length is flat, and its hull is not a body.
constexpr double kFlat = 1e-6;
// The kernel refuses vertices farther from the origin (kernel/src/needle/obstacle.cpp).
constexpr double kFarthestM = 10;

Vec to_vec(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

Surface hull_of(const std::vector<Vec>& points) {
  std::vector<Point> given;
  for (const Vec& p : points) given.emplace_back(p.x, p.y, p.z);
  Surface surface;
  CGAL::convex_hull_3(given.begin(), given.end(), surface, Traits());
  return surface;
}

std::vector<Kernel::Triangle_3> triangles_of(const Surface& surface) {
  std::vector<Kernel::Triangle_3> triangles;
  for (const auto face : surface.faces()) {
    const auto edge = surface.halfedge(face);
    triangles.emplace_back(surface.point(surface.source(edge)), surface.point(surface.target(edge)),
                           surface.point(surface.target(surface.next(edge))));
  }
  return triangles;
}

double volume_of(const Surface& surface, Vec inside) {
  double six_volumes = 0;
  for (const Kernel::Triangle_3& t : triangles_of(surface)) {
    six_volumes += dot(to_vec(t[0]) - inside, cross(to_vec(t[1]) - inside, to_vec(t[2]) - inside));
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
std::array<std::size_t, 4> corners_of(const std::string& name, const std::vector<Vec>& points) {
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

double distance_to(const std::vector<Kernel::Triangle_3>& triangles, Vec p) {
  const Point point(p.x, p.y, p.z);
  double square = std::numeric_limits<double>::infinity();
  for (const Kernel::Triangle_3& t : triangles) {
    square = std::min(square, CGAL::squared_distance(point, t));
  }
  return std::sqrt(square);
}

// Takes the vertex farthest from the body; its distance has been measured in this round.
Left farthest(const std::vector<Vec>& points, const Surface& body, std::size_t round,
              std::priority_queue<Left>& left) {
  const std::vector<Kernel::Triangle_3> triangles = triangles_of(body);
  while (left.top().round != round) {
    const std::size_t vertex = left.top().vertex;
    left.pop();
    left.push({distance_to(triangles, points[vertex]), vertex, round});
  }
  return left.top();
}

std::vector<Vec> sorted_vertices(const Surface& surface) {
  std::vector<Vec> points;
  for (const auto vertex : surface.vertices()) points.push_back(to_vec(surface.point(vertex)));
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
  (void)corners_of(name, points_m);  // refuses flat points, of which CGAL would make a polygon
  const std::vector<Vec> all = sorted_vertices(hull_of(points_m));
  Hull hull;
  hull.hull_vertices = all.size();
  std::priority_queue<Left> left;
  for (std::size_t i = 0; i < all.size(); ++i) {
    left.push({std::numeric_limits<double>::infinity(), i, 0});
  }
  for (const std::size_t corner : corners_of(name, all)) hull.vertices_m.push_back(all[corner]);
  for (std::size_t round = 1;; ++round) {
    const Surface body = hull_of(hull.vertices_m);
    const Left next = farthest(all, body, round, left);
    hull.deviation_m = next.distance;
    hull.volume_m3 = std::fabs(volume_of(body, hull.vertices_m[0]));
    if (!(hull.deviation_m > 0) || hull.vertices_m.size() >= most_vertices) return hull;
    hull.vertices_m.push_back(all[next.vertex]);
  }
}

double hull_volume_m3(const std::vector<Vec>& points_m) {
  if (points_m.size() < kLeastHullVertices) return 0;
  return std::fabs(volume_of(hull_of(points_m), points_m.front()));
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
  return mesh_of(hull_of(hull.vertices_m));
}

}  // namespace stylet::offline
