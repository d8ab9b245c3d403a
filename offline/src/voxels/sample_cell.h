// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the 64 sample points of a cell are inside a solid.
//
// The generalised winding number is sure but slow. Within one cell of a closed surface it changes
// only where the way from one sample to the next crosses a triangle of that cell, so there it is
// found once and then counted on; a crossing too close to an edge to be sure of is not counted but
// looked up again. Units: lattice (cells of edge 1).
#pragma once

#include <span>

#include "meshes/triangle_tree.h"

namespace stylet::bake {

struct InsideTest {
  const TriangleTree& tree;
  bool by_winding;  // else thirteen rays vote
};

// Place of a sample in its cell.
Vec sample_point(std::uint32_t i);

bool is_inside(const InsideTest& test, Vec point);

// Bit i is sample point i. `low_corner` is the cell's.
std::uint64_t sample_cell(const InsideTest& test, Vec low_corner);

// The same for a closed, oriented surface; `near` are all its triangles that touch the cell.
std::uint64_t sample_cell(const InsideTest& test, Vec low_corner,
                          std::span<const std::array<Vec, 3>> near);

}  // namespace stylet::bake
