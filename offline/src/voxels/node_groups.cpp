// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/node_groups.h"

#include "base/disjoint_set.h"

namespace stylet::offline {

std::vector<AtNode> NodeGroups::around(const CellPlace& node) const {
  std::vector<AtNode> around;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const auto back = [&](std::uint32_t bit) { return (corner >> bit & 1U) != 0 ? -1 : 0; };
    cells.each_part(node, {back(0), back(1), back(2)}, [&](std::uint32_t i) {
      around.push_back({i, corner});
    });
  }
  return around;
}

bool NodeGroups::find_crowded() {
  bool any = false;
  for (std::uint32_t i = 0; i < cells.parts.size(); ++i) {
    if (!cells.parts[i].is_beside) continue;
    for (int n = 0; n < 27 && !cells.parts[i].crowded; ++n) {
      cells.each_part(cells.place_of(cells.parts[i].cell), step_of(n), [&](std::uint32_t j) {
        if (cells.linked(i, j)) return;
        cells.parts[i].crowded = cells.parts[j].crowded = any = true;
      });
    }
  }
  return any;
}

void NodeGroups::find_groups() {
  const auto is_crowded = [](const CellPart& part) { return part.crowded; };
  each_node(is_crowded, [&](const CellPlace& node) {
    const std::vector<AtNode> here = around(node);
    std::vector<std::uint32_t> parent = each_by_itself(here.size());
    for (std::uint32_t i = 0; i < here.size(); ++i) {
      for (std::uint32_t j = 0; j < i; ++j) {
        if (cells.linked(here[i].part, here[j].part)) join(parent, i, j);
      }
    }
    for (std::uint32_t i = 0; i < here.size(); ++i) {
      cells.parts[here[i].part].group[here[i].corner] =
          static_cast<std::uint8_t>(root_of(parent, i));
    }
  });
}

void NodeGroups::unite(const CellPlace& node, std::span<const std::uint32_t> parts) {
  const std::vector<AtNode> here = around(node);
  const auto group_of = [&](const AtNode& at) -> std::uint8_t& {
    return cells.parts[at.part].group[at.corner];
  };
  std::uint32_t lowest = 0xFF;
  std::array<bool, 256> is_one{};
  for (const AtNode& at : here) {
    if (std::ranges::find(parts, at.part) == parts.end()) continue;
    is_one[group_of(at)] = true;
    lowest = std::min<std::uint32_t>(lowest, group_of(at));
  }

  for (const AtNode& at : here) {
    if (is_one[group_of(at)]) group_of(at) = static_cast<std::uint8_t>(lowest);
  }
}

}  // namespace stylet::offline
