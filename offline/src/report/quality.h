// SPDX-License-Identifier: GPL-3.0-or-later
// How good an organ is: what of the input it kept, what it lost, how far its surfaces lie off.
//
// Two surfaces are measured against the input's: the embedded one, which the needle meets and the
// eye sees, in both directions; and how far the voxels, which give way, stick out. Units: metres.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "asset/organ_shape.h"
#include "meshes/distance.h"
#include "pipeline/build.h"

namespace stylet::bake {

// Voxels that hang together through shared corners; pieces without a held corner float.
struct LatticePiece {
  std::size_t voxels = 0;
  double volume_m3 = 0;
  bool held = false;
};

struct Quality {
  // Unmeasured (no samples) where a surface is missing.
  Deviation surface_to_input, input_to_surface, faces_to_input;
  std::vector<LatticePiece> pieces;  // the largest first
  std::size_t thin_voxels = 0;       // hold surface, but less than 1/64 of inside
};

Quality measure_quality(const Organ& organ, const Mesh& input_m, const Progress& progress);

// With `report`: volumes and pieces of each input, what was repaired and lost, and `findings`:
// sentences on what a user should look at.
nlohmann::ordered_json quality_facts(const Quality& quality, const BuildReport& report);

}  // namespace stylet::bake
