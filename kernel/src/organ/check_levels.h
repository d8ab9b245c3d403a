// SPDX-License-Identifier: Apache-2.0
// Whether a tick may use what an organ file says of the levels of its lattice.
#pragma once

#include "organ/checker.h"
#include "stylet/organ.h"

namespace stylet {

// `organ` has levels; its runs and sheets have been checked.
bool check_levels(Checker& check, const Organ& organ);

}  // namespace stylet
