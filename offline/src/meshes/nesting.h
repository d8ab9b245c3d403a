// SPDX-License-Identifier: GPL-3.0-or-later
// Which closed pieces of a surface lie within which, whichever way their faces are turned.
//
// From a piece's farthest point along a direction a ray goes on in that direction and meets no face
// of the piece again. The first other piece it meets holds it, if met from inside, or lies beside
// it, in the same one. Three directions vote, for rays that pass just where pieces touch. Time: n
// log n in the triangles, but the square of pieces that lie one in another, of which more than some
// thousands are refused. Source: CGAL's tree of boxes; CGAL's own volume_connected_components
// asks for a surface without crossings, which files do not promise.
#pragma once

#include <span>

#include "base/geometry.h"

namespace stylet::bake {

constexpr std::uint32_t kNoPiece = 0xFFFFFFFF;

// Closed surfaces with their signed volume, by the numbers of their triangles.
struct ClosedPiece {
  std::span<const std::uint32_t> triangles;
  double volume = 0;
};

// The innermost piece around each, which is larger; kNoPiece: none.
std::vector<std::uint32_t> pieces_around(const std::vector<Vec>& points,
                                         const std::vector<Triangle>& triangles,
                                         const std::vector<ClosedPiece>& pieces);

}  // namespace stylet::bake
