// SPDX-License-Identifier: GPL-3.0-or-later
// Where an organ has finer voxels than elsewhere, as a user says it:
//
//   way:X,Y,Z:X,Y,Z:MM      within a radius of the needle's way, from its entry to its target
//   box:X,Y,Z:X,Y,Z         in a box, from its low to its high corner
//   labels:TISSUE,TISSUE    where there is any of these tissues
//   surface                 at the organ's outer surface
//
// Each may end in :LEVELS, which says how many times the voxel's edge is halved there.
// Units: mm, in the organ's frame (of a label map: the patient's), whatever the meshes' unit is.
#pragma once

#include <string>
#include <vector>

#include "base/geometry.h"
#include "stylet/limits.h"

namespace stylet::offline {

constexpr std::uint32_t kMostHalvings = kMaxLevels - 1;

struct Refinement {
  enum class Kind { kWay, kBox, kLabels, kSurface } kind = Kind::kSurface;
  Vec from_mm, to_mm;  // ends of a way; corners of a box
  double radius_mm = 0;
  std::vector<std::string> tissues;
  std::uint32_t levels = 1;
  std::string from;  // where the user wrote it, and what: for messages
};

// `place` is the option, or the line of a file, that refusals name.
Refinement parse_refinement(const std::string& text, const std::string& place);

// As in the list above, always with its levels.
std::string text_of(const Refinement& refinement);

// How many times the edge is halved where it is finest.
std::uint32_t most_halvings(const std::vector<Refinement>& refinements);

}  // namespace stylet::offline
