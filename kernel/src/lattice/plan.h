// SPDX-License-Identifier: Apache-2.0
// The lattice as the sweep walks it, worked out once: where voxels and nodes lie, and which slots
// forces to which particles, so that the sweep walks flat lists.
//
// A window is a group of lanes: neighbouring nodes of one line (y) of a voxel plane. It collects
// forces from the voxel rows on both sides, y - 1 and y, whose ends may differ: a bit for each lane
// lane says which of them has a voxel there. Of either it reaches one stretch (runs.h), so it may
// be cut short.
//
// Promises: time and memory grow with the voxels, not with what they span (kMaxBytesPerVoxel); no
// count wraps; no allocation. At creation only.
#pragma once

#include "state/layout.h"

namespace stylet {

// kOrganTooLarge if a count does not fit.
Status count_lattice(const Organ& organ, const Config& config, Counts& counts_out);

// Fills planes, rows with the places of their particles, and windows; needs the head.
void fill_lattice(const Organ& organ, Model& model);

}  // namespace stylet
