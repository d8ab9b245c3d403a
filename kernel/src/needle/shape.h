// SPDX-License-Identifier: Apache-2.0
// The needle of one tick as a chain of straight rods: its places and directions.
//
// A rigid needle is one rod from the handle; an elastic one is the chain of rod.h. Nodes run from
// the handle to the tip; arc lengths count from the tip, as constraint particles do.
//
// Promises: a fixed number of operations, no allocation. Units SI, frame of the attachments.
// Source: Webster et al. 2006 for the bevel. PHYSICS 6.1, 6.5.
#pragma once

#include <cstdint>

#include "base/math.h"

namespace stylet {

struct Needle {
  Vec3 base_m, tip_m;
  Vec3 tip_direction;
  Vec3 side;         // where bevel and bend face at the tip: unit, across tip_direction
  const Vec3* node;  // rods + 1 places, handle first
  std::uint32_t rods;
  float rod_m;
  float off_m;  // from a tip in contact to the tissue it holds, before that yields in this tick
};

struct NeedlePoint {
  Vec3 place_m, direction;
};

// Of unit length; straight down for a vector without length.
Vec3 unit_vector(Vec3 v);

// Beyond the ends the needle is straight.
NeedlePoint needle_point(const Needle& needle, float arc_from_tip_m);
// Only its place.
Vec3 needle_place(const Needle& needle, float arc_from_tip_m);

// Where a bevelled tip cuts after `advance_m` more: the path bends towards `side` by `bevel_per_m`,
// and over kBevelAlignM the direction of the cut approaches the needle's. In stiff tissue the
// needle follows its cut and the path is the arc of the bevel; in soft tissue the shaft lags behind
// and the arc is wider.
Vec3 turn_cut(Vec3 cut, const Needle& needle, float bevel_per_m, float advance_m);

}  // namespace stylet
