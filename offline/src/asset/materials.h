// SPDX-License-Identifier: GPL-3.0-or-later
// Tissues by name: the presets, and those of the user's TOML file, which take precedence.
//
// Promises: a file is accepted whole, or refused with `file:line: key: ...` and what is allowed.
// Units: SI here; the keys of the TOML file name their own units. The numbers, their keys and
// limits are those of stylet/material.h.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "stylet/material.h"

namespace stylet::offline {

#define STYLET_TISSUE_NUMBER(field, ...) double field = 0;
struct Tissue {
  std::string name;
  std::string source;  // where the numbers come from
  STYLET_MATERIAL_NUMBERS(STYLET_TISSUE_NUMBER)
};
#undef STYLET_TISSUE_NUMBER

// A number of a tissue: its key in a table, its unit, and its limits in that unit.
struct TissueNumber {
  const char* key;
  double Tissue::*field;
  double si_per_unit;
  double least, most;
  bool must_be_given;  // of a new tissue, which else has 0
};
const std::vector<TissueNumber>& tissue_numbers();

// The shortest decimal that reads as the same float, as a double: 0.1F is shown as 0.1.
double shown(float value);

const std::vector<Tissue>& preset_tissues();

// One table per tissue. A table named like a preset replaces it; keys left out keep its values.
std::vector<Tissue> read_tissues(const std::filesystem::path& toml_file);

// Refuses an unknown name and lists the known ones.
const Tissue& find_tissue(const std::vector<Tissue>& own, const std::string& name);

// A tissue in a layer of this thickness. The kernel spreads a tissue's membrane over one voxel. In
// a layer of several voxels each voxel would carry the whole membrane, so here the membrane is
// spread over the layer and becomes part of the modulus. (Giving it to the layer's first voxels
// only was tried: they are partly filled and form stairs, and a sloping layer lost its membrane as
// voxels became finer.)
Tissue in_layer(Tissue tissue, double thickness_m, double edge_m);

}  // namespace stylet::offline
