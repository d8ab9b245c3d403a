// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/wall_thickness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylet::offline {
namespace {

constexpr std::size_t kLayers = 65536;  // by label

struct Layer {
  double volume_m3 = 0, inside_m2 = 0, outside_m2 = 0;
};

class Measure {
 public:
  Measure(const LabelMap& map, const WallDistances& distances,
          const std::vector<std::uint16_t>& label_of_layer)
      : map_(map), distances_(distances), order_of_(kLayers, 0), layers_(label_of_layer.size()) {
    for (std::size_t i = 0; i < label_of_layer.size(); ++i) {
      order_of_[label_of_layer[i]] = static_cast<std::uint16_t>(i + 1);
    }
    stride_ = {1, map.size[0], std::size_t{map.size[0]} * map.size[1]};
    for (std::size_t axis = 0; axis < 3; ++axis) step_m_[axis] = length(map.step_m[axis]);
    longest_m_ = *std::max_element(step_m_.begin(), step_m_.end());
  }

  std::vector<Layer> run() {
    std::array<std::size_t, 3> at{};
    for (std::size_t i = 0; i < map_.label.size(); ++i) {
      visit(i, at);
      for (std::size_t axis = 0; axis < 3 && ++at[axis] == map_.size[axis]; ++axis) at[axis] = 0;
    }
    return layers_;
  }

 private:
  // Order from the inside: 0 for the map's own labels, then the layers, then the outside.
  std::size_t order(std::size_t i) const {
    if (map_.label[i] == 0) return layers_.size() + 1;
    return order_of_[map_.label[i]];
  }

  // Whether the wall here goes straight from a label to the outside: in a gap the way is longer.
  bool is_straight(std::size_t i) const {
    const double both_m = static_cast<double>(distances_.from_labels_m[i]) +
                          static_cast<double>(distances_.from_outside_m[i]);
    constexpr double kBetweenMiddles = 1.3;  // excess of distances between middles, in voxels
    return both_m <= distances_.thickness_m + kBetweenMiddles * longest_m_;
  }

  void visit(std::size_t i, const std::array<std::size_t, 3>& at) {
    const std::size_t here = order(i);
    const bool is_layer = here > 0 && here <= layers_.size();
    if (is_layer && (here > 1 || is_straight(i))) {
      layers_[here - 1].volume_m3 += step_m_[0] * step_m_[1] * step_m_[2];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] + 1 == map_.size[axis]) continue;
      const std::size_t beside = i + stride_[axis], there = order(beside);
      if (here == there) continue;
      const std::size_t inner = std::min(here, there), outer = std::max(here, there);
      const std::size_t wall_side = (inner == 0) == (here > there) ? i : beside;
      const bool of_innermost = inner > 1 || is_straight(wall_side);
      if (inner == 0 && !of_innermost) continue;
      const double area_m2 = step_m_[(axis + 1) % 3] * step_m_[(axis + 2) % 3];
      const auto& from_m = inner == 0 ? distances_.from_outside_m : distances_.from_labels_m;
      const double part = area_m2 * std::abs(normal_part(from_m, i, at, axis));
      // A layer that is missing here between two others has both of its sides here.
      for (std::size_t k = inner; k < outer; ++k) {
        if (k > 1 || (k == 1 && of_innermost)) layers_[k - 1].outside_m2 += part;
        if (k < layers_.size()) layers_[k].inside_m2 += part;
      }
    }
  }

  // Component along an axis of the unit gradient between a voxel and the next one along that axis.
  double normal_part(const std::vector<float>& distance, std::size_t i,
                     const std::array<std::size_t, 3>& at, std::size_t axis) const {
    double squared = 0, along = 0;
    for (std::size_t each = 0; each < 3; ++each) {
      const bool low = at[each] > 0, is_axis = each == axis;
      const bool high = at[each] + (is_axis ? 2 : 1) < map_.size[each];
      const std::size_t first = i - (low ? stride_[each] : 0);
      const std::size_t last = i + (is_axis ? stride_[each] : 0) + (high ? stride_[each] : 0);
      const std::size_t beside = is_axis ? 0 : stride_[axis];  // for the mean of both voxels
      const double steps = (low ? 1 : 0) + (high ? 1 : 0) + (is_axis ? 1 : 0);
      if (steps == 0) continue;
      const auto value = [&](std::size_t at_i) { return static_cast<double>(distance[at_i]); };
      const double rise =
          (value(last) - value(first) + value(last + beside) - value(first + beside)) / 2;
      const double slope = rise / (steps * step_m_[each]);
      squared += slope * slope;
      if (is_axis) along = slope;
    }
    return squared > 0 ? along / std::sqrt(squared) : 0;
  }

  const LabelMap& map_;
  const WallDistances& distances_;
  std::vector<std::uint16_t> order_of_;
  std::vector<Layer> layers_;
  std::array<std::size_t, 3> stride_{};
  std::array<double, 3> step_m_{};
  double longest_m_ = 0;
};

}  // namespace

std::vector<double> layer_thickness_m(const LabelMap& map, const WallDistances& distances,
                                      const std::vector<std::uint16_t>& label_of_layer) {
  std::vector<double> thickness_m;
  for (const Layer& each : Measure(map, distances, label_of_layer).run()) {
    // The mean of all areas between two spheres, as for a frustum of a cone; also for two planes.
    const double mean_m2 =
        (each.inside_m2 + std::sqrt(each.inside_m2 * each.outside_m2) + each.outside_m2) / 3;
    thickness_m.push_back(mean_m2 > 0 ? each.volume_m3 / mean_m2
                                      : std::numeric_limits<double>::quiet_NaN());
  }
  return thickness_m;
}

}  // namespace stylet::offline
