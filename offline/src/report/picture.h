// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of an organ for people: sections (SVG), and views of surfaces from the front (PNG), with
// obstacles, targets, a scale, and the names of the sides.
// Deterministic. Units: metres in, millimetres in the SVG. Frame: x to the right, z up; in sections
// across z, y points down, as radiologists are used to.
#pragma once

#include <string>

#include "asset/organ_shape.h"

namespace stylet::offline {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};
std::string css(Colour colour);

// Colours that people with red-green blindness can distinguish: Okabe and Ito 2008 without black,
// then six of Tol's (muted, 2021). Obstacles are grey.
Colour material_colour(std::size_t index);

struct Obstacle {
  std::string name;
  Mesh mesh_m;
};
struct Aim {  // a target, as a ball
  std::string name;
  Vec middle_m;
  double radius_m = 0;
};
struct Shown {
  const Organ& organ;
  std::vector<Cell> cells;
  std::vector<Colour> colours;  // of materials
  const Mesh& input_m;
  const Mesh& surface_m;
  std::vector<Obstacle> obstacles;
  std::vector<Aim> aims;
  bool of_patient = false;  // frame: x to the left, y to the back, z to the head
};

// One layer of voxels, paler where they are less filled. Over it, outlines of two surfaces in its
// middle: the input's black, the organ's white; obstacles are hatched, targets are rings.
struct Section {
  std::size_t axis = 2;
  std::uint32_t layer = 0;
};
// The layer across `axis` with the most tissues; among equals, the one with the most voxels.
Section best_section(const Organ& organ, const std::vector<Cell>& cells, std::size_t axis);
std::string section_svg(const Shown& shown, const Section& section);
// Position of the section's middle along its axis.
double section_at_m(const Organ& organ, const Section& section);

// The bytes of a PNG that shows `mesh` and the obstacles.
std::string view_png(const Shown& shown, const VoxelMesh& mesh);

}  // namespace stylet::offline
