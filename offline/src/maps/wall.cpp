// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/wall.h"

#include <algorithm>
#include <limits>

#include "base/most_off.h"
#include "base/refusal.h"
#include "maps/readers.h"
#include "maps/wall_thickness.h"

namespace stylet::offline {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
using Index = std::array<std::size_t, 3>;

Index index_of(const LabelMap& map, std::size_t i) {
  return {i % map.size[0], i / map.size[0] % map.size[1], i / map.size[0] / map.size[1]};
}

// Whether a label lies at the low and the high end of each axis.
std::array<std::array<bool, 2>, 3> reached_sides(const LabelMap& map) {
  std::array<std::array<bool, 2>, 3> reached{};
  for (std::size_t i = 0; i < map.label.size(); ++i) {
    if (map.label[i] == 0) continue;
    const Index at = index_of(map, i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      reached[axis][0] = reached[axis][0] || at[axis] == 0;
      reached[axis][1] = reached[axis][1] || at[axis] + 1 == map.size[axis];
    }
  }
  return reached;
}

LabelMap padded(const LabelMap& map, double margin_m) {
  const auto reached = reached_sides(map);
  LabelMap larger = map;
  Index before{};
  std::size_t count = 1;
  std::array<double, 3> margins{};
  double wanted = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    margins[axis] = std::ceil(margin_m / length(map.step_m[axis])) + 1;
    wanted *= map.size[axis] + 2 * margins[axis];
  }
  if (!(wanted <= static_cast<double>(kMostMapVoxels))) {
    refuse(
        "a wall of {:g} mm around a map with voxels of {:.3g} x {:.3g} x {:.3g} mm: {:.3g} voxels: "
        "expected at most {}; is the spacing right?",
        margin_m * 1e3, length(map.step_m[0]) * 1e3, length(map.step_m[1]) * 1e3,
        length(map.step_m[2]) * 1e3, wanted, kMostMapVoxels);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto margin = static_cast<std::uint32_t>(margins[axis]);
    before[axis] = reached[axis][0] ? 0 : margin;
    larger.size[axis] += static_cast<std::uint32_t>(before[axis]) + (reached[axis][1] ? 0 : margin);
    larger.origin_m = larger.origin_m - map.step_m[axis] * static_cast<double>(before[axis]);
    count *= larger.size[axis];
  }
  larger.label.assign(count, 0);
  for (std::size_t i = 0; i < map.label.size(); i += map.size[0]) {
    const Index at = index_of(map, i);
    const std::size_t row = (at[2] + before[2]) * larger.size[1] + at[1] + before[1];
    std::copy_n(
        map.label.begin() + static_cast<std::ptrdiff_t>(i), map.size[0],
        larger.label.begin() + static_cast<std::ptrdiff_t>(row * larger.size[0] + before[0]));
  }
  return larger;
}

// Squared distances along a line of places `step` apart, from squared distances along other axes:
// the lower envelope of parabolas on these (Felzenszwalb and Huttenlocher 2012).
struct LineDistance {
  std::vector<double> start;        // from here on the parabola is the lowest
  std::vector<std::size_t> centre;  // of the parabola

  void run(std::vector<double>& line, double step) {
    start.clear();
    centre.clear();
    const auto height = [&](std::size_t q) {
      const double at = static_cast<double>(q) * step;
      return line[q] + at * at;
    };
    for (std::size_t q = 0; q < line.size(); ++q) {
      if (line[q] == std::numeric_limits<double>::infinity()) continue;
      double from = -std::numeric_limits<double>::infinity();
      while (!centre.empty()) {
        const double apart = static_cast<double>(q - centre.back()) * step;
        from = (height(q) - height(centre.back())) / (2 * apart);
        if (from > start.back()) break;
        start.pop_back();
        centre.pop_back();
        from = -std::numeric_limits<double>::infinity();
      }
      start.push_back(from);
      centre.push_back(q);
    }
    if (centre.empty()) return;
    const std::vector<double> before = line;
    for (std::size_t q = 0, k = 0; q < line.size(); ++q) {
      const double at = static_cast<double>(q) * step;
      while (k + 1 < start.size() && start[k + 1] < at) ++k;
      const double away = at - static_cast<double>(centre[k]) * step;
      line[q] = before[centre[k]] + away * away;
    }
  }
};

// In place: `distance` is 0 or kFar before, and then the squared distance of each voxel's middle
// from the nearest middle with 0. The axes must be perpendicular, as those of scanners are.
void square_distances(const LabelMap& map, std::vector<float>& distance) {
  LineDistance line_distance;
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; stride *= map.size[axis], ++axis) {
    std::vector<double> line(map.size[axis]);
    for (std::size_t i = 0; i < distance.size(); ++i) {
      if (i / stride % map.size[axis] != 0) continue;  // where a line begins
      for (std::size_t q = 0; q < line.size(); ++q) {
        line[q] = static_cast<double>(distance[i + q * stride]);
      }
      line_distance.run(line, length(map.step_m[axis]));
      for (std::size_t q = 0; q < line.size(); ++q) {
        distance[i + q * stride] = static_cast<float>(line[q]);
      }
    }
  }
}

// A label that neither the map nor an earlier layer uses.
std::uint16_t free_label(const LabelMap& map, const std::vector<std::uint16_t>& taken) {
  std::vector<bool> used(65536, false);
  for (const std::uint16_t label : map.label) used[label] = true;
  for (const std::uint16_t label : taken) used[label] = true;
  for (std::size_t label = 65535; label > 0; --label) {
    if (!used[label]) return static_cast<std::uint16_t>(label);
  }
  refuse("[[wall]]: the map uses every label from 1 to 65535: expected one that is free");
}

void add_label(Recipe& recipe, const std::string& tissue, std::uint16_t label) {
  const auto same = std::find_if(recipe.groups.begin(), recipe.groups.end(),
                                 [&](const LabelGroup& group) { return group.tissue == tissue; });
  if (same == recipe.groups.end()) {
    recipe.groups.push_back({tissue, {label}});
  } else {
    same->labels.push_back(label);
  }
}

std::vector<float> roots(std::vector<float> squared) {
  for (float& each : squared) each = std::sqrt(each);
  return squared;
}

// Warnings for layers that are not as thick as was asked for.
std::vector<std::string> warnings_of(const LabelMap& map, const WallDistances& distances,
                                     const Recipe& recipe,
                                     const std::vector<std::uint16_t>& label_of_layer) {
  const std::vector<double> thickness_m = layer_thickness_m(map, distances, label_of_layer);
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < thickness_m.size(); ++i) {
    const WallLayer& layer = recipe.wall[i];
    const double off = thickness_m[i] / layer.thickness_m - 1;
    if (!(std::abs(off) > kMostOff)) continue;
    warnings.push_back(
        fmt::format("layer {}: on the map's voxels of {:.3g} x {:.3g} x {:.3g} mm it is {:.3g} mm "
                    "thick on average instead of {:.3g} mm ({:+} %): expected a finer map, or a "
                    "thickness of whole voxels",
                    layer.tissue, length(map.step_m[0]) * 1e3, length(map.step_m[1]) * 1e3,
                    length(map.step_m[2]) * 1e3, thickness_m[i] * 1e3, layer.thickness_m * 1e3,
                    std::lround(100 * off)));
  }
  return warnings;
}

}  // namespace

std::vector<std::string> add_wall(LabelMap& map, Recipe& recipe) {
  if (recipe.wall.empty()) return {};
  double thickness_m = 0;
  for (const WallLayer& layer : recipe.wall) thickness_m += layer.thickness_m;
  map = padded(map, thickness_m);
  std::vector<float> squared_m2;
  for (const std::uint16_t label : map.label) squared_m2.push_back(label != 0 ? 0 : kFar);
  square_distances(map, squared_m2);
  // A label's surface lies about 0.3 voxels beyond the nearest middle, averaged over directions.
  const double beyond_m = 0.3 * std::cbrt(voxel_volume_m3(map));
  const auto within = static_cast<float>((thickness_m + beyond_m) * (thickness_m + beyond_m));
  WallDistances distances{roots(squared_m2), {}, thickness_m};
  for (float& each : squared_m2) each = each > within ? 0 : kFar;  // now from outside the wall
  square_distances(map, squared_m2);
  std::vector<std::uint16_t> label_of_layer;
  for (const WallLayer& layer : recipe.wall) {
    label_of_layer.push_back(free_label(map, label_of_layer));
    add_label(recipe, layer.tissue, label_of_layer.back());
  }
  for (std::size_t i = 0; i < map.label.size(); ++i) {
    if (map.label[i] != 0 || squared_m2[i] == 0) continue;
    std::size_t layer = recipe.wall.size() - 1;
    double depth_m = std::sqrt(static_cast<double>(squared_m2[i])) - beyond_m;
    while (layer > 0 && depth_m > recipe.wall[layer].thickness_m) {
      depth_m -= recipe.wall[layer--].thickness_m;
    }
    map.label[i] = label_of_layer[layer];
  }
  distances.from_outside_m = roots(std::move(squared_m2));
  return warnings_of(map, distances, recipe, label_of_layer);
}

}  // namespace stylet::offline
