// SPDX-License-Identifier: Apache-2.0
// The mass with which the step moves tissue, as an operator on shapes of small motion about rest.
//
// It is the inverse of what the step makes of a momentum: added mass, the filter of true mass
// (laws/filter.h) or the cascade of levels (lattice/shadow.h), here in double.
//
// Promises: allocates; not for a tick. Units: SI.
#pragma once

#include "voxels.h"

namespace stylet {

// Mass in the step times shapes. `voxels`: all of the model.
Shapes stepped_mass(const Model& model, const std::vector<Voxel>& voxels, const Shapes& shapes);

}  // namespace stylet
