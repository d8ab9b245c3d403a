// SPDX-License-Identifier: Apache-2.0
// The needle of one tick: where it is, which way it points, what bends it.
//
// A rigid needle is a line from the handle. An elastic one is the chain of rod.h, bent by the
// forces of its constraint particles and contacts. Needle and tissue answer each other in turn,
// which is stable because each lowers the energy they share; the needle answers twice, before and
// after the tissue, so that the hand feels what its joints store. (With one answer it bends against
// tissue that stands still, so too far, and the difference came out at the hand: up to 10 % of its
// work.) With its tip in contact it answers once more (meet_tissue). Obstacles are part of all
// answers (rod.h). The shape is given as nodes from the handle to the tip; arc lengths count from
// the tip, as constraint particles do.
//
// Everything here is in the frame of the attachments (see BreathingConfig): the world, shifted.
//
// Promises: no allocation; operations bounded by limits.h. Units SI. Source: model section 5;
// Webster et al. 2006 for the bevel.
#pragma once

#include "base/math.h"
#include "state/layout.h"

namespace stylet {

struct Needle {
  Vec3 base_m, tip_m;
  Vec3 tip_direction;
  Vec3 side;         // where bevel and bend face at the tip: unit, across tip_direction
  const Vec3* node;  // rods + 1 places, handle first
  std::uint32_t rods;
  float rod_m;
  float off_m;  // of a tip in contact from the tissue it holds, before that gives way in this tick
};

struct NeedlePoint {
  Vec3 place_m, direction;
};

// The needle in the state's nodes, as the last tick left it; without directions.
Needle needle_of(const View& view);

// Beyond the ends: straight on.
NeedlePoint needle_point(const Needle& needle, float arc_from_tip_m);
// Its place alone.
Vec3 needle_place(const Needle& needle, float arc_from_tip_m);

// Shift of the attachments at the state's tick.
Vec3 attachment_shift(const View& view);

// Rods and their rest shape; obstacles are given by set_obstacles.
void make_needle(const View& view);

// Shape of this view's needle at its handle's pose, and its contacts with obstacles, unless it is
// in the tissue: then they are what settle_needle finds. Returns output flags.
std::uint32_t place_needle(const View& view, Needle& needle_out);

// A needle whose tip is in contact bends once more before the tissue's step, by the force that the
// tip would press with: its place was found by what the tissue was at the depth before, or by none.
// Returns output flags.
std::uint32_t meet_tissue(const View& view, Needle& needle);

// After the tissue's step: bends by the forces that came, and takes the particles along. Returns
// output flags.
std::uint32_t settle_needle(const View& view, Needle& needle);

// Where a bevelled tip cuts after `advance_m` more: the path bends towards `side` by `bevel_per_m`,
// and the direction of the cut falls in with the needle's own over kBevelAlignM. In stiff tissue
// the needle follows its cut and the path is the arc of the bevel; in soft tissue the shaft lags
// behind and the arc is wider.
Vec3 turn_cut(Vec3 cut, const Needle& needle, float bevel_per_m, float advance_m);

}  // namespace stylet
