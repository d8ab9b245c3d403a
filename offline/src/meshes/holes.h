// SPDX-License-Identifier: GPL-3.0-or-later
// The holes of a surface, and a patch over each: a fan of triangles from its middle. The patched
// surface has no border any more, so that it is watertight wherever the surface had only holes.
// What a patch looks like matters to nobody: it lies where nothing is known.
//
// Promises: deterministic; works for any faces, also where they disagree, since the border of
// oriented triangles always is a set of closed ways. Time: n log n in triangles.
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
