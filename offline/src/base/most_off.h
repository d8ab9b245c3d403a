// SPDX-License-Identifier: GPL-3.0-or-later
// How far a volume or a thickness may be from the given one before the user is told; the same for
// tissues, layers, walls and obstacles.
#pragma once

namespace stylet::offline {

// The user is told of a relative deviation beyond this. Users are promised 5 %; the other 2 % are
// the error of the given value, found by samples where inputs overlap or a layer ends at a body's
// sides (measured: 1.9 % at most for 1000 layers that end after 8 to 50 voxels).
constexpr double kMostOff = 0.03;

}  // namespace stylet::offline
