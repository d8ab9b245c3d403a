// SPDX-License-Identifier: GPL-3.0-or-later
// Membranes as the organ file has them: the triangles of each, listed by the cells of space that
// they touch.
//
// Promises: a triangle is in the list of every cell that it touches, rounding included; areas are
// those within the cells. The result depends on the surfaces' order only by their numbers.
// Units: metres.
#pragma once

#include <array>
#include <vector>

#include "base/geometry.h"
#include "stylet/organ.h"

namespace stylet::offline {

// The cells of space that a lattice covers.
struct CellGrid {
  Vec origin_m;
  double edge_m = 0;
  std::array<std::uint32_t, 3> size{};
};

struct MembraneSurface {
  Mesh mesh_m;
  std::uint16_t material = 0;
};

struct MembraneLists {
  std::vector<OrganPoint> points;
  std::vector<OrganTriangle> triangles;
  std::vector<OrganMembraneCell> cells;  // sorted by z, y, x, material
};
MembraneLists list_membranes(const std::vector<MembraneSurface>& surfaces, const CellGrid& grid);

// Most triangles in one cell.
std::size_t most_in_a_cell(const MembraneLists& lists);

double area_m2(const Mesh& mesh);

}  // namespace stylet::offline
