// SPDX-License-Identifier: GPL-3.0-or-later
// How good an organ is: what it kept and lost of the input, and how far its surfaces lie off.
//
// Two surfaces are compared with the input's: the embedded one, which the needle meets and the eye
// sees, in both directions; and the outside of the voxels, which deform, in one. Units: metres.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "asset/organ_shape.h"
#include "meshes/distance.h"
#include "pipeline/build.h"

namespace stylet::offline {

// Voxels connected through shared corners. A piece without a held corner floats, unless it is
// borne: it slides on a held piece, or that on it. One without a free corner does not move.
struct LatticePiece {
  std::size_t voxels = 0;
  double volume_m3 = 0;
  bool held = false, moves = false, borne = false;
};

std::vector<LatticePiece> lattice_pieces(const Organ& organ);  // the largest first
// Sentences on pieces that float among others, or do not move.
std::vector<std::string> held_findings(const std::vector<LatticePiece>& pieces);

struct Quality {
  // Not measured (no samples) if a surface is missing.
  Deviation surface_to_input, input_to_surface, faces_to_input;
  std::vector<LatticePiece> pieces;  // the largest first
  std::size_t thin_voxels = 0;       // contain surface, but less than 1/64 is inside
};

Quality measure_quality(const Organ& organ, const Mesh& input_m, const Progress& progress);

// Also, from `report`: volumes and pieces of each input, what was repaired and lost; and
// `findings`, sentences on what a user should look at.
nlohmann::ordered_json quality_facts(const Quality& quality, const BuildReport& report);

}  // namespace stylet::offline
