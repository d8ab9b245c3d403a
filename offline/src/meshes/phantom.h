// SPDX-License-Identifier: GPL-3.0-or-later
// Test bodies and the organ of the demo, computed instead of read from a file.
//
// Promises: deterministic; closed, oriented outward. Units: metres.
#pragma once

#include "base/geometry.h"

namespace stylet::offline {

// A box that begins at x = 0 and is centred in y and z; its faces are squares of about `facet_m`.
Mesh block_phantom(Vec size_m, double facet_m);

// A ball centred on the origin, by CGAL's surface mesher from the implicit sphere.
Mesh ball_phantom(double diameter_m, double facet_m);

// A body like a liver: a thick right lobe (low y) tapers into a left lobe (high y); a hollow for
// the gallbladder lies below. 180 mm along y. A needle that moves along +x meets the front.
constexpr double kLiverPhantomLengthM = 0.18;
Mesh liver_phantom(double facet_m);

}  // namespace stylet::offline
