// SPDX-License-Identifier: GPL-3.0-or-later
// Reduces the triangles of a surface for display and touch: the skin of a label map has two for
// each face of a voxel. Edges collapse where the surface changes least (CGAL; Lindstrom and Turk
// 1998); thin tips disappear first. Skins that meet along an edge are separated there.
//
// Promises: a mesh with at most `most` triangles is unchanged; same input, same bytes.
#pragma once

#include "base/geometry.h"

namespace stylet::offline {

Mesh with_fewer_triangles(const Mesh& mesh, std::size_t most);

}  // namespace stylet::offline
