// SPDX-License-Identifier: Apache-2.0
// The distance of a needle's piece from a body, as a tick finds it for a piece that has touched
// nothing yet. Units: SI. Frame: world.
#pragma once

#include "needle/obstacle.h"

namespace stylet::test {

struct Gap {
  float separation_m;  // negative: depth along `normal`
  Vec3 normal;         // unit, out of the body
  float place;         // parameter of the contact on the piece's axis: 0 at a, 1 at b
};

// Exact as long as the piece's axis is outside the body. If it is inside: a depth by which the
// piece can leave, which is not always the smallest.
inline Gap gap_of(const Obstacle& obstacle, const NeedlePiece& piece) {
  constexpr double kAnyM = 1e3;  // far beyond the size of a body or a needle
  const Segment axis = {to_double(piece.a_m), to_double(piece.b_m)};
  ObstacleFace face = {};
  (void)find_face(obstacle, axis, static_cast<double>(piece.radius_m), {}, {}, {{}, axis},
                  {kAnyM, 0}, face);
  return {static_cast<float>(-face.depth_m), to_float(face.normal), face.place};
}

}  // namespace stylet::test
