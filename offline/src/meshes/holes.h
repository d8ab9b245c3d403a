// SPDX-License-Identifier: GPL-3.0-or-later
// The holes of a surface, and a patch over each: a fan of triangles from its middle. The patched
// surface has no border left, so it is watertight if holes were all that was wrong. The shape of a
// patch does not matter, because nothing is known of the surface there.
//
// Promises: deterministic; works for any faces, even if they disagree, because the border of
// oriented triangles is always a set of closed paths. Time: n log n in triangles.
#pragma once

#include "meshes/repair.h"

namespace stylet::offline {

struct Hole {
  Vec middle;
  double across = 0;  // about its greatest width: from the corner farthest from the middle
};

struct Patched {
  Mesh mesh;
  std::vector<Hole> holes;  // the widest first
};

Patched patch_holes(const Solid& solid);

}  // namespace stylet::offline
