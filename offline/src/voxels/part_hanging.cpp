// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/part_hanging.h"

#include <bit>
#include <set>

#include "base/disjoint_set.h"

namespace stylet::offline {
namespace {

bool same_cell(const CellPlace& a, const CellPlace& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

CellPlace cell_around(const CellPlace& fine) {
  return {fine.x / 2, fine.y / 2, fine.z / 2};
}

// Calls visit(number) for the parts of a cell.
template <typename Visit>
void each_part_in(const CellParts& cells, const CellPlace& cell, Visit visit) {
  cells.each_part(cell, {0, 0, 0}, visit);
}

class Hanging {
 public:
  Hanging(const NodeGroups& fine, const SamplePlaces& places, const ApartOwners& apart,
          NodeGroups& coarse)
      : fine_(fine),
        places_(places),
        apart_(apart),
        coarse_(coarse),
        parent_(fine.cells.parts.size(), kUnknown) {}

  std::vector<GroupHangs> find() {
    std::vector<GroupHangs> found;
    const auto is_voxel = [](const CellPart& part) { return part.is_voxel; };
    fine_.each_node(is_voxel, [&](const CellPlace& node) {
      const std::vector<CellPlace> touched = coarse_voxels_at(node);
      if (touched.empty()) return;
      const std::vector<AtNode> around = fine_.around(node);
      std::set<std::uint8_t> groups;
      for (const AtNode& at : around) {
        if (fine_.cells.parts[at.part].is_voxel) groups.insert(group_of(at));
      }
      for (const std::uint8_t group : groups) {
        const std::vector<std::uint32_t> on = parts_under(around, group, touched);
        if (on.empty()) continue;
        found.push_back({node, group, on.front()});
        each_master(node, [&](const CellPlace& master) { coarse_.unite(master, on); });
      }
    });
    return found;
  }

 private:
  static constexpr std::uint32_t kUnknown = kNoPart - 1;

  std::uint8_t group_of(const AtNode& at) const {
    return fine_.cells.parts[at.part].group[at.corner];
  }

  // The coarser cells with voxels that touch a node, in the order of hanging_nodes.
  std::vector<CellPlace> coarse_voxels_at(const CellPlace& node) const {
    std::vector<CellPlace> found;
    for (std::uint32_t side = 0; side < 8; ++side) {
      const auto along = [&](std::uint32_t at, std::uint32_t axis) {
        const bool below = (side >> axis & 1U) != 0 && at % 2 == 0;
        return at / 2 - (below ? 1U : 0U);  // below 0: wraps beyond the size
      };
      const CellPlace cell = {along(node.x, 0), along(node.y, 1), along(node.z, 2)};
      bool has_voxel = false;
      each_part_in(coarse_.cells, cell, [&](std::uint32_t i) {
        has_voxel = has_voxel || coarse_.cells.parts[i].is_voxel;
      });
      const auto is_same = [&](const CellPlace& other) { return same_cell(cell, other); };
      if (has_voxel && std::ranges::none_of(found, is_same)) found.push_back(cell);
    }
    return found;
  }

  // The coarser nodes between which a node lies.
  template <typename Visit>
  static void each_master(const CellPlace& node, Visit visit) {
    const std::uint32_t odd = (node.x & 1U) | (node.y & 1U) << 1U | (node.z & 1U) << 2U;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      if ((corner & ~odd) != 0) continue;
      visit(CellPlace{node.x / 2 + (corner & 1U), node.y / 2 + (corner >> 1U & 1U),
                      node.z / 2 + (corner >> 2U)});
    }
  }

  // The parts of the touched cells on which a group hangs.
  std::vector<std::uint32_t> parts_under(const std::vector<AtNode>& around, std::uint8_t group,
                                         const std::vector<CellPlace>& touched) {
    std::vector<std::uint32_t> on;
    const auto add = [&](std::uint32_t part) {
      if (part != kNoPart && std::ranges::find(on, part) == on.end()) on.push_back(part);
    };
    for (const CellPlace& cell : touched) {
      bool decided = false, has_samples = false;
      each_part_in(coarse_.cells, cell, [&](std::uint32_t i) {
        has_samples = has_samples || coarse_.cells.parts[i].inside != 0;
      });
      for (const AtNode& at : around) {
        const CellPart& part = fine_.cells.parts[at.part];
        const CellPlace there = cell_around(fine_.cells.place_of(part.cell));
        if (!has_samples || !same_cell(there, cell)) continue;
        const bool is_one = group_of(at) == group;
        decided = decided || !is_one || parent_of(at.part) != kNoPart;
        if (is_one) add(parent_of(at.part));
      }
      if (decided) continue;
      // The coarser voxel has next to no samples here, and perhaps none at all: the parts of the
      // coarser level tell what is connected. A finer part that is a sliver belongs to no coarser
      // part. Such a sliver hangs on each coarser part that touches all coarser parts around it and
      // that the sliver is not apart from.
      for (const AtNode& at : around) {
        const CellPart& own = fine_.cells.parts[at.part];
        if (!own.is_voxel || group_of(at) != group) continue;
        const std::uint32_t parent = parent_of(at.part);
        each_part_in(coarse_.cells, cell, [&](std::uint32_t i) {
          const CellPart& other = coarse_.cells.parts[i];
          const bool is_alone = !other.crowded && !apart_.apart(own.sides, other.sides);
          if (parent != kNoPart ? coarse_.cells.linked(parent, i) : is_alone) add(i);
        });
      }
    }
    return on;
  }

  // The coarser part that a part belongs to, or none.
  std::uint32_t parent_of(std::uint32_t part) {
    if (parent_[part] == kUnknown) {
      find_parents(cell_around(fine_.cells.place_of(fine_.cells.parts[part].cell)));
    }
    return parent_[part];
  }

  // Finds the coarser parts that the finer parts in a coarser cell belong to.
  void find_parents(const CellPlace& cell) {
    std::vector<std::uint32_t> parts;
    for (std::uint32_t child = 0; child < 8; ++child) {
      each_part_in(fine_.cells, child_of(cell, child),
                   [&](std::uint32_t i) { parts.push_back(i); });
    }
    std::vector<std::uint32_t> set = each_by_itself(parts.size());
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
      for (std::uint32_t j = 0; j < i; ++j) {
        if (fine_.cells.linked(parts[i], parts[j])) join(set, i, j);
      }
    }
    std::vector<std::uint32_t> coarse;
    each_part_in(coarse_.cells, cell, [&](std::uint32_t i) { coarse.push_back(i); });
    std::vector<std::vector<int>> seen;  // by coarser part: its samples in each set
    for (const std::uint32_t i : coarse) {
      seen.emplace_back(parts.size(), 0);
      for (std::uint64_t left = coarse_.cells.parts[i].inside; left != 0; left &= left - 1) {
        const std::size_t at =
            part_with(cell, places_[static_cast<std::size_t>(std::countr_zero(left))], parts);
        if (at < parts.size()) ++seen.back()[root_of(set, static_cast<std::uint32_t>(at))];
      }
    }
    for (std::uint32_t n = 0; n < parts.size(); ++n) {
      const std::uint32_t root = root_of(set, n);
      std::uint32_t& parent = parent_[parts[n]];
      parent = kNoPart;
      int most = 0;
      for (std::size_t k = 0; k < coarse.size(); ++k) {
        const int here = seen[k][root], best = *std::ranges::max_element(seen[k]);
        const bool is_apart =
            apart_.apart(fine_.cells.parts[parts[n]].sides, coarse_.cells.parts[coarse[k]].sides);
        if (is_apart || here <= most || here < std::min(kLeastPart, best)) continue;
        most = here;
        parent = coarse[k];
      }
    }
  }

  static CellPlace child_of(const CellPlace& cell, std::uint32_t child) {
    return {2 * cell.x + (child & 1U), 2 * cell.y + (child >> 1U & 1U), 2 * cell.z + (child >> 2U)};
  }

  // The index in `parts` (finer parts in a coarser cell) of the part that owns a place in that
  // cell; parts.size() if none does.
  std::size_t part_with(const CellPlace& cell, Vec place,
                        const std::vector<std::uint32_t>& parts) const {
    std::uint32_t child = 0, quarter = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
      const auto eighth = std::min(7U, static_cast<std::uint32_t>(8 * place[axis]));
      child = 2 * child + eighth / 4;
      quarter = 4 * quarter + eighth % 4;
    }
    const CellPlace at = child_of(cell, child);
    std::size_t i = 0;
    while (i < parts.size()) {
      const CellPart& part = fine_.cells.parts[parts[i]];
      if (same_cell(fine_.cells.place_of(part.cell), at) && (part.quarters >> quarter & 1U) != 0)
        break;
      ++i;
    }
    return i;
  }

  const NodeGroups& fine_;
  const SamplePlaces& places_;
  const ApartOwners& apart_;
  NodeGroups& coarse_;
  std::vector<std::uint32_t> parent_;
};

}  // namespace

std::vector<GroupHangs> hang_groups(const NodeGroups& fine, const SamplePlaces& places,
                                    const ApartOwners& apart, NodeGroups& coarse_io) {
  return Hanging(fine, places, apart, coarse_io).find();
}

}  // namespace stylet::offline
