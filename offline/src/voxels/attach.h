// SPDX-License-Identifier: GPL-3.0-or-later
// Which corners of the lattice are attached to space; and regions of space in general.
//
// A region is written in millimetres of the organ's frame, or in per cent of the organ's extent:
//   x>120   z<10%   box:X0,Y0,Z0,X1,Y1,Z1   touching:MESH   none
// touching:MESH contains all corners of the voxels that the mesh's surface passes through; the mesh
// is in the units of the inputs. Several regions are joined.
#pragma once

#include <string>
#include <vector>

#include "meshes/read_mesh.h"
#include "voxels/voxelize.h"

namespace stylet::offline {

// Held behind and below: a needle pushed along +x presses the organ against what holds it, as an
// organ lies against the back of the body cavity.
inline const std::vector<std::string> kDefaultFix{"x>90%", "z<10%"};

struct Region {
  enum class Kind { kAbove, kBelow, kBox, kTouching } kind = Kind::kAbove;
  std::size_t axis = 0;  // of a half-space
  double bound = 0;      // metres, or a fraction of the extent
  bool is_fraction = false;
  Box box_m;
  Mesh mesh_m;                     // of kTouching
  std::vector<std::string> notes;  // warnings that came up when the mesh was read
};

// An empty result means a free body. `option` is the option that refusals name.
std::vector<Region> parse_regions(const std::vector<std::string>& texts, const MeshUnits& units,
                                  const std::string& option = "--fix");

// Whether a half-space or a box contains a point; its border is moved outward by `slack_m`.
bool holds(const Region& region, const Box& extent_m, Vec point_m, double slack_m);

// One byte per lattice corner, (size + 1) along each axis, x fastest; 1 means held. `extent_m` is
// the organ's bounding box.
std::vector<std::uint8_t> held_corners(const Grid& grid, const Box& extent_m,
                                       const std::vector<Region>& regions);

inline std::size_t corner_index(const Grid& grid, std::uint32_t x, std::uint32_t y,
                                std::uint32_t z) {
  return (std::size_t{z} * (grid.size[1] + 1) + y) * (grid.size[0] + 1) + x;
}

}  // namespace stylet::offline
