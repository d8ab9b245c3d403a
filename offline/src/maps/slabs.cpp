// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/slabs.h"

#include <algorithm>

namespace stylet::offline {
namespace {

constexpr double kSame = 0.01;   // of a distance: tolerance for even planes
constexpr double kWidest = 1.5;  // of the usual distance; in wider gaps, planes were left out

// Which gaps are filled and not empty: those of about the usual distance, and three or more alike
// in a row.
std::vector<bool> drawn_through(const std::vector<double>& gaps, double usual) {
  constexpr std::size_t kInARow = 3;
  std::vector<bool> through(gaps.size());
  for (std::size_t first = 0, end = 0; first < gaps.size(); first = end) {
    for (end = first + 1; end < gaps.size(); ++end) {
      const auto [low, high] = std::minmax(gaps[end], gaps[end - 1]);
      if (high > kWidest * low) break;
    }
    for (std::size_t i = first; i < end; ++i) {
      through[i] = gaps[i] <= kWidest * usual || end - first >= kInARow;
    }
  }
  return through;
}

}  // namespace

std::vector<double> gaps_of(const std::vector<std::size_t>& own,
                            const std::vector<double>& along_m) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < own.size(); ++i) {
    gaps.push_back(along_m[own[i]] - along_m[own[i - 1]]);
  }
  return gaps;
}

double drawn_gap_m(const std::vector<double>& gaps) {
  const std::vector<bool> in_a_row = drawn_through(gaps, 0);
  std::vector<double> alike;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (in_a_row[i]) alike.push_back(gaps[i]);
  }
  return alike.empty() ? 0 : median(alike);
}

Slabs slabs_of(const std::vector<std::size_t>& own, const std::vector<double>& along_m,
               double otherwise_m) {
  const std::vector<double> gaps = gaps_of(own, along_m);
  const bool tells = gaps.size() > 1 || (gaps.size() == 1 && gaps[0] <= kWidest * otherwise_m);
  const double usual = tells ? median(gaps) : otherwise_m;
  const std::vector<bool> through = drawn_through(gaps, usual);
  const auto half = [&](std::size_t gap, std::size_t other) {
    if (gap < gaps.size() && through[gap]) return gaps[gap] / 2;
    return (other < gaps.size() && through[other] ? gaps[other] : usual) / 2;
  };
  Slabs slabs;
  for (std::size_t i = 0; i < own.size(); ++i) {
    slabs[own[i]] = {along_m[own[i]] - half(i - 1, i), along_m[own[i]] + half(i, i - 1)};
  }
  return slabs;
}

Layers layers_of(const PixelGrid& grid, const std::vector<Slabs>& slabs) {
  Layers layers;
  double least = HUGE_VAL;
  for (const Slabs& own : slabs) {
    for (const auto& [plane, slab] : own) {
      layers.low_m = std::min(layers.low_m, slab.low_m);
      layers.high_m = std::max(layers.high_m, slab.high_m);
      least = std::min(least, slab.high_m - slab.low_m);
    }
  }
  const auto on_layer = [&](double at_m) {
    const double place = (at_m - layers.low_m) / least;
    return std::fabs(place - std::round(place)) * least <= kSamePlaneM + kSame * least;
  };
  bool even = true;
  for (const Slabs& own : slabs) {
    for (const auto& [plane, slab] : own) {
      even = even && on_layer(slab.low_m) && on_layer(slab.high_m);
    }
  }
  const double height_m = layers.high_m - layers.low_m;
  layers.step_m = even ? least : layer_step_m(grid, height_m, least);
  return layers;
}

Span span_of(const Layers& layers, Slab slab) {
  const auto at = [&](double place_m) {
    return static_cast<std::uint32_t>(std::lround((place_m - layers.low_m) / layers.step_m));
  };
  return {at(slab.low_m), at(slab.high_m)};
}

}  // namespace stylet::offline
