// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/polygon.h"

namespace stylet::offline {
namespace {

// The part where `sign` times the coordinate is at most `bound`.
Polygon cut(const Polygon& polygon, std::size_t axis, double sign, double bound) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double over_a = sign * a[axis] - bound, over_b = sign * b[axis] - bound;
    if (over_a <= 0) part.push_back(a);
    if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0)) {
      part.push_back(a + (b - a) * (over_a / (over_a - over_b)));
    }
  }
  return part;
}

}  // namespace

Polygon between(const Polygon& polygon, std::size_t axis, double low, double high) {
  return cut(cut(polygon, axis, 1, high), axis, -1, -low);
}

Vec area_vector(const Polygon& polygon) {
  Vec sum;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum = sum + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return sum * 0.5;
}

double area_of(const Polygon& polygon) {
  return length(area_vector(polygon));
}

}  // namespace stylet::offline
