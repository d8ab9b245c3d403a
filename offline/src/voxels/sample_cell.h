// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the 64 sample points of a cell are inside a solid.
//
// The generalised winding number is reliable but slow. For a closed surface, within a cell it
// changes only where the way between two samples crosses a triangle. So it is computed once for a
// cell and then changed at each crossing; where a crossing is too close to a triangle's edge to be
// certain, the number is computed anew. Units: lattice (cells of edge 1).
#pragma once

#include <span>

#include "meshes/triangle_tree.h"

namespace stylet::offline {

struct InsideTest {
  const TriangleTree& tree;
  bool by_winding;  // false: thirteen rays vote
};

// Place of a sample in its cell.
Vec sample_point(std::uint32_t i);

bool is_inside(const InsideTest& test, Vec point);

// Of rays in 26 directions, both ways along the thirteen, the part that meets the surface an odd
// number of times.
double odd_rays(const TriangleTree& tree, Vec point);

// Bit i is for sample point i. `low_corner` is that of the cell.
std::uint64_t sample_cell(const InsideTest& test, Vec low_corner);

// The same for a closed, oriented surface; `near` has all its triangles that touch the cell.
std::uint64_t sample_cell(const InsideTest& test, Vec low_corner,
                          std::span<const std::array<Vec, 3>> near);

}  // namespace stylet::offline
