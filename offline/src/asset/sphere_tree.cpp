// SPDX-License-Identifier: GPL-3.0-or-later
#include "asset/sphere_tree.h"

#include <numeric>

namespace stylet::offline {
namespace {

constexpr std::uint32_t kLeafTriangles = 8;

struct Sphere {
  Vec centre;
  double radius = 0;
};

struct Leaf {
  Sphere sphere;
  std::uint32_t first, count;
};

// Rounds to float and enlarges by more than the errors of rounding and of the kernel's arithmetic.
OrganSphere rounded(const Sphere& s, std::uint32_t first, std::uint32_t count) {
  constexpr double kFloatRounding = 4e-7;
  const double reach = std::abs(s.centre.x) + std::abs(s.centre.y) + std::abs(s.centre.z);
  const double radius = s.radius + kFloatRounding * (reach + s.radius);
  return {static_cast<float>(s.centre.x),
          static_cast<float>(s.centre.y),
          static_cast<float>(s.centre.z),
          static_cast<float>(radius),
          first,
          count};
}

// Centre: that of the points' box. Radius: the distance of the farthest point.
Sphere around(const std::vector<Vec>& points, const std::vector<Triangle>& triangles,
              const std::uint32_t* first, const std::uint32_t* end) {
  Box box;
  for (const auto* i = first; i != end; ++i) {
    for (const std::uint32_t corner : triangles[*i]) grow(box, points[corner]);
  }
  Sphere s{(box.low + box.high) * 0.5, 0};
  for (const auto* i = first; i != end; ++i) {
    for (const std::uint32_t corner : triangles[*i]) {
      s.radius = std::max(s.radius, length(points[corner] - s.centre));
    }
  }
  return s;
}

// The smallest sphere that contains two others.
Sphere around(const Sphere& a, const Sphere& b) {
  const Vec between = b.centre - a.centre;
  const double distance = length(between);
  if (distance + b.radius <= a.radius) return a;
  if (distance + a.radius <= b.radius) return b;
  const double radius = (distance + a.radius + b.radius) / 2;
  return {a.centre + between * ((radius - a.radius) / distance), radius};
}

std::vector<Leaf> make_leaves(const std::vector<Vec>& points,
                              const std::vector<Triangle>& triangles,
                              const std::vector<std::uint32_t>& voxel_of,
                              std::vector<std::uint32_t>& order) {
  order.resize(triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return voxel_of[a] < voxel_of[b]; });
  std::vector<Leaf> leaves;
  for (std::uint32_t first = 0; first < order.size();) {
    std::uint32_t end = first;
    while (end < order.size() && end - first < kLeafTriangles &&
           voxel_of[order[end]] == voxel_of[order[first]]) {
      ++end;
    }
    leaves.push_back(
        {around(points, triangles, order.data() + first, order.data() + end), first, end - first});
    first = end;
  }
  return leaves;
}

std::size_t halve(std::vector<Leaf>& leaves, std::size_t first, std::size_t end) {
  Box box;
  for (std::size_t i = first; i < end; ++i) grow(box, leaves[i].sphere.centre);
  const Vec size = box.high - box.low;
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::stable_sort(leaves.begin() + static_cast<std::ptrdiff_t>(first),
                   leaves.begin() + static_cast<std::ptrdiff_t>(end),
                   [axis](const Leaf& a, const Leaf& b) {
                     return a.sphere.centre[axis] < b.sphere.centre[axis];
                   });
  return first + (end - first) / 2;
}

}  // namespace

SphereTree sphere_tree(const std::vector<Vec>& points_m, const std::vector<Triangle>& triangles,
                       const std::vector<std::uint32_t>& voxel_of) {
  SphereTree tree;
  if (triangles.empty()) return tree;
  std::vector<Leaf> leaves = make_leaves(points_m, triangles, voxel_of, tree.order);
  struct Span {
    std::size_t first, end;
  };
  std::vector<Span> spans{{0, leaves.size()}};  // of each node; grows during the loop
  std::vector<std::uint32_t> child(1, 0);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Span span = spans[i];
    if (span.end - span.first == 1) continue;
    const std::size_t middle = halve(leaves, span.first, span.end);
    child[i] = static_cast<std::uint32_t>(spans.size());
    spans.push_back({span.first, middle});
    spans.push_back({middle, span.end});
    child.resize(spans.size(), 0);
  }
  // Children come after their parents, so spheres are computed from the end.
  std::vector<Sphere> spheres(spans.size());
  tree.nodes.resize(spans.size());
  for (std::size_t i = spans.size(); i-- > 0;) {
    const bool is_leaf = child[i] == 0;
    const Leaf& leaf = leaves[spans[i].first];
    spheres[i] = is_leaf ? leaf.sphere : around(spheres[child[i]], spheres[child[i] + 1]);
    tree.nodes[i] =
        is_leaf ? rounded(spheres[i], leaf.first, leaf.count) : rounded(spheres[i], child[i], 0);
    // A parent must contain the sphere as the file has it, after rounding.
    const OrganSphere& s = tree.nodes[i];
    spheres[i] = {{static_cast<double>(s.x), static_cast<double>(s.y), static_cast<double>(s.z)},
                  static_cast<double>(s.radius)};
  }
  return tree;
}

}  // namespace stylet::offline
