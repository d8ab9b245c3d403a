// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/cell_walk.h"

#include <algorithm>
#include <bit>

namespace stylet::offline {
namespace {

double side(const Plane& plane, Vec place) {
  return dot(plane.normal, place);
}

// Sets the limit so that each side has as many samples as `beyond` says. Leaves it if one side has
// none.
void set_limit(const SamplePlaces& places, std::uint64_t beyond, Plane& plane) {
  const auto first = static_cast<std::size_t>(std::popcount(~beyond));
  if (first == 0 || first == kCellSamples) return;
  std::array<double, kCellSamples> along{};
  for (std::uint32_t s = 0; s < kCellSamples; ++s) along[s] = side(plane, places[s]);
  std::sort(along.begin(), along.end());
  plane.limit = 0.5 * (along[first - 1] + along[first]);
}

// Length of the way from `from` to `to` that is not beyond the plane.
double length_before(const Plane& plane, Vec from, Vec to) {
  const double a = side(plane, from) - plane.limit, b = side(plane, to) - plane.limit;
  const double whole = length(to - from);
  if (a <= 0 && b <= 0) return whole;
  if (a > 0 && b > 0) return 0;
  return whole * (a <= 0 ? a / (a - b) : b / (b - a));
}

Vec with(Vec place, std::size_t axis, double value) {
  return {axis == 0 ? value : place.x, axis == 1 ? value : place.y, axis == 2 ? value : place.z};
}

}  // namespace

Plane fit_plane(const SamplePlaces& places, std::uint64_t beyond) {
  const int count = std::popcount(beyond);
  if (count == 0) return {{0, 0, 0}, 1};
  if (count == kCellSamples) return {{0, 0, 0}, -1};
  Vec there{}, here{};
  for (std::uint32_t s = 0; s < kCellSamples; ++s) {
    Vec& sum = (beyond >> s & 1U) != 0 ? there : here;
    sum = sum + places[s];
  }
  const Vec way = there * (1.0 / count) - here * (1.0 / (static_cast<int>(kCellSamples) - count));
  constexpr double kTooNear = 1e-3;  // nearer, one surrounds the other: any direction will do
  const double distance = length(way);
  Plane plane = {distance > kTooNear ? way * (1 / distance) : Vec{0, 0, 1}, 0};
  set_limit(places, beyond, plane);
  return plane;
}

CellWalk::CellWalk(const Claims& claims, const SamplePlaces& places, const TissueNumbers& numbers,
                   Sides sides)
    : claims_(claims), places_(places), numbers_(numbers), sides_(sides), owners_(claims) {}

CellHere CellWalk::enter(std::size_t cell, Depths& depths) const {
  CellHere here;
  here.owner = owners_.in(cell);
  if (numbers_.layers.empty()) return here;
  std::uint64_t layered = 0;
  for (std::uint32_t s = 0; s < kCellSamples; ++s) {
    layered |= std::uint64_t{is_layered(numbers_, here.owner[s])} << s;
  }
  Plane plane = fit_plane(places_, ~layered);
  constexpr double kSteep = 0.25;  // how far a fitted plane may lean if the true side is upright
  if (sides_ == Sides::kUpright && std::abs(plane.normal[numbers_.course.axis]) < kSteep) {
    plane.normal = with(plane.normal, numbers_.course.axis, 0);
    set_limit(places_, ~layered, plane);
  }
  const double start = numbers_.course.backwards ? 1 : 0;
  for (std::uint32_t s = 0; s < kCellSamples; ++s) {
    const Vec in = with(places_[s], numbers_.course.axis, start);
    const Vec out = with(places_[s], numbers_.course.axis, 1 - start);
    here.from[s] = depths[s];
    here.at[s] = depths[s] + length_before(plane, in, places_[s]);
    here.to[s] = layered == 0 ? 0 : depths[s] + length_before(plane, in, out);
  }
  depths = here.to;
  return here;
}

}  // namespace stylet::offline
