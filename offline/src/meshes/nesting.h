// SPDX-License-Identifier: GPL-3.0-or-later
// Which closed pieces of a surface lie within which, whichever way their faces are turned.
//
// A ray starts at a piece's farthest point in a direction, goes in that direction and so meets no
// face of that piece. If it meets the first other piece from inside, that piece contains this one;
// if from outside, the same piece contains both. Three directions vote, since a ray may pass where
// pieces touch. Time: n log n in triangles, but quadratic in pieces nested in each other; more
// than some thousands of those are refused. Source: CGAL's tree of boxes. CGAL's own
// volume_connected_components requires a surface without crossings, which files do not promise.
#pragma once

#include <span>

#include "base/geometry.h"

namespace stylet::offline {

constexpr std::uint32_t kNoPiece = 0xFFFFFFFF;

// A closed surface: the indices of its triangles, and its signed volume.
struct ClosedPiece {
  std::span<const std::uint32_t> triangles;
  double volume = 0;
};

// For each piece, the innermost larger piece around it; kNoPiece if there is none.
std::vector<std::uint32_t> pieces_around(const std::vector<Vec>& points,
                                         const std::vector<Triangle>& triangles,
                                         const std::vector<ClosedPiece>& pieces);

}  // namespace stylet::offline
