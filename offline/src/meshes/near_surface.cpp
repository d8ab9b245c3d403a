// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/near_surface.h"

#include <unordered_map>

#include "meshes/nearest_tree.h"

namespace stylet::offline {
namespace {

using nearest::point_of;

// Nearer to an edge than this, in parts of the triangle's height over it, is on the edge.
constexpr double kOnEdge = 1e-7;

Vec unit(Vec v) {
  const double size = length(v);
  return size > 0 ? v * (1 / size) : Vec{};
}

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
}

double angle_between(Vec a, Vec b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

}  // namespace

struct NearSurface::Tree {
  struct Edge {
    Vec normal;  // sum over its triangles
    int triangles = 0;
  };
  nearest::Triangles triangles;
  nearest::Tree aabb;
  std::vector<Vec> of_triangle, of_point;
  std::vector<bool> is_rim;  // of each point
  std::unordered_map<std::uint64_t, Edge> edges;
};

NearSurface::NearSurface(const Mesh& mesh) : mesh_(mesh), tree_(std::make_unique<Tree>()) {
  if (mesh_.triangles.empty()) return;
  tree_->triangles = nearest::triangles_of(mesh_);
  tree_->aabb.insert(tree_->triangles.cbegin(), tree_->triangles.cend());
  tree_->aabb.accelerate_distance_queries();
  add_normals();
}

NearSurface::~NearSurface() = default;

// A point's normal is that of its triangles, each weighted with its angle there.
void NearSurface::add_normals() {
  tree_->of_point.resize(mesh_.points.size());
  tree_->is_rim.resize(mesh_.points.size(), false);
  for (const Triangle& t : mesh_.triangles) {
    const Vec p[] = {mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]};
    const Vec normal = unit(cross(p[1] - p[0], p[2] - p[0]));
    tree_->of_triangle.push_back(normal);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      Tree::Edge& edge = tree_->edges[edge_key(t[i], t[j])];
      edge.normal = edge.normal + normal;
      ++edge.triangles;
      const double angle = angle_between(p[j] - p[i], p[k] - p[i]);
      tree_->of_point[t[i]] = tree_->of_point[t[i]] + normal * angle;
    }
  }
  for (const auto& [key, edge] : tree_->edges) {
    if (edge.triangles > 1) continue;
    tree_->is_rim[key >> 32U] = tree_->is_rim[key & 0xFFFFFFFFU] = true;
  }
}

// The normal of what the place lies on: a triangle, an edge of it, or a corner.
Vec NearSurface::normal_at(std::size_t triangle, Vec at, bool& is_rim_out) const {
  const Triangle& t = mesh_.triangles[triangle];
  const Vec p[] = {mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]};
  const double twice_area = length(cross(p[1] - p[0], p[2] - p[0]));
  bool off[3];  // whether the place is off the edge opposite to each corner
  int edges = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec a = p[(i + 1) % 3], b = p[(i + 2) % 3];
    off[i] = length(cross(b - a, at - a)) > kOnEdge * twice_area;
    edges += off[i] ? 0 : 1;
  }
  is_rim_out = false;
  if (edges == 0 || edges == 3) return tree_->of_triangle[triangle];
  for (std::size_t i = 0; i < 3; ++i) {
    if (edges == 2 && off[i]) {  // on both edges that meet in this corner
      is_rim_out = tree_->is_rim[t[i]];
      return unit(tree_->of_point[t[i]]);
    }
    if (edges == 1 && !off[i]) {
      const Tree::Edge& edge = tree_->edges.at(edge_key(t[(i + 1) % 3], t[(i + 2) % 3]));
      is_rim_out = edge.triangles == 1;
      return unit(edge.normal);
    }
  }
  return {};
}

NearSurface::Place NearSurface::nearest(Vec to) const {
  const auto [point, primitive] = tree_->aabb.closest_point_and_primitive(point_of(to));
  Place place{{point.x(), point.y(), point.z()}, {}, false};
  const auto triangle = static_cast<std::size_t>(primitive - tree_->triangles.cbegin());
  place.normal = normal_at(triangle, place.at, place.is_rim);
  return place;
}

double NearSurface::outside(Vec place) const {
  const Place near = nearest(place);
  const Vec away = place - near.at;
  const double along = dot(away, near.normal);
  if (near.is_rim) return along;
  return along < 0 ? -length(away) : length(away);
}

}  // namespace stylet::offline
