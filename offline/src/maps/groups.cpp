// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/groups.h"

#include <Eigen/LU>

#include "base/matrix.h"
#include "base/refusal.h"

namespace stylet::offline {

namespace {

using Index = std::array<std::uint32_t, 3>;

// First index and one past the last, along each axis of the box; all zero if no label is found.
std::array<Index, 2> crop_range(const LabelMap& map, const Recipe& recipe) {
  std::vector<bool> wanted(65536, false);
  for (const std::uint16_t label : recipe.crop_around) wanted[label] = true;
  std::array<Index, 2> range = {map.size, Index{}};
  for (std::size_t i = 0; i < map.label.size(); ++i) {
    if (!wanted[map.label[i]]) continue;
    std::size_t rest = i;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<std::uint32_t>(rest % map.size[axis]);
      rest /= map.size[axis];
      range[0][axis] = std::min(range[0][axis], at);
      range[1][axis] = std::max(range[1][axis], at + 1);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double margin = std::ceil(recipe.crop_margin_m / length(map.step_m[axis]) - 1e-9);
    range[0][axis] = static_cast<std::uint32_t>(std::max(0.0, range[0][axis] - margin));
    range[1][axis] =
        static_cast<std::uint32_t>(std::min(1.0 * map.size[axis], range[1][axis] + margin));
  }
  return range;
}

}  // namespace

LabelMap cropped(const std::string& path, const LabelMap& map, const Recipe& recipe) {
  const auto [first, end] = crop_range(map, recipe);
  if (first[0] >= end[0]) refuse("{}: holds none of the labels of [crop]: expected one", path);
  LabelMap part = map;
  part.label.clear();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    part.size[axis] = end[axis] - first[axis];
    part.origin_m = part.origin_m + map.step_m[axis] * first[axis];
  }
  for (std::uint32_t z = first[2]; z < end[2]; ++z) {
    for (std::uint32_t y = first[1]; y < end[1]; ++y) {
      const auto row = map.label.begin() + static_cast<std::ptrdiff_t>(
                                               (std::size_t{z} * map.size[1] + y) * map.size[0]);
      part.label.insert(part.label.end(), row + first[0], row + end[0]);
    }
  }
  return part;
}

Groups groups_of(const std::string& path, const LabelMap& map, const Recipe& recipe) {
  constexpr std::size_t kMostGroups = 255;
  if (recipe.groups.size() > kMostGroups) {
    refuse("{} tissues: expected at most {}", recipe.groups.size(), kMostGroups);
  }
  Groups of_label(65536, 0);
  for (std::size_t i = 0; i < recipe.groups.size(); ++i) {
    for (const std::uint16_t label : recipe.groups[i].labels) {
      of_label[label] = static_cast<std::uint8_t>(i + 1);
    }
  }
  Groups groups;
  groups.reserve(map.label.size());
  bool any = false;
  for (const std::uint16_t label : map.label) {
    groups.push_back(of_label[label]);
    any = any || of_label[label] != 0;
  }
  if (!any) refuse("{}: holds none of the recipe's labels: expected one at least", path);
  return groups;
}

ToIndex::ToIndex(const LabelMap& map)
    : origin_m(map.origin_m), row(rows_of(columns_of(map.step_m).inverse())) {}

std::uint8_t group_at(const LabelMap& map, const Groups& groups, const ToIndex& to_index,
                      Vec point_m) {
  std::size_t index = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    const double at = std::floor(dot(to_index.row[axis], point_m - to_index.origin_m) + 0.5);
    if (!(at >= 0 && at < map.size[axis])) return 0;
    index = index * map.size[axis] + static_cast<std::size_t>(at);
  }
  return groups[index];
}

}  // namespace stylet::offline
