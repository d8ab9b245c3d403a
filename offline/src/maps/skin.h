// SPDX-License-Identifier: GPL-3.0-or-later
// The surface of a label map: the faces between chosen voxels and others, and the same surface
// smoothed. Units: metres. Frame: the patient's (LPS).
#pragma once

#include "maps/groups.h"

namespace stylet::offline {

struct Quad {
  std::array<std::uint32_t, 4> corner;
};

struct Skin {
  std::vector<Vec> points;
  std::vector<Quad> quads;
};

// The surface of all groups together, corners counter-clockwise seen from outside.
Skin label_skin(const LabelMap& map, const Groups& groups);

// The part of the surface of `inside` beyond which there is tissue as well: a border in the organ.
Skin label_border(const LabelMap& map, const Groups& inside, const Groups& tissue);

Mesh triangles_of(const Skin& skin);

// Taubin 1995: shrinks and swells in turn, which removes steps and keeps the volume.
void smooth(Skin& skin, int rounds);

}  // namespace stylet::offline
