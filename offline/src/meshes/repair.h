// SPDX-License-Identifier: GPL-3.0-or-later
// Turns a triangle soup into a solid as far as possible: equal points are merged, degenerate and
// repeated triangles dropped, faces turned outward. No point is moved and no hole is filled: an
// open mesh stays open, and the voxeliser decides what is inside.
//
// Promises: deterministic; the surface keeps every distinct triangle that has an area.
#pragma once

#include "base/geometry.h"

namespace stylet::offline {

// What repair found, in the words of the report.
struct RepairCounts {
  std::size_t triangles_read = 0;
  std::size_t points_merged = 0;  // bit-equal to an earlier point
  std::size_t points_unused = 0;
  std::size_t degenerate = 0;          // no area
  std::size_t duplicates = 0;          // same three points as an earlier triangle
  std::size_t border_edges = 0;        // edges with one face
  std::size_t non_manifold_edges = 0;  // edges with more than two faces
  std::size_t inconsistent_edges = 0;  // their faces disagree which side is outside
  std::size_t triangles_turned = 0;    // so that neighbours agree and face outward
  std::size_t pieces = 0;              // connected through shared edges
};

struct Solid {
  Mesh surface;                    // for embedding and display
  std::vector<Triangle> boundary;  // of the same points; without triangles that cancel each other
  RepairCounts counts;
  bool closed = false;    // no open edge in `boundary`
  bool oriented = false;  // neighbours agree everywhere: winding numbers can be trusted
};

Solid repair(Mesh mesh);

// Turns triangles so that neighbours agree as far as possible (CGAL). In meshes/orient.cpp.
void orient_neighbours(const std::vector<Vec>& points, std::vector<Triangle>& triangles);

}  // namespace stylet::offline
