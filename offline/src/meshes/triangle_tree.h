// SPDX-License-Identifier: GPL-3.0-or-later
// A bounding-volume tree over triangles that answers "how often does the surface wind round this
// point" (generalised winding number, Jacobson et al. 2013; clusters far away count as one dipole,
// Barill et al. 2018) and "how often does this ray cross the surface".
//
// Promises: exact solid angles near the point; far clusters err by a few thousandths in sum,
// against a threshold of one half. Deterministic. Units: those of the points.
#pragma once

#include "base/geometry.h"

namespace stylet::bake {

struct TriangleTree {
  struct Node {
    Box box;
    Vec centre;               // of area
    Vec area_normal;          // sum of triangle normals, each as long as the triangle's area
    double radius = 0;        // around centre, of everything below
    std::uint32_t first = 0;  // leaf: first corner triple; inner: left child, the right one follows
    std::uint32_t count = 0;  // triangles of a leaf; 0: inner node
  };
  std::vector<Node> nodes;                  // root first
  std::vector<std::array<Vec, 3>> corners;  // of each triangle, in leaf order
};

TriangleTree triangle_tree(const std::vector<Vec>& points, const std::vector<Triangle>& triangles);

// 1 inside a closed surface that faces outward, 0 outside; in between near holes.
double winding_number(const TriangleTree& tree, Vec point);

// Number of triangles that the ray from `point` crosses.
int crossings(const TriangleTree& tree, Vec point, Vec ray);

}  // namespace stylet::bake
