// SPDX-License-Identifier: GPL-3.0-or-later
// Test bodies and the organ of the demo, made here instead of read from a file.
//
// Promises: deterministic; closed, oriented outward. Units: metres.
#pragma once

#include "base/geometry.h"

namespace stylet::bake {

// A box with x from 0, y and z centred, its faces divided into squares of about `facet_m`.
Mesh block_phantom(Vec size_m, double facet_m);

// Centred on the origin; CGAL's surface mesher on the implicit sphere.
Mesh ball_phantom(double diameter_m, double facet_m);

// Shaped like a liver: a thick right lobe (low y) that tapers into a left one (high y), a hollow
// for the gallbladder below. 180 mm along y; a needle meets the front on its way along +x.
constexpr double kLiverPhantomLengthM = 0.18;
Mesh liver_phantom(double facet_m);

}  // namespace stylet::bake
