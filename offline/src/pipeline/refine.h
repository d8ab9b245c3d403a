// SPDX-License-Identifier: GPL-3.0-or-later
// Where a build makes its voxels finer than elsewhere (base/refinement.h).
//
// Promises: what cannot be meant is refused before the work begins; a user is told of a refinement
// that meets nothing of the organ. Units: metres.
#pragma once

#include <string>
#include <vector>

#include "pipeline/build.h"
#include "voxels/levels.h"

namespace stylet::offline {

// Refuses refinements of tissues that the organ does not have. `tissues` are those of the inputs.
void check_refinements(const BuildOptions& options, const std::vector<std::string>& tissues);

// The cells of each level that are no voxel's place. `claimed` is as the lattice will be made of
// it.
LevelCells absent_cells(const Claimed& claimed, const BuildOptions& options,
                        std::vector<std::string>& warnings);

}  // namespace stylet::offline
