// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of an organ for people: sections (SVG), and views of surfaces from the front (PNG), with
// what lies beside it: obstacles, targets, a scale, and which side is which.
// Deterministic. Units: metres in, millimetres in the SVG. Frame: x to the right, z up; sections
// across z have y downward, as a radiologist reads them.
#pragma once

#include <string>

#include "asset/organ_shape.h"

namespace stylet::bake {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};
std::string css(Colour colour);

// Told apart by people who see red and green alike: those of Okabe and Ito 2008 but for black,
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
  bool of_patient = false;  // x to the left, y to the back, z to the head
};

// One layer of voxels, paler the emptier, under the outlines of two surfaces in its middle: the
// input's in black, the organ's own in white; obstacles hatched, targets as rings.
struct Section {
  std::size_t axis = 2;
  std::uint32_t layer = 0;
};
// The layer across `axis` that shows most tissues, and most of them.
Section best_section(const Organ& organ, const std::vector<Cell>& cells, std::size_t axis);
std::string section_svg(const Shown& shown, const Section& section);
// Where its middle lies.
double section_at_m(const Organ& organ, const Section& section);

// Bytes of a PNG, with the obstacles.
std::string view_png(const Shown& shown, const VoxelMesh& mesh);

}  // namespace stylet::bake
