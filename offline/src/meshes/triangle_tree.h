// SPDX-License-Identifier: GPL-3.0-or-later
// A bounding-volume tree over triangles. It tells how often the surface winds around a point
// (generalised winding number, Jacobson et al. 2013; a distant cluster of triangles is replaced by
// one dipole, Barill et al. 2018), and how often a ray crosses the surface.
//
// Promises: solid angles near the point are exact; the dipoles' total error is a few thousandths,
// against a threshold of one half. Deterministic. Units: those of the points.
#pragma once

#include "base/geometry.h"

namespace stylet::offline {

struct TriangleTree {
  struct Node {
    Box box;
    Vec centre;               // centroid of the area
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

}  // namespace stylet::offline
