// SPDX-License-Identifier: GPL-3.0-or-later
// A surface of fewer triangles, for display and touch: the skin of a map has one of them for each
// half of a face of its voxels. Edges collapse where the surface changes least (CGAL; Lindstrom and
// Turk 1998); thin tips wear off first. Where skins meet along an edge they come apart there.
//
// Promises: unchanged if it has no more than `most`; same input, same bytes.
#pragma once

#include "base/geometry.h"

namespace stylet::bake {

Mesh with_fewer_triangles(const Mesh& mesh, std::size_t most);

}  // namespace stylet::bake
