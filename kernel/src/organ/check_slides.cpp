// SPDX-License-Identifier: Apache-2.0
#include "organ/check_slides.h"

#include "stylet/limits.h"

namespace stylet {
namespace {

bool check_grounds(Checker& check, const Organ& organ) {
  for (std::size_t i = 0; i < organ.slide_grounds.size(); ++i) {
    const OrganSlideGround& g = organ.slide_grounds[i];
    if (!check.require(g.voxel < organ.voxel_count, Status::kOrganIndexOutOfRange,
                       "slides.grounds.voxel", i, g.voxel, "a voxel of the lattice") ||
        !check.require(i == 0 || g.voxel > organ.slide_grounds[i - 1].voxel,
                       Status::kOrganOrderWrong, "slides.grounds.voxel", i, g.voxel,
                       "voxels in rising order, each once")) {
      return false;
    }
    for (const float distance : g.distance) {
      if (!check.in_range(distance, -kMaxSlideDistance, kMaxSlideDistance,
                          "slides.grounds.distance", i, "-100 to 100")) {
        return false;
      }
    }
  }
  return true;
}

// A point that pressed on its own voxel would push it from two sides.
bool check_points(Checker& check, const Organ& organ) {
  for (std::size_t i = 0; i < organ.slide_points.size(); ++i) {
    const OrganSlidePoint& p = organ.slide_points[i];
    if (!check.require(p.voxel < organ.voxel_count, Status::kOrganIndexOutOfRange,
                       "slides.points.voxel", i, p.voxel, "a voxel of the lattice") ||
        !check.require(p.reserved == 0, Status::kOrganValueOutOfRange, "slides.points.reserved", i,
                       p.reserved, "0") ||
        !check.require(p.area > 0 && p.area <= kMaxSlideArea, Status::kOrganValueOutOfRange,
                       "slides.points.area", i, static_cast<double>(p.area),
                       "above 0, at most 4") ||
        !check.require(p.ground < organ.slide_grounds.size(), Status::kOrganIndexOutOfRange,
                       "slides.points.ground", i, p.ground, "an index into grounds") ||
        !check.require(p.voxel != organ.slide_grounds[p.ground].voxel,
                       Status::kOrganIndexOutOfRange, "slides.points.ground", i, p.ground,
                       "the ground of another voxel than the point's") ||
        !check.in_range(p.friction, 0, kMaxSlideFriction, "slides.points.friction", i, "0 to 2")) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool check_slides(Checker& check, const Organ& organ) {
  return check.require(organ.format_version >= 4, Status::kOrganVersionUnknown, "slides", 0,
                       organ.format_version, "format version 4 where parts slide") &&
         check.require(organ.levels == 1 || organ.format_version >= 6, Status::kOrganVersionUnknown,
                       "slides", 0, organ.format_version,
                       "format version 6 where parts slide and there are levels") &&
         check.require(organ.slide_points.size() <= kMaxSlidePoints, Status::kOrganValueOutOfRange,
                       "slides.points", 0, static_cast<double>(organ.slide_points.size()),
                       "at most 65536 points") &&
         check.require(
             organ.slide_bodies.size() == (organ.levels == 1 ? 0 : organ.slide_grounds.size()),
             Status::kOrganSizesDisagree, "slides.bodies", 0,
             static_cast<double>(organ.slide_bodies.size()),
             "one for each ground where there are levels, else none") &&
         check_grounds(check, organ) && check_points(check, organ);
}

}  // namespace stylet
