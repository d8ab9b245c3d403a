// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a mesh finer where another surface is near, so that whole triangles are on one side of it.
//
// Promises: the same surface, and no new gaps or open edges. Time: a search for each longer edge.
#pragma once

#include "base/geometry.h"

namespace stylet::offline {

// Halves edges that are longer than `longest` and no farther from the other surface than they are
// long. Units: those of the meshes.
Mesh refined_near(Mesh mesh, const Mesh& other, double longest);

}  // namespace stylet::offline
