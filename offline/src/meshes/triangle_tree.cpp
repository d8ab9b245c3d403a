// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/triangle_tree.h"

#include <numeric>
#include <utility>

namespace stylet::offline {
namespace {

constexpr std::uint32_t kLeafTriangles = 8;
constexpr double kPi = 3.14159265358979323846;
// A cluster is far if its distance from the point is at least this many of its radii.
constexpr double kFar = 2.3;
// Halving 2^32 triangles gives a depth of 32, with both children of a node on the stack.
constexpr std::size_t kStack = 80;

using Corners = std::array<Vec, 3>;

void summarise(TriangleTree& tree, TriangleTree::Node& node, std::uint32_t first,
               std::uint32_t end) {
  double area_sum = 0;
  Vec weighted;
  for (std::uint32_t i = first; i < end; ++i) {
    const Corners& c = tree.corners[i];
    for (const Vec& p : c) grow(node.box, p);
    const Vec normal = cross(c[1] - c[0], c[2] - c[0]) * 0.5;
    const double area = length(normal);
    node.area_normal = node.area_normal + normal;
    weighted = weighted + (c[0] + c[1] + c[2]) * (area / 3);
    area_sum += area;
  }
  node.centre = area_sum > 0 ? weighted * (1 / area_sum) : (node.box.low + node.box.high) * 0.5;
  for (std::uint32_t i = first; i < end; ++i) {
    for (const Vec& p : tree.corners[i]) {
      node.radius = std::max(node.radius, length(p - node.centre));
    }
  }
}

// Halves [first, end) by the triangles' middles along the box's longest side.
std::uint32_t split(TriangleTree& tree, const Box& box, std::uint32_t first, std::uint32_t end) {
  const Vec size = box.high - box.low;
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto middle = [axis](const Corners& c) { return c[0][axis] + c[1][axis] + c[2][axis]; };
  std::stable_sort(tree.corners.begin() + first, tree.corners.begin() + end,
                   [&](const Corners& a, const Corners& b) { return middle(a) < middle(b); });
  return first + (end - first) / 2;
}

// Van Oosterom and Strackee 1983: the solid angle of a triangle seen from the origin.
double solid_angle(Vec a, Vec b, Vec c) {
  const double la = length(a), lb = length(b), lc = length(c);
  const double numerator = dot(a, cross(b, c));
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * std::atan2(numerator, denominator);
}

bool ray_meets_box(const Box& box, Vec point, Vec inverse) {
  double near = 0;
  double far = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = (box.low[axis] - point[axis]) * inverse[axis];
    const double b = (box.high[axis] - point[axis]) * inverse[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

// Whether a ray meets a triangle: Moeller and Trumbore 1997.
bool ray_meets_triangle(const Corners& c, Vec point, Vec ray) {
  const Vec edge_1 = c[1] - c[0], edge_2 = c[2] - c[0];
  const Vec p = cross(ray, edge_2);
  const double determinant = dot(edge_1, p);
  if (determinant == 0) return false;
  const Vec from = point - c[0];
  const double u = dot(from, p) / determinant;
  const Vec q = cross(from, edge_1);
  const double v = dot(ray, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && dot(edge_2, q) / determinant > 0;
}

}  // namespace

TriangleTree triangle_tree(const std::vector<Vec>& points, const std::vector<Triangle>& triangles) {
  TriangleTree tree;
  for (const Triangle& t : triangles) {
    tree.corners.push_back({points[t[0]], points[t[1]], points[t[2]]});
  }
  if (triangles.empty()) return tree;
  tree.nodes.reserve(triangles.size());
  tree.nodes.emplace_back();
  struct Task {
    std::uint32_t node, first, end;
  };
  std::vector<Task> tasks{{0, 0, static_cast<std::uint32_t>(triangles.size())}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    TriangleTree::Node node;
    summarise(tree, node, task.first, task.end);
    if (task.end - task.first <= kLeafTriangles) {
      node.first = task.first;
      node.count = task.end - task.first;
    } else {
      const std::uint32_t middle = split(tree, node.box, task.first, task.end);
      node.first = static_cast<std::uint32_t>(tree.nodes.size());
      tree.nodes.resize(tree.nodes.size() + 2);
      tasks.push_back({node.first, task.first, middle});
      tasks.push_back({node.first + 1, middle, task.end});
    }
    tree.nodes[task.node] = node;
  }
  return tree;
}

double winding_number(const TriangleTree& tree, Vec point) {
  if (tree.nodes.empty()) return 0;
  std::array<std::uint32_t, kStack> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  double angle = 0;
  while (depth > 0) {
    const TriangleTree::Node& node = tree.nodes[stack[--depth]];
    const Vec away = node.centre - point;
    const double distance_2 = dot(away, away);
    if (distance_2 > kFar * kFar * node.radius * node.radius) {
      angle += dot(node.area_normal, away) / (distance_2 * std::sqrt(distance_2));
    } else if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const Corners& c = tree.corners[i];
        angle += solid_angle(c[0] - point, c[1] - point, c[2] - point);
      }
    } else {
      stack[depth++] = node.first;
      stack[depth++] = node.first + 1;
    }
  }
  return angle / (4 * kPi);
}

int crossings(const TriangleTree& tree, Vec point, Vec ray) {
  if (tree.nodes.empty()) return 0;
  const Vec inverse{1 / ray.x, 1 / ray.y, 1 / ray.z};
  std::array<std::uint32_t, kStack> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  int count = 0;
  while (depth > 0) {
    const TriangleTree::Node& node = tree.nodes[stack[--depth]];
    if (!ray_meets_box(node.box, point, inverse)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      count += ray_meets_triangle(tree.corners[i], point, ray) ? 1 : 0;
    }
  }
  return count;
}

}  // namespace stylet::offline
