// SPDX-License-Identifier: Apache-2.0
// Shadows (lattice/shadow.h) where a lattice has sheets: parts that are not joined have shadows of
// their own, so that none moves with the other.
//
// Promises: no allocation; at creation only. A search for a tie looks only at the finer nodes that
// a shadow moves.
#pragma once

#include "lattice/shadow_walk.h"

namespace stylet {

// The sheet whose shadow is used at a place: the first of the sheets that ties around the place
// join to the place's own sheet.
std::uint32_t shadow_sheet(const Organ& organ, const LevelPlace& at);

// Whether a corner of a shadow cell is a node of its level. If a node there is in another sheet, or
// beside a voxel of another part, only the nodes that hang at this place can tell.
bool find_level_node(const Organ& organ, const LevelPlace& at, LatticePlace& node_out);

}  // namespace stylet
