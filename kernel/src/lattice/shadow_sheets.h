// SPDX-License-Identifier: Apache-2.0
// Shadows (lattice/shadow.h) where a lattice has sheets: parts that are not joined have shadows of
// their own, so that none moves with the other.
//
// Promises: no allocation; at creation only. A tie is looked for among those of the finer nodes
// that a shadow moves.
#pragma once

#include "lattice/shadow_walk.h"

namespace stylet {

// The sheet whose shadow a place has: of those that are tied to its own around it, the first.
std::uint32_t shadow_sheet(const Organ& organ, const LevelPlace& at);

// Whether a corner of a shadow cell is a node of its level. In another sheet, or beside a voxel of
// another part, only what hangs there tells.
bool find_level_node(const Organ& organ, const LevelPlace& at, LatticePlace& node_out);

}  // namespace stylet
