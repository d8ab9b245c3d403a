// SPDX-License-Identifier: GPL-3.0-or-later
// How much an organ has of each tissue and layer compared with what was given, and the sentence for
// the user if it is too little or too much, on the terminal and in the report.
//
// Given: the volume of a mesh or of labels, by samples if they overlap; of a layer in closed form,
// along the rows in which its depth is counted. Held: exactly what the file has, by its planes
// (what a needle meets) and by its voxels (what deforms as this tissue). Units: metres.
#pragma once

#include <string>
#include <vector>

#include "voxels/cell_walk.h"

namespace stylet::offline {

// Volume of each material of `numbers` in the cells that are not cut away (`cut` empty: none is). A
// sample of an owner represents a volume of `sample_m3`.
std::vector<double> given_volumes(const Claims& claims, const SamplePlaces& places,
                                  const TissueNumbers& numbers,
                                  const std::vector<std::uint8_t>& cut,
                                  const std::vector<double>& sample_m3);

struct Held {
  double met_m3 = 0;    // volume in which a needle meets the material
  double voxel_m3 = 0;  // volume of the voxels that deform as it does
};

// For each material. `material_of_voxel` is as given: a capsule counts as the tissue it covers.
std::vector<Held> held_volumes(const Lattice& lattice, const std::vector<OrganMixed>& mixed,
                               const std::vector<std::uint8_t>& material_of_voxel);

// The part of the unit cube where normal . place <= limit. Source: Scardovelli and Zaleski 2000.
double volume_before(Vec normal, double limit);

// The sentence for the user; empty if the deviation is small. `finest_m`: if voxels have several
// edges, the smallest.
std::string loss(const std::string& what, double given_m3, const Held& held, double edge_m,
                 double finest_m = 0);

}  // namespace stylet::offline
