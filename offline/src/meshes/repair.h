// SPDX-License-Identifier: GPL-3.0-or-later
// From a triangle soup to a solid as far as there is one: equal points merged, degenerate and
// repeated triangles dropped, faces turned outward. Nothing is moved and no hole is filled: what is
// open stays open, and the voxeliser decides there.
//
// Promises: deterministic; the surface keeps every distinct triangle that has an area.
#pragma once

#include "base/geometry.h"

namespace stylet::bake {

// What was found; the words of the report.
struct RepairCounts {
  std::size_t triangles_read = 0;
  std::size_t points_merged = 0;  // bit-equal to an earlier point
  std::size_t points_unused = 0;
  std::size_t degenerate = 0;          // no area
  std::size_t duplicates = 0;          // same three points as an earlier triangle
  std::size_t border_edges = 0;        // one face
  std::size_t non_manifold_edges = 0;  // more than two faces
  std::size_t inconsistent_edges = 0;  // faces disagree about the side that is outside
  std::size_t triangles_turned = 0;    // so that neighbours agree and outside is outside
  std::size_t pieces = 0;              // connected through shared edges
};

struct Solid {
  Mesh surface;                    // what is embedded and shown
  std::vector<Triangle> boundary;  // the same points; without sheets that cancel each other
  RepairCounts counts;
  bool closed = false;    // no open edge in `boundary`
  bool oriented = false;  // neighbours agree everywhere: winding numbers can be trusted
};

Solid repair(Mesh mesh);

// Turns triangles so that neighbours agree as far as possible (CGAL). In meshes/orient.cpp.
void orient_neighbours(const std::vector<Vec>& points, std::vector<Triangle>& triangles);

}  // namespace stylet::bake
