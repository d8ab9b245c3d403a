// SPDX-License-Identifier: Apache-2.0
// Which contours count as the same: figures that differ in only one respect, at random places,
// sizes and axes; and each figure next to itself written in another way.
#include "maps/contours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "random_bodies.h"

namespace stylet::test {
namespace {

using offline::Contour;
using offline::Vec;

// Points in a plane, mm.
using Figure = std::vector<std::array<double, 2>>;

const Figure kSquare = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};

// A square with a line into it and back.
Figure with_way(std::array<double, 2> from, std::array<double, 2> to) {
  Figure figure;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [u, v] = kSquare[i];
    const auto [next_u, next_v] = kSquare[(i + 1) % 4];
    figure.push_back(kSquare[i]);
    const bool on_side = (u == next_u && from[0] == u) || (v == next_v && from[1] == v);
    if (on_side) figure.insert(figure.end(), {from, to, from});
  }
  return figure;
}

struct Pair {
  const char* differ_in;
  Figure one, two;
};

// `weights`: contours are compared only if the sums of their middles' coordinates, times these
// weights, are near each other; those of the third pair are.
std::vector<Pair> pairs(std::array<double, 2> weights) {
  const Figure z = {{0, 0}, {20, 0}, {20, 12}, {30, 12}, {30, 20}, {10, 20}, {10, 8}, {0, 8}};
  Figure mirrored = z;
  for (auto& point : mirrored) point[0] = 30 - point[0];
  const Figure cross = {{0, 5},   {5, 5},   {5, 0},   {15, 0}, {15, 5}, {20, 5},
                        {20, 15}, {15, 15}, {15, 20}, {5, 20}, {5, 15}, {0, 15}};
  const double side = 20 * std::numbers::sqrt2;
  const Figure ways = {{0, 0},   {10, 0},  {10, 4},  {10, 0},  {20, 0},  {20, 10},
                       {16, 10}, {20, 10}, {20, 20}, {10, 20}, {10, 16}, {10, 20},
                       {0, 20},  {0, 10},  {4, 10},  {0, 10}};
  const double along = 2 + weights[0] / weights[1] * (8 - 2);
  return {{"sides", z, mirrored},
          {"area", kSquare, cross},
          {"middle", with_way({8, 0}, {8, 4}), with_way({0, along}, {4, along})},
          {"size", kSquare, {{0, 0}, {side, 0}, {0, side}}},
          {"ways into it", kSquare, ways}};
}

class Contours : public ::testing::Test {
 protected:
  Draw draw{4117};
  double size_ = 0, plane_m_ = 0;
  std::array<std::size_t, 3> axes_ = {};  // of u, v and the normal
  std::array<double, 2> at_mm_ = {};

  void place() {
    axes_ = {0, 1, 2};
    for (std::size_t i = 2; i > 0; --i) std::swap(axes_[i], axes_[draw.below(i + 1)]);
    size_ = draw.between(0.3, 3);
    at_mm_ = {draw.between(-100, 100), draw.between(-100, 100)};
    plane_m_ = draw.between(-0.1, 0.1);
  }

  Contour drawn(const Figure& figure) const {
    Contour contour;
    for (const auto& [u, v] : figure) {
      std::array<double, 3> point = {};
      point[axes_[0]] = (at_mm_[0] + size_ * u) * 1e-3;
      point[axes_[1]] = (at_mm_[1] + size_ * v) * 1e-3;
      point[axes_[2]] = plane_m_;
      contour.points_m.push_back({point[0], point[1], point[2]});
    }
    return contour;
  }

  // The same contour with more points on its sides, another first point, perhaps backwards, some
  // points twice, and rounded to 2 um.
  Contour otherwise(Contour contour) {
    auto& points = contour.points_m;
    for (std::size_t i = draw.below(4); i > 0; --i) {
      const auto at = static_cast<std::ptrdiff_t>(1 + draw.below(points.size() - 1));
      const Vec from = points[static_cast<std::size_t>(at - 1)];
      const Vec way = points[static_cast<std::size_t>(at)] - from;
      points.insert(points.begin() + at, from + way * draw.between(0.1, 0.9));
    }
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(draw.below(points.size()));
    std::rotate(points.begin(), begin, points.end());
    if (draw.below(2) == 0) std::reverse(points.begin(), points.end());
    for (Vec& point : points) {
      point = point + Vec{draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)} * 1e-6;
    }
    for (std::size_t i = draw.below(3); i > 0; --i) points.insert(points.begin(), points.front());
    return contour;
  }
};

TEST_F(Contours, ThatDifferInOneRespectAreDifferent) {
  const std::array<double, 3> weights = {std::sqrt(2.0), std::sqrt(3.0), std::sqrt(5.0)};
  for (int repeat = 0; repeat < 200; ++repeat) {
    place();
    for (const Pair& pair : pairs({weights[axes_[0]], weights[axes_[1]]})) {
      std::vector<Contour> contours = {drawn(pair.one), drawn(pair.two)};
      if (draw.below(2) == 0) std::swap(contours[0], contours[1]);
      EXPECT_EQ(offline::drop_repeated(contours), 0U) << pair.differ_in << ", " << repeat;
      EXPECT_EQ(contours.size(), 2U) << pair.differ_in << ", " << repeat;
    }
  }
}

TEST_F(Contours, ThatAreOnlyWrittenInAnotherWayAreTheSame) {
  for (int repeat = 0; repeat < 200; ++repeat) {
    place();
    for (const Pair& pair : pairs({1, 1})) {
      for (const Figure& figure : {pair.one, pair.two}) {
        std::vector<Contour> contours = {drawn(figure), otherwise(drawn(figure))};
        if (draw.below(2) == 0) contours.push_back(otherwise(drawn(figure)));
        const std::size_t count = contours.size();
        EXPECT_EQ(offline::drop_repeated(contours), count - 1) << pair.differ_in << ", " << repeat;
      }
    }
  }
}

}  // namespace
}  // namespace stylet::test
