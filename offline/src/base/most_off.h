// SPDX-License-Identifier: GPL-3.0-or-later
// When a volume or a thickness is so far off what was given that the user is told, the same for
// tissues, layers, walls and obstacles.
#pragma once

namespace stylet::bake {

// What is off by more than this part of it is told. Users are promised 5 %; the rest is for what is
// given, which samples know to 2 % where inputs overlap or a layer ends at a body's sides
// (measured: 1.9 % at most for 1000 layers that end after 8 to 50 voxels).
constexpr double kMostOff = 0.03;

}  // namespace stylet::bake
