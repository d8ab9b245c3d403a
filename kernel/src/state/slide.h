// SPDX-License-Identifier: Apache-2.0
// Where parts of the organ lie on each other and may slide: what the model knows of them, what a
// tick leaves to the next one, and what it keeps within itself (coupling/slides.h).
//
// Promises: plain structs, the same bytes on every machine. The arrays are in layout.h. Units SI.
#pragma once

#include <cstdint>

#include "stylet/units.h"

namespace stylet {

// A voxel of the part that is the ground. Sorted by level, z, body, y, x and slot.
constexpr std::uint32_t kNoGround = 0xFFFFFFFFU;
struct SlideGround {
  std::uint32_t slot;       // of the voxel
  std::uint32_t node[8];    // particles at its corners
  float outside_m[8];       // how far its corners at rest lie outside the ground's surface
  Vec3 low_m;               // low corner at rest
  std::int32_t x, y, z;     // its cell of space, at its level
  std::uint16_t level;      // of the voxel, whose edge all its places are in
  std::uint16_t body;       // to which it belongs: a point goes on to grounds of the same one
  std::uint32_t beside[6];  // that of the same level below and above along x, y, z, or kNoGround
};
// A point of the other part's surface.
struct SlidePoint {
  Vec3 rest_m;                        // where it is at rest
  std::uint32_t node[8];              // particles at the corners of its own voxel
  float weight[8];                    // theirs
  float stiffness_n_per_m, friction;  // of its contact; Coulomb's coefficient
  float rest_outside_m;               // at most 0: parts may overlap at rest
  std::uint32_t ground;               // in which it is at rest
  Vec3 place;                         // in that ground at rest: edges from the low corner
};
struct SlideState {
  Vec3 place;               // in its ground at rest
  Vec3 stretch_m;           // of friction's spring, along the surface
  float stiffness_n_per_m;  // of its contact; 0: it touches nothing
  std::uint32_t ground;     // in which it is, or was last
};
struct SlideBooks {
  double friction_j;  // dissipated since reset
};
// A point's contact in a substep.
struct SlideContact {
  float depth_m;    // 0: it touches nothing
  Vec3 slope;       // of the depth, by the point's place now; outwards
  float weight[8];  // of its ground's particles
  Vec3 slip_m;      // along the surface, since the last substep
};

}  // namespace stylet
