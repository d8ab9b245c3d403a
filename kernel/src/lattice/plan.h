// SPDX-License-Identifier: Apache-2.0
// The plan: flat lists that the sweep of the lattice follows, computed once at creation. They say
// where voxels and nodes lie, and which slots send forces to which particles.
//
// A window is a group of lanes: neighbouring nodes of one line (y) of a voxel plane. It collects
// forces from the voxel rows on both sides, y - 1 and y, whose ends may differ: a bit for each lane
// says which of the rows has a voxel there. A window reaches one stretch (runs.h) of either row, so
// it may be cut short.
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
