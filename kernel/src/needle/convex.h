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
// the face that the ray from centre to centre hits. For a tip that slides over a box it gives up to
// 26 % too much depth near the edge, and a normal that jumps by 0.67 rad (tests/fidelity/obstacle).
// Contacts of a round needle are measured between the cores, which stay apart in all but the
// hardest contacts; the library gives the first direction if a needle appears inside. PHYSICS 13.2.
#pragma once

#include <cstdint>
#include <span>

#include "base/vec3d.h"
#include "stylet/limits.h"
#include "stylet/units.h"

namespace stylet {

struct ConvexHull {
  std::span<const Vec3> vertices_m;  // at least one; points inside the hull do no harm
  Vec3d centre_m;                    // any point inside
};

struct Segment {
  Vec3d a_m, b_m;  // may be equal
};
constexpr Vec3d point_on(const Segment& segment, double place) {
  return (1 - place) * segment.a_m + place * segment.b_m;
}

// How far the hull extends in a direction: largest dot product with a vertex.
double reach(const ConvexHull& hull, Vec3d direction);

struct Closest {
  double distance_m;  // 0 where the two overlap
  Vec3d normal;       // unit, from the hull to the segment; zero where they overlap
  double place;       // parameter of the segment's closest point: 0 at a, 1 at b
};
Closest closest(const ConvexHull& hull, const Segment& segment);

// A unit direction in which a segment that overlaps the hull can leave it; not the shortest way.
// After `budget` walks over the vertices: square to the segment.
Vec3d way_out(const ConvexHull& hull, const Segment& segment,
              std::uint32_t budget = kMaxEscapeSupports);

}  // namespace stylet
