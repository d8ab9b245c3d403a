// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace stylet::offline {
namespace {

constexpr double kSameM = 1e-5;  // thinner than any drawn wall, coarser than any writer's rounding

// What does not depend on where a contour begins, on its direction, or on repeated points.
struct Outline {
  Vec low, high, middle;  // middle: of its line
  double area_m2 = 0, line_m = 0;
};

Outline outline_of(const Contour& contour) {
  Outline outline;
  Box box;
  Vec moment;
  const std::vector<Vec>& points = contour.points_m;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec next = points[(i + 1) % points.size()];
    const double way = length(next - points[i]);
    grow(box, points[i]);
    moment = moment + (points[i] + next) * (0.5 * way);
    outline.line_m += way;
  }
  outline.low = box.low;
  outline.high = box.high;
  constexpr double kLeastM = 1e-12;  // of points that are all one
  outline.middle = moment * (1 / std::max(outline.line_m, kLeastM));
  outline.area_m2 = length(area_of(contour)) / 2;
  return outline;
}

bool may_be_same(const Outline& a, const Outline& b) {
  const auto near = [](Vec u, Vec v) { return length(u - v) <= kSameM; };
  return near(a.low, b.low) && near(a.high, b.high) && near(a.middle, b.middle) &&
         std::fabs(a.area_m2 - b.area_m2) <= kSameM * std::max(a.line_m, b.line_m);
}

bool lies_on(Vec point, const Contour& contour) {
  for (std::size_t i = 0; i < contour.points_m.size(); ++i) {
    const Vec from = contour.points_m[i];
    const Vec way = contour.points_m[(i + 1) % contour.points_m.size()] - from;
    const double size2 = dot(way, way);
    const double part = size2 > 0 ? std::clamp(dot(point - from, way) / size2, 0.0, 1.0) : 0;
    if (length(point - (from + way * part)) <= kSameM) return true;
  }
  return false;
}

// Whether points of one contour lie on the other: all of them, or some at even distances if there
// are many, so that time is linear in the points. (Outline alone is the same for a mirror image.)
bool lie_on_another(const Contour& a, const Contour& b) {
  constexpr std::size_t kMostAsked = 64;
  const std::size_t count = a.points_m.size(), asked = std::min(count, kMostAsked);
  for (std::size_t i = 0; i < asked; ++i) {
    if (!lies_on(a.points_m[i * count / asked], b)) return false;
  }
  return true;
}

// Where each row crosses contours, for the even-odd rule. A crossing between the centres of two
// pixels belongs to the second one; one beyond all pixels belongs to one more column.
struct Crossings {
  std::uint32_t columns = 0;         // with that one
  std::vector<char> odd;             // row after row; all 0 between two planes
  std::vector<std::uint32_t> first;  // column with a crossing in each row; `columns`: none

  explicit Crossings(const PixelGrid& grid)
      : columns(grid.columns + 1),
        odd(std::size_t{columns} * grid.rows, 0),
        first(grid.rows, columns) {}

  void add(std::size_t row, double place) {
    const auto at = static_cast<std::uint32_t>(std::clamp(std::ceil(place), 0.0, columns - 1.0));
    odd[row * columns + at] ^= 1;
    first[row] = std::min(first[row], at);
  }
};

void cross_rows(const Raster& raster, std::array<double, 2> low, const Contour& contour,
                Crossings& crossings) {
  const PixelGrid& grid = raster.grid;
  const auto place = [&](Vec point, Vec step, double first) {
    return dot(point - raster.anchor_m, step) / dot(step, step) - first;
  };
  for (std::size_t i = 0; i < contour.points_m.size(); ++i) {
    Vec a = contour.points_m[i], b = contour.points_m[(i + 1) % contour.points_m.size()];
    double row_a = place(a, grid.row_step_m, low[1]), row_b = place(b, grid.row_step_m, low[1]);
    if (row_a > row_b) {
      std::swap(a, b);
      std::swap(row_a, row_b);
    }
    const double column_a = place(a, grid.column_step_m, low[0]);
    const double column_b = place(b, grid.column_step_m, low[0]);
    for (double row = std::max(0.0, std::ceil(row_a)); row < row_b && row < grid.rows; ++row) {
      const double part = (row - row_a) / (row_b - row_a);
      crossings.add(static_cast<std::size_t>(row), column_a + part * (column_b - column_a));
    }
  }
}

// Leaves the crossings empty for the next plane. Closed contours cross a row an even number of
// times.
void take_runs(std::size_t plane, Crossings& crossings, std::vector<Run>& runs) {
  for (std::uint32_t row = 0; row < crossings.first.size(); ++row) {
    char* const odd = crossings.odd.data() + std::size_t{row} * crossings.columns;
    Run run = {plane, row, 0, 0};
    bool inside = false;
    for (std::uint32_t column = crossings.first[row]; column < crossings.columns; ++column) {
      if (odd[column] == 0) continue;
      odd[column] = 0;
      inside = !inside;
      (inside ? run.first : run.end) = column;
      if (!inside) runs.push_back(run);
    }
    crossings.first[row] = crossings.columns;
  }
}

}  // namespace

Vec area_of(const Contour& contour) {
  Vec area;
  for (std::size_t i = 0; i < contour.points_m.size(); ++i) {
    const Vec first = contour.points_m[0];
    const std::size_t next = (i + 1) % contour.points_m.size();
    area = area + cross(contour.points_m[i] - first, contour.points_m[next] - first);
  }
  return area;
}

std::size_t drop_repeated(std::vector<Contour>& contours) {
  // A number for each outline, nearly the same for nearly the same outlines: sorted by it, only
  // neighbours are compared. The factors are roots of primes, because with fractions many outlines
  // of a regular pattern would have one number. How many are compared is bounded, because a file
  // may hold any number of contours that only differ in what the number leaves out.
  constexpr std::size_t kMostCompared = 256;
  constexpr Vec kOfMiddle{1.41421356, 1.73205081, 2.23606798};
  constexpr Vec kOfLow{2.64575131, 3.31662479, 3.60555128};
  const double reach_m = kSameM * (length(kOfMiddle) + length(kOfLow));
  std::vector<Outline> outlines;
  for (const Contour& contour : contours) outlines.push_back(outline_of(contour));
  const auto along = [&](std::size_t i) {
    return dot(kOfMiddle, outlines[i].middle) + dot(kOfLow, outlines[i].low);
  };
  std::vector<std::size_t> order(contours.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
  std::vector<bool> repeated(contours.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t back = 1; back <= std::min(i, kMostCompared); ++back) {
      const std::size_t other = order[i - back];
      if (along(order[i]) - along(other) > reach_m) break;
      if (repeated[other] || !may_be_same(outlines[order[i]], outlines[other])) continue;
      const Contour &one = contours[order[i]], &two = contours[other];
      if (lie_on_another(one, two) && lie_on_another(two, one)) repeated[order[i]] = true;
    }
  }
  std::vector<Contour> kept;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (!repeated[i]) kept.push_back(std::move(contours[i]));
  }
  const std::size_t dropped = contours.size() - kept.size();
  contours = std::move(kept);
  return dropped;
}

std::vector<Run> runs_of(const Raster& raster, std::array<double, 2> low,
                         const std::vector<Contour>& contours) {
  std::map<std::size_t, std::vector<const Contour*>> planes;
  for (const Contour& contour : contours) planes[contour.plane].push_back(&contour);
  Crossings crossings(raster.grid);
  std::vector<Run> runs;
  for (const auto& [plane, own] : planes) {
    for (const Contour* const contour : own) cross_rows(raster, low, *contour, crossings);
    take_runs(plane, crossings, runs);
  }
  return runs;
}

}  // namespace stylet::offline
