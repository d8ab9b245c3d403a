// SPDX-License-Identifier: GPL-3.0-or-later
// What an organ holds of what it was given, and the sentence for the user where it is not enough:
// for tissues and layers, in the terminal and in the report.
//
// Given: the volume of a mesh or of labels, where they overlap by samples; of a layer in closed
// form, along the rows in which its depth is counted. Held: exactly what the file says, by its
// planes (what a needle meets) and by its voxels (what gives way as this tissue). Units: metres.
#pragma once

#include <string>
#include <vector>

#include "voxels/cell_walk.h"

namespace stylet::bake {

// Volume of each material of `numbers` in the cells that are not cut away (empty: all). A sample of
// an owner stands for `sample_m3` of it.
std::vector<double> given_volumes(const Claims& claims, const SamplePlaces& places,
                                  const TissueNumbers& numbers,
                                  const std::vector<std::uint8_t>& cut,
                                  const std::vector<double>& sample_m3);

struct Held {
  double met_m3 = 0;    // where a needle meets it
  double voxel_m3 = 0;  // of the voxels that give way as it does
};

// Of each material. `material_of_voxel` as given: a capsule is of what it is around.
std::vector<Held> held_volumes(const Lattice& lattice, const std::vector<OrganMixed>& mixed,
                               const std::vector<std::uint8_t>& material_of_voxel);

// The part of the unit cube where normal . place <= limit. Source: Scardovelli and Zaleski 2000.
double volume_before(Vec normal, double limit);

// Empty where nothing is off.
std::string loss(const std::string& what, double given_m3, const Held& held, double edge_m);

}  // namespace stylet::bake
