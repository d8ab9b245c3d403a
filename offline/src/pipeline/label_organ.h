// SPDX-License-Identifier: GPL-3.0-or-later
// A label map and a recipe to the bytes of an organ file, in the patient's frame (LPS, metres).
//
// A voxel of the lattice is as full as its 64 samples say, and of the tissue that most of them are.
// The surface is that of all chosen labels together, smoothed (Taubin) off the steps of the map; it
// serves contact and display, the volume is that of the labels.
// Promises: as pipeline/build.h.
#pragma once

#include "maps/label_map.h"
#include "maps/recipe.h"
#include "pipeline/build.h"

namespace stylet::bake {

// `path` is for messages and provenance. Refuses a recipe none of whose labels is in the map.
Built build_labels(const std::string& path, const LabelMap& map, const Recipe& recipe,
                   const BuildOptions& options, const Progress& progress);

}  // namespace stylet::bake
