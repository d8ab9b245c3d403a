// SPDX-License-Identifier: GPL-3.0-or-later
// Layers: which of them each cell lies in, and the numbers of their tissues. Units: metres; time
// and memory linear in the cells.
#pragma once

#include <vector>

#include "voxels/lattice.h"

namespace stylet::offline {

// Layers lie one below the other along an axis of space and override the inputs' tissues. A voxel
// gets the layer at its middle. Its depth is the filled length above it in its row, from where the
// row enters the inputs that layers replace; the last layer has no end.
struct Layer {
  double thickness_m = 0;
  std::string tissue;
};
struct LayerCourse {
  std::size_t axis = 0;
  bool backwards = false;  // depth is counted from the high end of the axis
  std::string of;          // tissue that the layers replace; empty: all tissues
};

// The material numbers, in the organ file, of the tissues of owners and layers.
struct TissueNumbers {
  struct Numbered {
    double thickness_m;
    std::uint8_t material;
  };
  std::vector<std::uint8_t> of_owner;    // 0 if layers replace it
  std::vector<std::uint8_t> is_layered;  // of each owner
  std::vector<Numbered> layers;
  LayerCourse course;
};

constexpr std::uint8_t kNotLayered = 255;

// The layer at a depth.
std::uint8_t layer_at(const TissueNumbers& numbers, double depth_m);

// How much of a layer's thickness is left across the surface that rows enter, on average over the
// rows: a row that meets the surface under an angle goes through 1 / cosine of the thickness there.
// `mesh_m` holds that surface; its other triangles do not count. 1 if no row enters.
double thickness_across(const Claims& claims, const TissueNumbers& numbers, const Mesh& mesh_m);

// The layer of each cell; empty if there are no layers at all.
std::vector<std::uint8_t> cell_layers(const Claims& claims, const TissueNumbers& numbers);

// The layer of a voxel; kNotLayered if layers do not replace its owner. If the cell belongs to
// another owner (voxels/sheets.h), the row begins here: the first layer.
std::uint8_t voxel_layer(const TissueNumbers& numbers, const std::vector<std::uint8_t>& cell_layers,
                         std::size_t cell, std::uint16_t owner);

}  // namespace stylet::offline
