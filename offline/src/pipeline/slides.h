// SPDX-License-Identifier: GPL-3.0-or-later
// Tissues of a build that slide on each other: reads the user's options, decides which inputs are
// kept apart, and makes the points and grounds of the organ.
//
// Promises: an impossible option is refused with its name; warnings tell the user where parts do
// not meet, and which surface is left out. Units: metres.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/build.h"
#include "voxels/apart.h"
#include "voxels/slides.h"

namespace stylet::offline {

// Each text is TISSUE:GROUND or TISSUE:GROUND:FRICTION.
std::vector<Slide> parse_slides(const std::vector<std::string>& texts);

// Refuses slides of tissues that no input has, and pairs that are there twice.
void check_slides(const BuildOptions& options, const std::vector<std::string>& tissues);

// TISSUE:GROUND:FRICTION
std::string text_of(const Slide& slide);

// Which owners are apart; `tissues` are those of the owners.
ApartOwners apart_owners(const std::vector<Slide>& slides, const std::vector<std::string>& tissues);

// Points and grounds of all slides. `claimed` is what the lattice was made of.
SlideLists place_slides(const std::vector<Slide>& slides, const Claimed& claimed,
                        std::span<const Lattice> levels, std::vector<std::string>& warnings);

}  // namespace stylet::offline
