// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the lists by which an organ file describes parts that slide on each other: points of one
// part's surface, and for the voxels of the other part, its ground, the distances of their corners
// from the ground's surface.
//
// With voxels of several sizes, points are as dense as the finest of them near the surface. Voxels
// are numbered through all levels, as in the file.
//
// Promises: the points' areas add up to that of the surface they are on; distances are those of the
// surface itself, not of voxels; a point is in a voxel of its own part. Deterministic.
// Units: metres; squares of the voxel's edge for areas.
#pragma once

#include <span>

#include "voxels/lattice.h"

namespace stylet::offline {

struct SlidingPart {
  Mesh surface_m;                // closed; outwards
  std::uint32_t side = 0;        // in Lattice::sides, as a bit
  std::uint32_t apart_from = 0;  // sides whose voxels it has no share in
};
struct SlidingPair {
  std::size_t part = 0, ground = 0;  // numbers of parts
  double friction = 0;
};

// Of a pair: the part's surface that faces the ground and is near enough, and what of it has points
// in the organ, in squares of the edge of level 0. The rest is in no voxel of the part alone, or
// has no voxel of the ground near it.
struct SlideArea {
  double facing = 0, without_voxel = 0, without_ground = 0;
};

struct SlideLists {
  std::vector<OrganSlidePoint> points;
  std::vector<OrganSlideGround> grounds;  // sorted by voxel
  std::vector<std::uint8_t> bodies;       // of each ground, if there are several levels
  std::vector<SlideArea> areas;           // of each pair
};

// A part's surface counts where the ground is so near and faces it: gaps up to here may close.
constexpr double kSlideReachM = 0.01;

// Surface in cells that are `cut` away (voxels/crop.h) is left out of the areas.
SlideLists list_slides(const std::vector<SlidingPart>& parts, const std::vector<SlidingPair>& pairs,
                       std::span<const Lattice> levels, const std::vector<std::uint8_t>& cut);

}  // namespace stylet::offline
