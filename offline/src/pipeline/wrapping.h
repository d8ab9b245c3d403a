// SPDX-License-Identifier: GPL-3.0-or-later
// A closed skin around an input that is known to hold what the input holds.
//
// CGAL's alpha wrap goes in through an opening wider than about twice its step, and leaves a hollow
// shell. So it is compared with what the input itself says is inside, at points spread through its
// box: by the winding number, and by rays where faces do not tell their sides. If points are
// missing, holes are patched; if that does not help, because triangles do not hang together, the
// step grows until it does. The skin's offset swells the volume: where by more than 3 %, a tenth of
// the offset is taken; if that skin goes in, it is sealed in the same way. What was done, and what
// volume remains wrong, is told.
//
// Promises: deterministic; a surface that encloses something never becomes a hollow shell. A sheet
// that encloses nothing becomes a thin slab. Units: metres.
#pragma once

#include <string>

#include "meshes/repair.h"

namespace stylet::offline {

// What an input says is inside.
struct Content {
  std::vector<Vec> points;  // that it has around them in more than half of all directions
  std::vector<Vec> sure;    // those of them with more than three quarters: not just below a hole
  double volume_m3 = 0;
  bool encloses = false;  // else it is a sheet: what is inside is only beside it
};

Content content_of(const Solid& solid);

struct Wrapped {
  Solid solid;  // with the counts of what was wrapped
  std::vector<std::string> warnings;
};

// `step_m`: the skin bridges gaps of about twice that, and its facets are about so large. `name` is
// the input's, for messages.
Wrapped wrap(const Solid& solid, const Content& content, double step_m, const std::string& name);

}  // namespace stylet::offline
