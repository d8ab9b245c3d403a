// SPDX-License-Identifier: Apache-2.0
// Whether a tick may use what an organ file says of parts that slide.
#pragma once

#include "organ/checker.h"
#include "stylet/organ.h"

namespace stylet {

// `organ` has slides; its other lists have been read.
bool check_slides(Checker& check, const Organ& organ);

}  // namespace stylet
