// SPDX-License-Identifier: Apache-2.0
// Whether a tick may use what an organ file says of the levels of its lattice.
#pragma once

#include "organ/checker.h"
#include "stylet/organ.h"

namespace stylet {

// `organ` has levels; its runs and sheets have been checked.
bool check_levels(Checker& check, const Organ& organ);

// Of a plane below size_z, of an organ whose levels have been checked, or that has one: whether it
// is one of those that are empty between levels; and whether cells up to these ends lie in space.
bool is_between_levels(const Organ& organ, std::uint32_t z);
bool is_in_space(const Organ& organ, std::uint32_t end_x, std::uint32_t end_y, std::uint32_t z);

}  // namespace stylet
