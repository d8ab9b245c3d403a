// SPDX-License-Identifier: Apache-2.0
// How thick structures are at the planes in which they were outlined; with random distances and
// with distances chosen by hand.
#include "maps/slabs.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "random_bodies.h"

namespace stylet::test {
namespace {

// Some of many planes, with about the given distances.
struct Drawn {
  std::vector<double> along_m;
  std::vector<std::size_t> own;
};

Drawn drawn_planes(Draw& draw, const std::vector<double>& gaps_m) {
  Drawn drawn;
  double at = draw.between(-1, 1);
  for (std::size_t i = 0; i <= gaps_m.size(); ++i) {
    drawn.own.push_back(drawn.along_m.size());
    drawn.along_m.push_back(at);
    if (i == gaps_m.size()) break;
    for (std::size_t others = draw.below(3); others > 0; --others) {
      drawn.along_m.push_back(at + gaps_m[i] * draw.between(0.1, 0.9));
    }
    std::sort(drawn.along_m.begin() + static_cast<std::ptrdiff_t>(drawn.own.back()),
              drawn.along_m.end());
    at += gaps_m[i];
  }
  return drawn;
}

// Whether a structure was outlined across a gap: the gap is hardly wider than usual, or one of
// three equal gaps in a row.
bool is_through(const std::vector<double>& gaps, std::size_t i, double usual) {
  const auto alike = [&](std::size_t a, std::size_t b) {
    return a < gaps.size() && b < gaps.size() && gaps[a] <= 1.5 * gaps[b] &&
           gaps[b] <= 1.5 * gaps[a];
  };
  return gaps[i] <= 1.5 * usual || (alike(i, i + 1) && alike(i + 1, i + 2)) ||
         (alike(i - 1, i) && alike(i, i + 1)) || (alike(i - 2, i - 1) && alike(i - 1, i));
}

TEST(Slabs, ReachHalfOfTheWayToTheNextOutlinedPlane) {
  Draw draw(61);
  std::array<int, 2> seen{};
  for (int round = 0; round < 400; ++round) {
    const double otherwise = draw.between(0.001, 0.01);
    std::vector<double> gaps;
    for (std::size_t i = draw.below(9); i > 0; --i) {
      gaps.push_back(otherwise *
                     (draw.below(3) == 0 ? draw.between(1.4, 4) : draw.between(1, 1.6)));
    }
    const Drawn drawn = drawn_planes(draw, gaps);
    std::vector<double> sorted = gaps;
    std::sort(sorted.begin(), sorted.end());
    double usual = otherwise;
    if (gaps.size() > 1) usual = sorted[(gaps.size() - 1) / 2];
    if (gaps.size() == 1 && gaps[0] <= 1.5 * otherwise) usual = gaps[0];
    const offline::Slabs slabs = offline::slabs_of(drawn.own, drawn.along_m, otherwise);
    ASSERT_EQ(slabs.size(), drawn.own.size());
    for (std::size_t i = 0; i < drawn.own.size(); ++i) {
      const auto through = [&](std::size_t gap) {
        const bool is = gap < gaps.size() && is_through(gaps, gap, usual);
        ++seen[is ? 1 : 0];
        return is;
      };
      const bool below = through(i - 1), above = through(i);
      const double low = below ? gaps[i - 1] : above ? gaps[i] : usual;
      const double high = above ? gaps[i] : below ? gaps[i - 1] : usual;
      const offline::Slab& slab = slabs.at(drawn.own[i]);
      EXPECT_NEAR(slab.low_m, drawn.along_m[drawn.own[i]] - low / 2, 1e-12) << round << " " << i;
      EXPECT_NEAR(slab.high_m, drawn.along_m[drawn.own[i]] + high / 2, 1e-12) << round << " " << i;
    }
  }
  EXPECT_GT(std::min(seen[0], seen[1]), 500);
}

// Planes of 3 mm, then a gap; and three gaps of 9 mm, as of a structure drawn on every third plane.
TEST(Slabs, AreEmptyAcrossOneWideGapAndFilledAcrossThree) {
  const auto ends_mm = [](const std::vector<double>& along_mm) {
    std::vector<double> along_m;
    std::vector<std::size_t> own;
    for (const double at : along_mm) {
      own.push_back(own.size());
      along_m.push_back(at * 1e-3);
    }
    std::vector<double> ends;
    for (const auto& [plane, slab] : offline::slabs_of(own, along_m, 0.003)) {
      for (const double end : {slab.low_m, slab.high_m})
        ends.push_back(std::round(end * 1e6) / 1e3);
    }
    return ends;
  };
  using testing::ElementsAre;
  EXPECT_THAT(ends_mm({5}), ElementsAre(3.5, 6.5));
  EXPECT_THAT(ends_mm({0, 4}), ElementsAre(-2, 2, 2, 6));
  EXPECT_THAT(ends_mm({0, 5}), ElementsAre(-1.5, 1.5, 3.5, 6.5));
  EXPECT_THAT(ends_mm({0, 3, 6, 15, 18}),
              ElementsAre(-1.5, 1.5, 1.5, 4.5, 4.5, 7.5, 13.5, 16.5, 16.5, 19.5));
  EXPECT_THAT(
      ends_mm({0, 3, 6, 9, 18, 27, 36}),
      ElementsAre(-1.5, 1.5, 1.5, 4.5, 4.5, 7.5, 7.5, 13.5, 13.5, 22.5, 22.5, 31.5, 31.5, 40.5));
}

// Planes that are off by the last digits of their positions, or by a hundredth of their distance,
// count as even.
TEST(Slabs, MakeLayersOfTheirDistanceWhereTheyAreEven) {
  Draw draw(62);
  for (int round = 0; round < 200; ++round) {
    const double step = draw.between(0.0005, 0.005), low = draw.between(-1, 1);
    const bool even = draw.coin();
    const double off = even ? 0.95 * (2e-5 + 0.01 * step) : 1.05 * (2e-5 + 0.01 * step);
    std::vector<offline::Slabs> slabs(1 + draw.below(3));
    std::vector<std::vector<offline::Span>> spans(slabs.size());
    slabs[0][0] = {low, low + step};  // exactly the thinnest and the lowest
    spans[0].push_back({0, 1});
    std::uint32_t top = 1;
    for (std::size_t s = 0; s < slabs.size(); ++s) {
      for (std::size_t plane = 1; plane < 4; ++plane) {
        const auto first = static_cast<std::uint32_t>(1 + 3 * plane + draw.below(2));
        const auto behind = static_cast<std::uint32_t>(first + 2 + draw.below(2));
        const double sign = draw.coin() ? off : -off;
        slabs[s][plane] = {low + first * step + sign, low + behind * step};
        spans[s].push_back({first, behind});
        top = std::max(top, behind);
      }
    }
    offline::PixelGrid grid{};
    grid.columns = grid.rows = 16;
    const offline::Layers layers = offline::layers_of(grid, slabs);
    EXPECT_NEAR(layers.low_m, low, 1e-12);
    EXPECT_NEAR(layers.high_m, low + top * step, 1e-12);
    EXPECT_NEAR(layers.step_m, even ? step : step / 8, 1e-12) << round;
    const std::uint32_t finer = even ? 1 : 8;
    for (std::size_t s = 0; s < slabs.size(); ++s) {
      std::size_t i = 0;
      for (const auto& [plane, slab] : slabs[s]) {
        const offline::Span span = offline::span_of(layers, slab), expected = spans[s][i++];
        EXPECT_NEAR(span.first, expected.first * finer, even ? 0 : 1);
        EXPECT_EQ(span.end, expected.end * finer);
      }
    }
  }
}

}  // namespace
}  // namespace stylet::test
