// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/piece_sheets.h"

#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

#include "base/disjoint_set.h"
#include "stylet/levels.h"
#include "stylet/limits.h"
#include "voxels/hanging.h"

namespace stylet::offline {
namespace {

using Sheets = std::map<std::uint32_t, std::uint32_t>;  // of a piece: its sheets now and then

class Pieces {
 public:
  // A lattice of one sheet has no empty row behind its last one; as soon as there are several
  // sheets, each needs one.
  explicit Pieces(std::vector<Lattice>& levels)
      : levels_(levels),
        rows_(std::max(levels[0].sheet_rows, levels.back().grid.size[1] + 1)),
        hanging_(levels.size()) {
    list_hanging();
    for (const Lattice& level : levels_) {
      before_.push_back(static_cast<std::uint32_t>(run_of_.size()));
      for (const OrganRun& run : level.runs) {
        for (std::uint32_t i = 0; i < run.count; ++i) {
          run_of_.push_back({static_cast<std::uint16_t>(run.x + i), run.y, run.z, 1});
        }
      }
    }
    before_.push_back(static_cast<std::uint32_t>(run_of_.size()));
    piece_ = each_by_itself(run_of_.size());
    join_at_nodes();
    for (std::uint32_t i = 0; i < piece_.size(); ++i) piece_[i] = root_of(piece_, i);
  }

  void keep_apart() {
    const std::map<std::uint32_t, std::set<std::uint32_t>> near = near_each_other();
    if (near.empty()) return;
    choose_sheets(near);
    std::uint32_t sheets = 1;
    for (const auto& [piece, of_piece] : sheets_) {
      for (const auto& [now, then] : of_piece) sheets = std::max(sheets, then + 1);
    }
    if (sheets == 1) return;
    for (std::uint32_t level = 0; level < levels_.size(); ++level) {
      move_rows(level);
      levels_[level].sheets = sheets;
      levels_[level].sheet_rows = rows_;
    }
  }

 private:
  std::uint64_t node_key(std::uint32_t level, std::uint32_t x, std::uint32_t row,
                         std::uint32_t z) const {
    return (std::uint64_t{level} << 60U) | (std::uint64_t{z} << 40U) | (std::uint64_t{row} << 20U) |
           x;
  }

  // What hangs at each level, in the level's own places.
  void list_hanging() {
    const std::uint32_t planes = levels_[0].grid.size[2];
    for (OrganHanging each : hanging_nodes(levels_)) {
      const std::uint32_t level = level_of(planes, each.z);
      each.z = static_cast<std::uint16_t>(each.z - first_plane(planes, level));
      each.voxel_z = static_cast<std::uint16_t>(each.voxel_z - first_plane(planes, level - 1));
      hanging_[level].push_back(each);
    }
  }

  void join_at_nodes() {
    for (std::uint32_t level = 0; level < levels_.size(); ++level) {
      for (std::uint32_t i = before_[level]; i < before_[level + 1]; ++i) {
        const OrganRun& at = run_of_[i];
        for (std::uint32_t c = 0; c < 8; ++c) {
          const std::uint64_t key =
              node_key(level, at.x + (c & 1U), at.y + (c >> 1U & 1U), at.z + (c >> 2U));
          const auto [found, is_new] = voxel_at_.try_emplace(key, i);
          if (!is_new) join(piece_, i, found->second);
        }
      }
      for (const OrganTie& tie : levels_[level].ties) {
        join(piece_, voxel_at_.at(node_key(level, tie.x, tie.y, tie.z)),
             voxel_at_.at(node_key(level, tie.x, tie.to_y, tie.z)));
      }
      for (const OrganHanging& h : hanging_[level]) {
        join(piece_, voxel_at_.at(node_key(level, h.x, h.y, h.z)),
             voxel_at_.at(node_key(level - 1, h.voxel_x, h.voxel_y, h.voxel_z)));
      }
    }
  }

  // The pieces with finer voxels in touching cells of level 0.
  std::map<std::uint32_t, std::set<std::uint32_t>> near_each_other() const {
    const auto& size = levels_[0].grid.size;
    std::map<std::array<std::uint32_t, 3>, std::set<std::uint32_t>> in_cell;
    for (std::uint32_t level = 1; level < levels_.size(); ++level) {
      for (std::uint32_t i = before_[level]; i < before_[level + 1]; ++i) {
        const OrganRun& at = run_of_[i];
        const std::uint32_t x = at.x, y = at.y % rows_, z = at.z;
        in_cell[{x >> level, y >> level, z >> level}].insert(piece_[i]);
      }
    }
    std::map<std::uint32_t, std::set<std::uint32_t>> near;
    for (const auto& [cell, pieces] : in_cell) {
      for (std::uint32_t n = 0; n < 27; ++n) {
        // An index below 0 wraps to one beyond the size.
        const std::array<std::uint32_t, 3> other = {cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1,
                                                    cell[2] + n / 9 - 1};
        if (other[0] >= size[0] || other[1] >= size[1] || other[2] >= size[2]) continue;
        const auto found = in_cell.find(other);
        if (found == in_cell.end()) continue;
        for (const std::uint32_t one : pieces) {
          for (const std::uint32_t two : found->second) {
            if (one != two) near[one].insert(two);
          }
        }
      }
    }
    return near;
  }

  // The largest pieces choose first; each takes the first sheets that no piece near it has.
  void choose_sheets(const std::map<std::uint32_t, std::set<std::uint32_t>>& near) {
    std::map<std::uint32_t, std::size_t> voxels;
    for (std::uint32_t i = 0; i < piece_.size(); ++i) {
      ++voxels[piece_[i]];
      sheets_[piece_[i]][run_of_[i].y / rows_] = 0;
    }
    std::vector<std::uint32_t> order;
    for (const auto& [piece, count] : voxels) order.push_back(piece);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return voxels[a] > voxels[b]; });
    std::set<std::uint32_t> done;
    for (const std::uint32_t piece : order) {
      std::set<std::uint32_t> taken;
      if (const auto found = near.find(piece); found != near.end()) {
        for (const std::uint32_t other : found->second) {
          if (!done.contains(other)) continue;
          for (const auto& [now, then] : sheets_[other]) taken.insert(then);
        }
      }
      choose_sheets_of(sheets_[piece], taken);
      done.insert(piece);
    }
  }

  // In rising order, so that ties still lead to earlier sheets.
  static void choose_sheets_of(Sheets& own, const std::set<std::uint32_t>& taken) {
    std::uint32_t next = 0;
    for (auto& [now, then] : own) {
      while (taken.contains(next)) ++next;
      then = next++;
    }
    if (next <= kMaxSheets) return;
    for (auto& [now, then] : own) then = now;
  }

  std::uint16_t new_row(std::uint32_t voxel, std::uint32_t row) const {
    const std::uint32_t sheet = row / rows_;
    return static_cast<std::uint16_t>(row % rows_ + sheets_.at(piece_[voxel]).at(sheet) * rows_);
  }
  std::uint16_t new_node_row(std::uint32_t level, std::uint32_t x, std::uint32_t row,
                             std::uint32_t z) const {
    return new_row(voxel_at_.at(node_key(level, x, row, z)), row);
  }

  void move_rows(std::uint32_t level) {
    Lattice& lattice = levels_[level];
    for (OrganTie& tie : lattice.ties) {
      const std::uint16_t to = new_node_row(level, tie.x, tie.to_y, tie.z);
      tie.y = new_node_row(level, tie.x, tie.y, tie.z);
      tie.to_y = to;
    }
    for (OrganHanging& h : hanging_[level]) {
      h.y = new_node_row(level, h.x, h.y, h.z);
      h.voxel_y = new_node_row(level - 1, h.voxel_x, h.voxel_y, h.voxel_z);
    }
    sort_by_place(lattice.ties);
    sort_by_place(hanging_[level]);
    lattice.hanging = hanging_[level];
    move_voxels(level);
  }

  template <typename Place>
  static void sort_by_place(std::vector<Place>& places) {
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
      return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    });
  }

  // Voxels are numbered by place.
  void move_voxels(std::uint32_t level) {
    Lattice& lattice = levels_[level];
    std::vector<std::uint32_t> order;
    std::map<std::array<std::uint32_t, 3>, std::uint16_t> row_of_part;
    for (std::uint32_t i = before_[level]; i < before_[level + 1]; ++i) {
      OrganRun& at = run_of_[i];
      const std::uint16_t row = new_row(i, at.y);
      row_of_part[{at.x, at.y, at.z}] = row;
      at.y = row;
      order.push_back(i);
    }
    for (OrganPart& part : lattice.parts) part.y = row_of_part.at({part.x, part.y, part.z});
    sort_by_place(lattice.parts);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const OrganRun &one = run_of_[a], &two = run_of_[b];
      return std::tie(one.z, one.y, one.x) < std::tie(two.z, two.y, two.x);
    });
    const Lattice old = lattice;
    std::vector<std::uint32_t> number(order.size());
    lattice.runs.clear();
    for (std::uint32_t voxel = 0; voxel < order.size(); ++voxel) {
      const std::uint32_t from = order[voxel] - before_[level];
      number[from] = voxel;
      lattice.cell_of_voxel[voxel] = old.cell_of_voxel[from];
      lattice.fill[voxel] = old.fill[from];
      if (!old.sides.empty()) lattice.sides[voxel] = old.sides[from];
      add_voxel(lattice.runs, run_of_[order[voxel]]);
    }
    for (SharedCell& each : lattice.shared) each.voxel = number[each.voxel];
    std::ranges::sort(lattice.shared, {},
                      [](const SharedCell& each) { return std::pair(each.cell, each.voxel); });
    for (std::uint32_t voxel = 0; voxel < order.size(); ++voxel) {
      lattice.voxel_of_cell[lattice.cell_of_voxel[voxel]] = voxel;
    }
  }

  static void add_voxel(std::vector<OrganRun>& runs, const OrganRun& voxel) {
    const bool goes_on = !runs.empty() && runs.back().z == voxel.z && runs.back().y == voxel.y &&
                         std::uint32_t{runs.back().x} + runs.back().count == voxel.x;
    if (goes_on) {
      ++runs.back().count;
    } else {
      runs.push_back(voxel);
    }
  }

  std::vector<Lattice>& levels_;
  std::uint32_t rows_;
  std::vector<std::vector<OrganHanging>> hanging_;
  std::vector<std::uint32_t> before_;                          // voxels of the levels before
  std::vector<OrganRun> run_of_;                               // of each voxel alone
  std::vector<std::uint32_t> piece_;                           // of each voxel: one of its voxels
  std::unordered_map<std::uint64_t, std::uint32_t> voxel_at_;  // with a corner at a node
  std::map<std::uint32_t, Sheets> sheets_;                     // by piece
};

}  // namespace

void keep_pieces_apart(std::vector<Lattice>& levels) {
  Pieces(levels).keep_apart();
}

}  // namespace stylet::offline
