// SPDX-License-Identifier: GPL-3.0-or-later
// What a user chooses for a build, as the options of stylet-organ spell it, and the BuildOptions
// that follow. The program and the Python module share this: so the same choices give the same
// bytes from both, with the same text in the organ's provenance.
//
// Promise: what cannot be meant is refused with the option's name. Units: those in the names.
#pragma once

#include <string>
#include <vector>

#include "maps/recipe.h"
#include "pipeline/build.h"

namespace stylet::offline {

struct Settings {
  std::string name;  // of the organ; empty: that of the first input
  double voxel_mm = 5;
  std::uint32_t voxels_across = 0;
  std::string fit;  // rate that the program chose the edge for; only for the text
  std::string capsule = "auto";
  std::vector<std::string> fix = kDefaultFix;
  std::vector<std::string> crop;
  std::string materials;            // file
  std::vector<std::string> layers;  // each TISSUE:MM
  std::string layers_of;
  std::string layers_along = "+x";
  std::vector<std::string> membranes;  // each MESH:TISSUE or x=MM:TISSUE
  std::vector<std::string> slides;     // each TISSUE:GROUND or TISSUE:GROUND:FRICTION
  std::vector<std::string> refine;     // each as in base/refinement.h
  std::string fill_gaps;               // TISSUE:MM
  bool split_gaps = false;
  // Of meshes.
  std::string units;  // a key of kMetresPerUnit; empty: each file's own, or mm
  double scale = 1;
  bool wrap = false;
};

// The first words of the line in an organ that says what made it.
const char* tool_version();

// What the settings say of the units of meshes.
MeshUnits units_of(const Settings& settings);

// `units` are those of the meshes that options name.
BuildOptions common_options(const Settings& settings, const MeshUnits& units);

// Each text is TISSUE:MM. `option` is the option that refusals name.
std::vector<Layer> parse_layers(const std::vector<std::string>& texts, const char* option);

// The texts with a space between them.
std::string joined(const std::vector<std::string>& texts);

// A needle would enter a liver without capsule at a quarter of the force, over three times the
// distance: so a user who says only "liver" gets the organ with its natural capsule. `tissues` are
// those of the inputs.
void choose_capsule(const Settings& settings, const std::vector<std::string>& tissues,
                    BuildOptions& options);

// What a build of a label map needs besides common_options. `path` is the map's, `recipe_text`
// tells the recipe in the provenance.
struct LabelSource {
  const std::string& path;
  const std::string& recipe_text;
};
void choose_for_labels(const Settings& settings, const LabelSource& source, const Recipe& recipe,
                       BuildOptions& options);

// The same for meshes.
void choose_for_meshes(const Settings& settings, const std::vector<Input>& inputs,
                       BuildOptions& options);

// After all else: refuses where tissues slide or voxels are finer, if it cannot be meant; and notes
// the latter in the file's provenance. `tissues` are those of the inputs.
void settle_places(const std::vector<std::string>& tissues, BuildOptions& options);

}  // namespace stylet::offline
