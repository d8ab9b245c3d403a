// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/sheets.h"

#include <bit>
#include <deque>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "base/refusal.h"
#include "stylet/levels.h"
#include "stylet/limits.h"
#include "voxels/hanging.h"
#include "voxels/levels.h"
#include "voxels/part_hanging.h"
#include "voxels/piece_sheets.h"

namespace stylet::offline {
namespace {

bool comes_before(const GroupHangs& a, const GroupHangs& b) {
  return std::tie(a.node.z, a.node.y, a.node.x, a.group) <
         std::tie(b.node.z, b.node.y, b.node.x, b.group);
}

// One level. `around` has its voxels and cells beyond them; without it, the voxels are all there
// is.
class LevelSplitter {
 public:
  LevelSplitter(Claims& claims, const SamplePlaces& places, Lattice lattice,
                std::optional<Lattice> around, const Connections& connections)
      : any_apart_(connections.apart.any()),
        sheet_of_side_(sheets_of_sides(connections.apart)),
        lattice_(std::move(lattice)),
        around_(std::move(around)),
        groups_(claims, places, around_ ? *around_ : lattice_, connections),
        cells_(groups_.cells) {
    for (CellPart& part : cells_.parts) {
      part.is_voxel = lattice_.voxel_of_cell[part.cell] != kNoVoxel;
    }
    for (CellPart& part : cells_.parts) part.is_beside = part.is_voxel || is_beside_voxel(part);
    remove_strays(claims);
  }
  LevelSplitter(const LevelSplitter&) = delete;

  NodeGroups& groups() { return groups_; }
  std::uint32_t sheets() const { return sheets_; }

  // Where every cell has one part.
  Lattice unsplit() {
    for (const CellPart& part : cells_.parts) name_side(part);
    return std::move(lattice_);
  }

  // The groups of nodes are known, and what they hang on.
  void choose_voxels(std::vector<GroupHangs> hangs) {
    hangs_ = std::move(hangs);
    merge_parts();
    choose_sheets();
  }

  // Sheets and their rows are those of all levels.
  Lattice split(std::uint32_t sheets, std::uint32_t sheet_rows, const LevelSplitter* coarser) {
    lattice_.sheets = sheets;
    lattice_.sheet_rows = sheet_rows;
    tie_nodes();
    lattice_.hanging.emplace();
    if (coarser != nullptr) hang_nodes(*coarser);
    number_voxels();
    return std::move(lattice_);
  }

 private:
  void name_side(const CellPart& part) {
    if (any_apart_ && part.is_voxel) lattice_.sides.push_back(part.sides);
  }

  bool is_beside_voxel(const CellPart& part) const {
    bool any = false;
    for (int n = 0; n < 27 && !any; ++n) {
      cells_.each_part(cells_.place_of(part.cell), step_of(n),
                       [&](std::uint32_t i) { any = any || cells_.parts[i].is_voxel; });
    }
    return any;
  }

  void remove_strays(Claims& claims) {
    std::unordered_map<std::uint32_t, std::uint64_t> stray;
    for (const CellParts::Stray& each : cells_.strays) stray[each.cell] |= each.samples;
    std::erase_if(stray, [&](const auto& each) {  // in voxels of another level they are its own
      return lattice_.voxel_of_cell[each.first] == kNoVoxel;
    });
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
        merged_as_.push_back(static_cast<std::uint32_t>(same - merged.begin()));
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
    for (CellPart& part : cells_.parts) {
      if (part.is_voxel && !part.crowded) part.sheet = wanted_sheet(part);
    }
    sheets_ = 1 + *std::ranges::max_element(sheet_of_side_);
    for (CellPart& part : cells_.parts) {
      if (part.sheet != kNoSheet || !part.is_voxel) continue;
      std::vector<int> votes(sheets_ + 1, 0);
      votes[sheets_] = -1;  // a new sheet only if no other is allowed
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
      sheets_ = std::max(sheets_, part.sheet + 1);
    }
  }

  // ---- the lattice ------------------------------------------------------------------------------

  std::uint16_t row_of(const CellPlace& at, std::uint32_t sheet) const {
    return static_cast<std::uint16_t>(at.y + sheet * lattice_.sheet_rows);
  }

  void number_voxels() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < cells_.parts.size(); ++i) {
      if (cells_.parts[i].is_voxel) order.push_back(i);
    }
    const auto key = [&](std::uint32_t i) {
      const CellPlace at = cells_.place_of(cells_.parts[i].cell);
      return std::make_tuple(at.z, row_of(at, cells_.parts[i].sheet), at.x);
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
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

  // The sheets of the parts at a node, with their groups, sorted.
  std::vector<std::pair<std::uint8_t, std::uint32_t>> sheets_at(const CellPlace& node) const {
    std::vector<std::pair<std::uint8_t, std::uint32_t>> seen;
    for (const AtNode& each : groups_.around(node)) {
      const CellPart& part = cells_.parts[each.part];
      if (part.is_voxel) seen.emplace_back(part.group[each.corner], part.sheet);
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    return seen;
  }

  void tie_nodes() {
    const auto is_beside = [](const CellPart& part) { return part.is_voxel && part.sheet > 0; };
    groups_.each_node(is_beside, [&](const CellPlace& node) {
      const auto seen = sheets_at(node);
      std::uint32_t root = 0;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const auto [group, sheet] = seen[i];
        const bool is_root = i == 0 || group != seen[i - 1].first;
        if (is_root) root = sheet;
        const GroupHangs own = {node, group, kNoPart};
        if (is_root || std::ranges::binary_search(hangs_, own, comes_before)) continue;
        lattice_.ties.push_back({static_cast<std::uint16_t>(node.x), row_of(node, sheet),
                                 static_cast<std::uint16_t>(node.z), row_of(node, root)});
      }
    });
    sort_by_place(lattice_.ties);
  }

  void hang_nodes(const LevelSplitter& coarser) {
    const auto u16 = [](std::uint32_t value) { return static_cast<std::uint16_t>(value); };
    for (const GroupHangs& each : hangs_) {
      const CellPart& on = coarser.cells_.parts[coarser.merged_as_[each.on]];
      const CellPlace cell = coarser.cells_.place_of(on.cell);
      for (const auto& [group, sheet] : sheets_at(each.node)) {
        if (group != each.group) continue;
        lattice_.hanging->push_back({u16(each.node.x), row_of(each.node, sheet), u16(each.node.z),
                                     u16(cell.x), row_of(cell, on.sheet), u16(cell.z)});
      }
    }
    sort_by_place(*lattice_.hanging);
  }

  template <typename Node>
  static void sort_by_place(std::vector<Node>& nodes) {
    std::sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) {
      return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    });
  }

  static constexpr int kRefused = -2;

  bool any_apart_;
  std::vector<std::uint32_t> sheet_of_side_;
  Lattice lattice_;
  std::optional<Lattice> around_;
  NodeGroups groups_;
  CellParts& cells_;
  std::uint32_t sheets_ = 1;
  std::vector<GroupHangs> hangs_;
  std::vector<std::uint32_t> merged_as_;  // of each part before parts were merged
};

// The cells of a level that are four cells or less from one of its voxels. Parts up to two cells
// from a voxel are asked what they are connected with, and each answer depends on cells up to two
// away from the part.
std::optional<Lattice> around_voxels(Claims& claims, const Lattice& lattice,
                                     std::vector<std::uint8_t> gone) {
  constexpr int kAround = 4;
  const Grid& grid = lattice.grid;
  std::vector<std::uint8_t> left_out(cell_count(grid), 1);
  for (const std::uint32_t cell : lattice.cell_of_voxel) {
    const std::uint32_t x = cell % grid.size[0], row = cell / grid.size[0];
    const std::array<std::uint32_t, 3> at = {x, row % grid.size[1], row / grid.size[1]};
    std::array<std::uint32_t, 3> low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = at[axis] < kAround ? 0 : at[axis] - kAround;
      high[axis] = std::min(grid.size[axis], at[axis] + kAround + 1);
    }
    for (std::uint32_t z = low[2]; z < high[2]; ++z) {
      for (std::uint32_t y = low[1]; y < high[1]; ++y) {
        const std::size_t begin = cell_index(grid, low[0], y, z);
        std::fill_n(left_out.begin() + static_cast<std::ptrdiff_t>(begin), high[0] - low[0],
                    std::uint8_t{0});
      }
    }
  }
  for (std::size_t i = 0; i < gone.size(); ++i) left_out[i] |= gone[i];
  return make_lattice(claims, {}, left_out);
}

// Sheets and rows of all levels.
void require_few(std::span<const Lattice> levels, const char* asked_by) {
  const std::uint64_t sheets = levels[0].sheets, rows = lattice_size(levels).rows;
  const std::uint64_t planes = lattice_size(levels).z;
  if (sheets <= kMaxSheets && rows * sheets <= 65535 && rows * sheets * planes <= kMaxRows) return;
  refuse<TooFine>(
      "{}: {} sheets of {} x {} rows: expected {} sheets and {} rows at most: choose another "
      "voxel edge",
      asked_by, sheets, rows, planes, kMaxSheets, kMaxRows);
}

}  // namespace

std::vector<Lattice> split_parts(std::vector<Claims>& levels, const SamplePlaces& places,
                                 std::vector<Lattice> lattices,
                                 const std::vector<std::uint8_t>& cut,
                                 const Connections& connections) {
  const auto count = static_cast<std::uint32_t>(lattices.size());
  std::deque<LevelSplitter> split;
  bool any_crowded = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::optional<Lattice> around;
    if (count > 1) {
      around = around_voxels(levels[i], lattices[i], inherited(cut, lattices[i].grid, i));
    }
    split.emplace_back(levels[i], places, std::move(lattices[i]), std::move(around), connections);
    any_crowded = split.back().groups().find_crowded() || any_crowded;
  }
  const char* const asked_by = connections.gaps_part ? "--split-gaps" : "--slide";
  if (!any_crowded) {
    for (std::uint32_t i = 0; i < count; ++i) lattices[i] = split[i].unsplit();
    if (count > 1) keep_pieces_apart(lattices);
    require_few(lattices, asked_by);
    return lattices;
  }
  for (LevelSplitter& level : split) level.groups().find_groups();
  std::vector<std::vector<GroupHangs>> hangs(count);
  for (std::uint32_t i = count; i-- > 1;) {
    hangs[i] = hang_groups(split[i].groups(), places, connections.apart, split[i - 1].groups());
  }
  std::uint32_t sheets = 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    split[i].choose_voxels(std::move(hangs[i]));
    sheets = std::max(sheets, split[i].sheets());
  }
  const std::uint32_t space = levels[count - 1].grid.size[1];
  for (std::uint32_t i = 0; i < count; ++i) {
    lattices[i] =
        split[i].split(sheets, sheets == 1 ? space : space + 1, i > 0 ? &split[i - 1] : nullptr);
  }
  require_few(lattices, asked_by);  // rows have 16 bits
  if (count > 1) {
    keep_pieces_apart(lattices);
    require_few(lattices, asked_by);
  }
  const std::size_t voxels = voxel_count(lattices);
  if (voxels > kMaxVoxels) {
    refuse<TooFine>("{}: {} voxels: expected at most {}: choose a larger voxel edge", asked_by,
                    voxels, kMaxVoxels);
  }
  return lattices;
}

}  // namespace stylet::offline
