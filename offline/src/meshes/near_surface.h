// SPDX-License-Identifier: GPL-3.0-or-later
// Where a surface lies nearest to a place, which way it faces there, and how far outside of it the
// place is. CGAL's AABB tree finds the place; normals at edges and corners are those of Baerentzen
// and Aanaes 2005, which tell inside from outside exactly.
//
// Promises: deterministic; log n in the triangles. Units: those of the mesh.
#pragma once

#include <memory>

#include "base/geometry.h"

namespace stylet::offline {

class NearSurface {
 public:
  struct Place {
    Vec at;
    Vec normal;           // outwards; of length 1, or 0 where the surface folds back onto itself
    bool is_rim = false;  // on an edge with one triangle
  };

  // `mesh` may be open; corners run counter-clockwise, seen from outside. Of an empty one nothing
  // may be asked.
  explicit NearSurface(const Mesh& mesh);
  ~NearSurface();
  NearSurface(const NearSurface&) = delete;
  NearSurface& operator=(const NearSurface&) = delete;

  Place nearest(Vec to) const;
  // Positive outside. Beyond an open surface's rim: from the plane in which it ends.
  double outside(Vec place) const;

 private:
  struct Tree;
  Vec normal_at(std::size_t triangle, Vec at, bool& is_rim_out) const;
  void add_normals();

  Mesh mesh_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace stylet::offline
