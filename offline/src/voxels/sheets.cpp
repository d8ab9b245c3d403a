// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/sheets.h"

#include <bit>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "base/disjoint_set.h"
#include "base/refusal.h"
#include "stylet/limits.h"
#include "voxels/cell_parts.h"

namespace stylet::offline {
namespace {

class Splitter {
 public:
  Splitter(Claims& claims, const SamplePlaces& places, Lattice lattice,
           const Connections& connections)
      : asked_by_(connections.gaps_part ? "--split-gaps" : "--slide"),
        any_apart_(connections.apart.any()),
        sheet_of_side_(sheets_of_sides(connections.apart)),
        lattice_(std::move(lattice)),
        cells_(claims, places, lattice_, connections) {
    remove_strays(claims);
  }

  Lattice split() {
    if (!find_crowded()) {
      for (const CellPart& part : cells_.parts) name_side(part);  // each voxel has one
      return std::move(lattice_);
    }
    find_groups();
    merge_parts();
    choose_sheets();
    tie_nodes();
    number_voxels();  // last, because it renumbers the voxels
    return std::move(lattice_);
  }

 private:
  void name_side(const CellPart& part) {
    if (any_apart_) lattice_.sides.push_back(part.sides);
  }

  void remove_strays(Claims& claims) {
    std::unordered_map<std::uint32_t, std::uint64_t> stray;
    for (const CellParts::Stray& each : cells_.strays) stray[each.cell] |= each.samples;
    for (const auto& [cell, samples] : stray) {
      claims.inside[cell] &= ~samples;
      claims.owner_fill[cell] = 0;
      lattice_.fill[lattice_.voxel_of_cell[cell]] = fill_of(claims.inside[cell]);
    }
    std::unordered_map<std::uint32_t, int> priority;  // of the best owner so far
    for (Claims::Share& share : claims.shares) {
      const auto found = stray.find(share.cell);
      if (found == stray.end()) continue;
      share.inside &= ~found->second;
      const auto left = static_cast<std::uint8_t>(std::popcount(share.inside));
      const int best = priority.try_emplace(share.cell, share.priority).first->second;
      std::uint8_t& most = claims.owner_fill[share.cell];
      if (left == 0 || (most > 0 && std::tie(share.priority, left) <= std::tie(best, most))) {
        continue;
      }
      claims.owner[share.cell] = share.owner;
      priority[share.cell] = share.priority;
      most = left;
    }
  }

  bool find_crowded() {
    bool any = false;
    for (std::uint32_t i = 0; i < cells_.parts.size(); ++i) {
      for (int n = 0; n < 27 && !cells_.parts[i].crowded; ++n) {
        cells_.each_part(cells_.place_of(cells_.parts[i].cell), step_of(n), [&](std::uint32_t j) {
          if (cells_.linked(i, j)) return;
          cells_.parts[i].crowded = cells_.parts[j].crowded = any = true;
        });
      }
    }
    return any;
  }

  // ---- nodes ------------------------------------------------------------------------------------

  struct AtNode {
    std::uint32_t part;
    std::uint32_t corner;  // which corner of the part's cell the node is: bits x, y, z
  };

  std::vector<AtNode> around_node(const CellPlace& node) const {
    std::vector<AtNode> around;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      const auto back = [&](std::uint32_t bit) { return (corner >> bit & 1U) != 0 ? -1 : 0; };
      cells_.each_part(node, {back(0), back(1), back(2)}, [&](std::uint32_t i) {
        around.push_back({i, corner});
      });
    }
    return around;
  }

  // Calls visit(node) once for each corner of the parts that `wanted` accepts, sorted by z, then y,
  // then x.
  template <typename Wanted, typename Visit>
  void each_node(Wanted wanted, Visit visit) const {
    std::vector<std::uint64_t> nodes;
    for (const CellPart& part : cells_.parts) {
      if (!wanted(part)) continue;
      const CellPlace at = cells_.place_of(part.cell);
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const std::uint64_t x = at.x + (corner & 1U), y = at.y + (corner >> 1U & 1U);
        nodes.push_back((std::uint64_t{at.z + (corner >> 2U)} << 40U) | (y << 20U) | x);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    constexpr std::uint64_t kBits = (1U << 20U) - 1;
    for (const std::uint64_t node : nodes) {
      visit(CellPlace{static_cast<std::uint32_t>(node & kBits),
                      static_cast<std::uint32_t>(node >> 20U & kBits),
                      static_cast<std::uint32_t>(node >> 40U)});
    }
  }

  void find_groups() {
    const auto is_crowded = [](const CellPart& part) { return part.crowded; };
    each_node(is_crowded, [&](const CellPlace& node) {
      const std::vector<AtNode> around = around_node(node);
      std::vector<std::uint32_t> parent = each_by_itself(around.size());
      for (std::uint32_t i = 0; i < around.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
          if (cells_.linked(around[i].part, around[j].part)) join(parent, i, j);
        }
      }
      for (std::uint32_t i = 0; i < around.size(); ++i) {
        cells_.parts[around[i].part].group[around[i].corner] =
            static_cast<std::uint8_t>(root_of(parent, i));
      }
    });
  }

  // Merges parts of a cell that share all their particles into one voxel.
  void merge_parts() {
    std::vector<CellPart> merged;
    std::vector<std::uint32_t> first_merged;
    for (std::size_t voxel = 0; voxel + 1 < cells_.first.size(); ++voxel) {
      first_merged.push_back(static_cast<std::uint32_t>(merged.size()));
      for (std::uint32_t i = cells_.first[voxel]; i < cells_.first[voxel + 1]; ++i) {
        const auto same = std::find_if(
            merged.begin() + first_merged.back(), merged.end(),
            [&](const CellPart& before) { return before.group == cells_.parts[i].group; });
        if (same == merged.end()) {
          merged.push_back(cells_.parts[i]);
        } else {
          same->inside |= cells_.parts[i].inside;
          same->quarters |= cells_.parts[i].quarters;
          same->sides |= cells_.parts[i].sides;
        }
      }
    }
    first_merged.push_back(static_cast<std::uint32_t>(merged.size()));
    cells_.parts = std::move(merged);
    cells_.first = std::move(first_merged);
  }

  // ---- sheets -----------------------------------------------------------------------------------

  // Whether two parts may be in one sheet, where parts share all nodes between them.
  bool may_share_sheet(const CellPart& a, const CellPart& b) const {
    const CellStep step = cells_.between(a, b);
    if (a.cell == b.cell) return false;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      const int x = static_cast<int>(corner & 1U) - step.x;
      const int y = static_cast<int>(corner >> 1U & 1U) - step.y;
      const int z = static_cast<int>(corner >> 2U) - step.z;
      if (std::min({x, y, z}) < 0 || std::max({x, y, z}) > 1) continue;
      const auto in_b = static_cast<std::size_t>(x + 2 * y + 4 * z);
      if (a.group[corner] != b.group[in_b]) return false;
    }
    return true;
  }

  // What slides finds its ground's voxels one beside the other: so sides that are apart have sheets
  // of their own, as few as that takes.
  static std::vector<std::uint32_t> sheets_of_sides(const ApartOwners& apart) {
    std::vector<std::uint32_t> sheet(std::max<std::size_t>(1, apart.apart_from.size()), 0);
    for (std::size_t side = 1; side < sheet.size(); ++side) {
      const auto is_taken = [&](std::uint32_t wanted) {
        for (std::size_t other = 1; other < side; ++other) {
          const bool are_apart = (apart.apart_from[side] >> other & 1U) != 0;
          if (are_apart && sheet[other] == wanted) return true;
        }
        return false;
      };
      while (is_taken(sheet[side])) ++sheet[side];
    }
    return sheet;
  }

  std::uint32_t wanted_sheet(const CellPart& part) const {
    const std::uint32_t sliding = part.sides & ~1U;
    if (!any_apart_ || sliding == 0) return 0;
    return sheet_of_side_[static_cast<std::size_t>(std::countr_zero(sliding))];
  }

  // Puts each part into the sheet that its side wants, or else into that with most of its
  // neighbours, among the sheets allowed for it.
  void choose_sheets() {
    constexpr int kWanted = 1000;  // more than it can have neighbours
    for (CellPart& part : cells_.parts) part.sheet = part.crowded ? kNoSheet : wanted_sheet(part);
    std::uint32_t sheets = 1 + *std::ranges::max_element(sheet_of_side_);
    for (CellPart& part : cells_.parts) {
      if (part.sheet != kNoSheet) continue;
      std::vector<int> votes(sheets + 1, 0);
      votes[sheets] = -1;  // a new sheet only if no other is allowed
      if (any_apart_) votes[wanted_sheet(part)] = kWanted;
      for (int n = 0; n < 27; ++n) {
        cells_.each_part(cells_.place_of(part.cell), step_of(n), [&](std::uint32_t j) {
          const CellPart& other = cells_.parts[j];
          if (&other == &part || other.sheet == kNoSheet || votes[other.sheet] == kRefused) return;
          votes[other.sheet] = may_share_sheet(part, other) ? votes[other.sheet] + 1 : kRefused;
        });
      }
      const auto best = std::max_element(votes.begin(), votes.end());
      part.sheet = static_cast<std::uint32_t>(best - votes.begin());
      sheets = std::max(sheets, part.sheet + 1);
    }
    const std::uint64_t rows = std::uint64_t{lattice_.grid.size[1]} + 1;
    if (sheets > kMaxSheets || rows * sheets > 65535 ||
        rows * sheets * lattice_.grid.size[2] > kMaxRows) {
      refuse<TooFine>(
          "{}: {} sheets of {} x {} rows: expected {} sheets and {} rows at most: choose another "
          "voxel edge",
          asked_by_, sheets, rows, lattice_.grid.size[2], kMaxSheets, kMaxRows);
    }
    lattice_.sheets = sheets;
    lattice_.sheet_rows = sheets == 1 ? lattice_.grid.size[1] : static_cast<std::uint32_t>(rows);
  }

  // ---- the lattice ------------------------------------------------------------------------------

  std::uint16_t row_of(const CellPlace& at, std::uint32_t sheet) const {
    return static_cast<std::uint16_t>(at.y + sheet * lattice_.sheet_rows);
  }

  void number_voxels() {
    std::vector<std::uint32_t> order(cells_.parts.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) {
      const CellPlace at = cells_.place_of(cells_.parts[i].cell);
      return std::make_tuple(at.z, row_of(at, cells_.parts[i].sheet), at.x);
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    if (order.size() > kMaxVoxels) {
      refuse<TooFine>("{}: {} voxels: expected at most {}: choose a larger voxel edge", asked_by_,
                      order.size(), kMaxVoxels);
    }
    std::vector<std::uint32_t> parts_in_cell;
    for (std::size_t voxel = 0; voxel + 1 < cells_.first.size(); ++voxel) {
      for (std::uint32_t i = cells_.first[voxel]; i < cells_.first[voxel + 1]; ++i) {
        parts_in_cell.push_back(cells_.first[voxel + 1] - cells_.first[voxel]);
      }
    }
    lattice_.runs.clear();
    lattice_.fill.clear();
    lattice_.cell_of_voxel.clear();
    for (const std::uint32_t i : order) {
      const CellPart& part = cells_.parts[i];
      const auto voxel = static_cast<std::uint32_t>(lattice_.cell_of_voxel.size());
      add_voxel(lattice_.runs, cells_.place_of(part.cell),
                row_of(cells_.place_of(part.cell), part.sheet));
      lattice_.fill.push_back(fill_of(part.inside));
      name_side(part);
      lattice_.cell_of_voxel.push_back(part.cell);
      lattice_.voxel_of_cell[part.cell] = voxel;
      if (parts_in_cell[i] == 1) continue;
      const CellPlace at = cells_.place_of(part.cell);
      lattice_.parts.push_back({static_cast<std::uint16_t>(at.x), row_of(at, part.sheet),
                                static_cast<std::uint16_t>(at.z), 0, part.quarters});
      lattice_.shared.push_back({part.cell, voxel, part.quarters, part.inside});
    }
    std::sort(lattice_.shared.begin(), lattice_.shared.end(),
              [](const SharedCell& a, const SharedCell& b) {
                return std::tie(a.cell, a.voxel) < std::tie(b.cell, b.voxel);
              });
  }

  static void add_voxel(std::vector<OrganRun>& runs, const CellPlace& at, std::uint16_t row) {
    const bool goes_on = !runs.empty() && runs.back().z == at.z && runs.back().y == row &&
                         std::uint32_t{runs.back().x} + runs.back().count == at.x;
    if (!goes_on) {
      runs.push_back({static_cast<std::uint16_t>(at.x), row, static_cast<std::uint16_t>(at.z), 0});
    }
    ++runs.back().count;
  }

  void tie_nodes() {
    const auto is_beside = [](const CellPart& part) { return part.sheet > 0; };
    each_node(is_beside, [&](const CellPlace& node) {
      std::vector<std::tuple<std::uint8_t, std::uint32_t>> seen;  // group, sheet
      for (const AtNode& each : around_node(node)) {
        seen.emplace_back(cells_.parts[each.part].group[each.corner],
                          cells_.parts[each.part].sheet);
      }
      std::sort(seen.begin(), seen.end());
      seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
      std::uint32_t root = 0;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const auto [group, sheet] = seen[i];
        const bool is_root = i == 0 || group != std::get<0>(seen[i - 1]);
        if (is_root) root = sheet;
        if (is_root) continue;
        lattice_.ties.push_back({static_cast<std::uint16_t>(node.x), row_of(node, sheet),
                                 static_cast<std::uint16_t>(node.z), row_of(node, root)});
      }
    });
    std::sort(lattice_.ties.begin(), lattice_.ties.end(), [](const OrganTie& a, const OrganTie& b) {
      return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    });
  }

  static constexpr int kRefused = -2;

  const char* asked_by_;
  bool any_apart_;
  std::vector<std::uint32_t> sheet_of_side_;
  Lattice lattice_;
  CellParts cells_;
};

}  // namespace

Lattice split_parts(Claims& claims, const SamplePlaces& places, Lattice lattice,
                    const Connections& connections) {
  return Splitter(claims, places, std::move(lattice), connections).split();
}

}  // namespace stylet::offline
