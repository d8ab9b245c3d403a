// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of an organ for people: sections (SVG), and views of surfaces from the front (PNG).
// Deterministic. Units: metres in, millimetres in the SVG. Frame: x to the right, z up; sections
// across z have y downward, as a radiologist reads them.
#pragma once

#include <string>

#include "organ_shape.h"

namespace stylet::bake {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};
std::string css(Colour colour);

// By the tissue's name where it has a usual colour; else one of a few by `index`.
Colour colour_of(const std::string& tissue, std::size_t index);

// One layer of voxels, paler the emptier, under the outlines of two surfaces in its middle: the
// input's in black, the organ's own in white.
struct Section {
  std::size_t axis = 2;
  std::uint32_t layer = 0;
};
// The layer across `axis` that shows most tissues, and most of them.
Section best_section(const Organ& organ, const std::vector<Cell>& cells, std::size_t axis);
std::string section_svg(const Organ& organ, const std::vector<Cell>& cells,
                        const std::vector<Colour>& colours, const Section& section,
                        const Mesh& input_m, const Mesh& surface_m);

// Bytes of a PNG; `colours` of materials.
std::string view_png(const Organ& organ, const VoxelMesh& shown,
                     const std::vector<Colour>& colours);

}  // namespace stylet::bake
