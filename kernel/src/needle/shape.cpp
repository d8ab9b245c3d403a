// SPDX-License-Identifier: Apache-2.0
#include "needle/shape.h"

namespace stylet {
namespace {

// Length over which a cut approaches the needle's direction: a bevel and the shaft's first bend.
constexpr float kBevelAlignM = 0.02F;

// The rod at `arc_from_tip_m`: its end towards the tip, the way back from there, and how far along.
// Counted from the tip, because there a place must be exact to the motion of a tick.
struct RodPlace {
  Vec3 end, back;
  float along;
};
RodPlace rod_place(const Needle& needle, float arc_from_tip_m) {
  const float at = arc_from_tip_m / needle.rod_m;
  // Also for a NaN, which a broken state may contain.
  const float within = max_of(0, min_of(at, static_cast<float>(needle.rods) - 0.5F));
  const auto rod = static_cast<std::uint32_t>(within);
  const Vec3* end = needle.node + (needle.rods - rod);
  return {end[0], end[-1] - end[0], at - static_cast<float>(rod)};
}

}  // namespace

Vec3 unit_vector(Vec3 v) {
  const float length = norm(v);
  return length > 1e-12F ? (1 / length) * v : Vec3{0, 0, -1};
}

NeedlePoint needle_point(const Needle& needle, float arc_from_tip_m) {
  const RodPlace rod = rod_place(needle, arc_from_tip_m);
  return {rod.end + rod.along * rod.back, unit_vector(-1.0F * rod.back)};
}

Vec3 needle_place(const Needle& needle, float arc_from_tip_m) {
  const RodPlace rod = rod_place(needle, arc_from_tip_m);
  return rod.end + rod.along * rod.back;
}

Vec3 turn_cut(Vec3 cut, const Needle& needle, float bevel_per_m, float advance_m) {
  const float size = advance_m < 0 ? -advance_m : advance_m;
  const Vec3 side = unit_vector(needle.side - dot(needle.side, cut) * cut);
  const float part = size / (size + kBevelAlignM);
  const Vec3 turned = cut + max_of(advance_m, 0) * bevel_per_m * side;
  return unit_vector(turned + part * (needle.tip_direction - cut));
}

}  // namespace stylet
