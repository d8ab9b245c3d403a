// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/surface_bits.h"

namespace stylet::offline {
namespace {

// Surface in a box that is smaller than this part of the box's face goes to a neighbour.
constexpr double kLeastBit = 0.25;

}  // namespace

void SurfaceBit::add(const SurfaceBit& other) {
  area += other.area;
  middle = middle + other.middle;
  normal = normal + other.normal;
}

Vec middle_of(const Polygon& polygon) {
  Vec sum;
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const double part = area_of({polygon[0], polygon[i - 1], polygon[i]});
    sum = sum + (polygon[0] + polygon[i - 1] + polygon[i]) * (part / 3);
    area += part;
  }
  return area > 0 ? sum * (1 / area) : polygon.front();
}

void join_small(SurfaceBits& bits) {
  for (auto at = bits.begin(); at != bits.end();) {
    SurfaceBit* best = nullptr;
    for (int n = 0; n < 27 && at->second.area < kLeastBit; ++n) {
      const SurfaceCell& c = at->first;
      const auto there = bits.find({c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1});
      if (there == bits.end() || there->second.area < kLeastBit) continue;
      if (dot(there->second.normal, at->second.normal) <= 0) continue;
      if (best == nullptr || there->second.area > best->area) best = &there->second;
    }
    if (best != nullptr) best->add(at->second);
    at = best != nullptr ? bits.erase(at) : std::next(at);
  }
}

}  // namespace stylet::offline
