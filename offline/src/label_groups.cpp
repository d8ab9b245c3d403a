// SPDX-License-Identifier: GPL-3.0-or-later
#include "label_groups.h"

#include "refusal.h"

namespace stylet::bake {

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

}  // namespace stylet::bake
