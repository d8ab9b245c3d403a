// SPDX-License-Identifier: Apache-2.0
// Distance between a convex hull and a segment, and the way out where they overlap.
//
// Promises: no allocation; at most kMaxGjkSteps walks over the vertices, kMaxEscapeSupports more
// for the way out; finite results for any finite input, however flat or small the hull.
// Units: metres, double precision inside: a normal is a quotient of small differences. Frame: the
// hull's. Sources: Gilbert, Johnson, Keerthi 1988 (distance); Snethen 2008 (libccd's portal
// refinement).
//
// Why libccd does not measure contacts: portal refinement answers only where shapes overlap, with
// the face that the ray from centre to centre meets. A tip that slides over a box is reported up to
// 26 % too deep near the edge, with a normal that jumps by 0.67 rad (tests/fidelity/obstacle).
// Contacts of a round needle are measured between the cores, which stay apart in all but the
// hardest; the library gives the first direction when a needle appears inside. PHYSICS 13.2.
#pragma once

#include <cstdint>
#include <span>

#include "base/vec3d.h"
#include "stylet/limits.h"
#include "stylet/units.h"

namespace stylet {

struct ConvexHull {
  std::span<const Vec3> vertices_m;  // at least one; points inside do no harm
  Vec3d centre_m;                    // any point inside
};

struct Segment {
  Vec3d a_m, b_m;  // may be equal
};
constexpr Vec3d point_on(const Segment& segment, double place) {
  return (1 - place) * segment.a_m + place * segment.b_m;
}

// How far the hull reaches along a direction: largest dot product with a vertex.
double reach(const ConvexHull& hull, Vec3d direction);

struct Closest {
  double distance_m;  // 0 where the two overlap
  Vec3d normal;       // unit, from the hull to the segment; zero where they overlap
  double place;       // of the segment's closest point, 0 at a to 1 at b
};
Closest closest(const ConvexHull& hull, const Segment& segment);

// A unit direction in which a segment that overlaps the hull can leave it, not the shortest one.
// After `budget` looks at the vertices: square to the segment.
Vec3d way_out(const ConvexHull& hull, const Segment& segment,
              std::uint32_t budget = kMaxEscapeSupports);

}  // namespace stylet
