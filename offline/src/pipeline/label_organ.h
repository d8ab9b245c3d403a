// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the bytes of an organ file from a label map and a recipe, in the patient's frame (LPS, m).
//
// The 64 samples of a voxel decide its fill, and the tissue with most samples becomes its tissue.
// The surface is that of all chosen labels together, with the map's steps smoothed (Taubin). It is
// for contact and display; the volume is that of the labels.
// Promises: those of pipeline/build.h.
#pragma once

#include "maps/label_map.h"
#include "maps/recipe.h"
#include "pipeline/build.h"

namespace stylet::offline {

// `path` is for messages and provenance. Refuses a recipe none of whose labels is in the map.
Built build_labels(const std::string& path, const LabelMap& map, const Recipe& recipe,
                   const BuildOptions& options, const Progress& progress);

}  // namespace stylet::offline
