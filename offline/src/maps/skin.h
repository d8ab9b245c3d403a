// SPDX-License-Identifier: GPL-3.0-or-later
// The surface of a label map: the faces between chosen voxels and others, and the same without
// steps. Units: metres. Frame: the patient's (LPS).
#pragma once

#include "maps/groups.h"

namespace stylet::bake {

struct Quad {
  std::array<std::uint32_t, 4> corner;
};

struct Skin {
  std::vector<Vec> points;
  std::vector<Quad> quads;
};

// Of all groups together, corners counter-clockwise from outside.
Skin label_skin(const LabelMap& map, const Groups& groups);

Mesh triangles_of(const Skin& skin);

// Taubin 1995: shrinks and swells in turn, so that steps go and the volume stays.
void smooth(Skin& skin, int rounds);

}  // namespace stylet::bake
