// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/sheets.h"

#include <bit>
#include <numeric>
#include <tuple>

#include "base/disjoint_set.h"
#include "base/refusal.h"
#include "stylet/limits.h"

namespace stylet::bake {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;
constexpr std::uint64_t kFull = ~std::uint64_t{0};

struct Cell {
  std::uint32_t x, y, z;
};

// A step to one of the 26 neighbours, or none.
struct Step {
  int x, y, z;

  std::size_t index() const { return static_cast<std::size_t>(x + 1 + 3 * (y + 1) + 9 * (z + 1)); }
  Vec vec() const { return {1.0 * x, 1.0 * y, 1.0 * z}; }
  bool is_small() const { return std::max({std::abs(x), std::abs(y), std::abs(z)}) <= 1; }
};
constexpr Step step_of(int index) {
  return {index % 3 - 1, index / 3 % 3 - 1, index / 9 - 1};
}
constexpr std::array<Step, 6> kFaces{Step{-1, 0, 0}, Step{1, 0, 0},  Step{0, -1, 0},
                                     Step{0, 1, 0},  Step{0, 0, -1}, Step{0, 0, 1}};

struct Part {
  std::uint32_t cell = 0;
  std::uint32_t host = kNone;  // of one without samples: the part of a neighbour that it hangs on
  std::uint32_t sheet = kNone;
  bool crowded = false;      // a neighbour is apart from it
  std::uint64_t inside = 0;  // samples
  std::uint64_t quarters = kFull;
  std::array<std::uint8_t, 8> group{};  // at each corner: parts with the same share the particle
};

class Splitter {
 public:
  Splitter(const Claims& claims, const SamplePlaces& places, Lattice lattice)
      : claims_(claims), places_(places), lattice_(std::move(lattice)) {
    for (int i = 0; i < 27; ++i) {
      const Step step = step_of(i);
      near_[step.index()] = near_samples(places, step.vec(), kReach);
    }
  }

  Lattice split() {
    find_parts();
    settle_specks();
    find_empty_parts();
    if (!find_crowded()) return std::move(lattice_);
    find_groups();
    merge_parts();
    choose_sheets();
    tie_nodes();
    number_voxels();  // last: the voxels found so far lose their numbers
    return std::move(lattice_);
  }

 private:
  // ---- places -----------------------------------------------------------------------------------

  Cell place_of(std::uint32_t cell) const {
    const auto& size = lattice_.grid.size;
    return {cell % size[0], cell / size[0] % size[1], cell / size[0] / size[1]};
  }

  Step between(const Part& a, const Part& b) const {
    const Cell from = place_of(a.cell), to = place_of(b.cell);
    const auto step = [](std::uint32_t f, std::uint32_t t) {
      return static_cast<int>(t) - static_cast<int>(f);
    };
    return {step(from.x, to.x), step(from.y, to.y), step(from.z, to.z)};
  }

  // Calls visit(number) for the parts of the cell a step away.
  template <typename Visit>
  void each_part(const Cell& from, const Step& step, Visit visit) const {
    const auto& size = lattice_.grid.size;
    const auto x = from.x + static_cast<std::uint32_t>(step.x);  // below 0: beyond the size
    const auto y = from.y + static_cast<std::uint32_t>(step.y);
    const auto z = from.z + static_cast<std::uint32_t>(step.z);
    if (x >= size[0] || y >= size[1] || z >= size[2]) return;
    const std::uint32_t voxel = lattice_.voxel_of_cell[cell_index(lattice_.grid, x, y, z)];
    if (voxel == kNoVoxel) return;
    for (std::uint32_t i = first_[voxel]; i < first_[voxel + 1]; ++i) visit(i);
  }

  // ---- parts ------------------------------------------------------------------------------------

  std::size_t nearest(const std::vector<std::uint64_t>& parts, Vec place) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < parts.size(); ++i) {
      if (distance_to(parts[i], places_, {}, place) < distance_to(parts[best], places_, {}, place))
        best = i;
    }
    return best;
  }

  // Bits of the quarters of a cell for which choose(centre) is each of `count` numbers.
  template <typename Choose>
  static std::vector<std::uint64_t> divide(std::size_t count, Choose choose) {
    std::vector<std::uint64_t> quarters(count, 0);
    for (std::uint32_t q = 0; q < 64; ++q) {
      const Vec centre = Vec{q % 4 + 0.5, q / 4 % 4 + 0.5, q / 16 + 0.5} * 0.25;
      quarters[choose(centre)] |= std::uint64_t{1} << q;
    }
    return quarters;
  }

  void find_parts() {
    constexpr std::size_t kHere = 13;
    for (const std::uint32_t cell : lattice_.cell_of_voxel) {
      first_.push_back(static_cast<std::uint32_t>(parts_.size()));
      const std::uint64_t bits = claims_.inside[cell];
      if (bits == 0 || bits == kFull) {
        parts_.push_back({cell, kNone, kNone, false, bits, kFull, {}});
        continue;
      }
      for (const std::uint64_t part : connected_parts(bits, near_[kHere])) {
        parts_.push_back({cell, kNone, kNone, false, part, kFull, {}});
      }
    }
    first_.push_back(static_cast<std::uint32_t>(parts_.size()));
  }

  // Specks that hang together with a larger part of their cell, or with nothing, go to one.
  std::vector<Part> settled(std::size_t voxel) const {
    std::vector<Part> parts(parts_.begin() + first_[voxel], parts_.begin() + first_[voxel + 1]);
    if (parts.size() == 1) return parts;
    const Block block = block_around(parts[0].cell);
    std::vector<std::uint32_t> order(parts.size());
    std::iota(order.begin(), order.end(), first_[voxel]);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::popcount(parts_[a].inside) > std::popcount(parts_[b].inside);
    });
    std::vector<std::uint64_t> kept;
    std::vector<std::uint32_t> kept_set;
    for (const std::uint32_t i : order) {
      const std::uint64_t inside = parts_[i].inside;
      const std::uint32_t set = set_of(block, i);
      const auto same = std::find(kept_set.begin(), kept_set.end(), set);
      const bool is_alone = std::count(block.set.begin(), block.set.end(), set) == 1;
      if (kept.empty() || std::popcount(inside) >= kLeastPart ||
          (same == kept_set.end() && !is_alone)) {
        kept.push_back(inside);
        kept_set.push_back(set);
      } else if (same != kept_set.end()) {
        kept[static_cast<std::size_t>(same - kept_set.begin())] |= inside;
      } else {
        kept[nearest(kept, places_[static_cast<unsigned>(std::countr_zero(inside))])] |= inside;
      }
    }
    const auto quarters = divide(kept.size(), [&](Vec centre) { return nearest(kept, centre); });
    parts.resize(kept.size(), parts[0]);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      parts[i].inside = kept[i];
      parts[i].quarters = quarters[i];
    }
    return parts;
  }

  void settle_specks() {
    std::vector<Part> parts;
    std::vector<std::uint32_t> first;
    for (std::size_t voxel = 0; voxel + 1 < first_.size(); ++voxel) {
      first.push_back(static_cast<std::uint32_t>(parts.size()));
      for (const Part& part : settled(voxel)) parts.push_back(part);
    }
    first.push_back(static_cast<std::uint32_t>(parts.size()));
    parts_ = std::move(parts);
    first_ = std::move(first);
  }

  // A cell that holds surface but no sample: a part for each of what its neighbours hold apart.
  void find_empty_parts() {
    std::vector<Part> parts;
    std::vector<std::uint32_t> first, renumbered(parts_.size(), kNone);
    for (std::size_t voxel = 0; voxel + 1 < first_.size(); ++voxel) {
      first.push_back(static_cast<std::uint32_t>(parts.size()));
      const Part& part = parts_[first_[voxel]];
      if (part.inside == 0) {
        for (const Part& each : empty_parts(part)) parts.push_back(each);
        continue;
      }
      for (std::uint32_t i = first_[voxel]; i < first_[voxel + 1]; ++i) {
        renumbered[i] = static_cast<std::uint32_t>(parts.size());
        parts.push_back(parts_[i]);
      }
    }
    first.push_back(static_cast<std::uint32_t>(parts.size()));
    for (Part& part : parts) {
      if (part.host != kNone) part.host = renumbered[part.host];
    }
    parts_ = std::move(parts);
    first_ = std::move(first);
  }

  std::vector<Part> empty_parts(const Part& empty) const {
    std::vector<std::uint32_t> around;
    for (const Step& face : kFaces) {
      each_part(place_of(empty.cell), face, [&](std::uint32_t i) {
        if (parts_[i].inside != 0) around.push_back(i);
      });
    }
    if (around.empty()) return {empty};
    const Block block = block_around(empty.cell);
    std::vector<std::uint32_t> sets, hosts;  // and the fullest part of each
    std::vector<std::size_t> number;         // of the set of each part around
    for (const std::uint32_t i : around) {
      const std::uint32_t set = set_of(block, i);
      const auto known = std::find(sets.begin(), sets.end(), set);
      number.push_back(static_cast<std::size_t>(known - sets.begin()));
      if (known == sets.end()) {
        sets.push_back(set);
        hosts.push_back(i);
      }
      std::uint32_t& host = hosts[number.back()];
      if (std::popcount(parts_[i].inside) > std::popcount(parts_[host].inside)) host = i;
    }
    const auto quarters = divide(hosts.size(), [&](Vec centre) {
      const auto away = [&](std::uint32_t i) {
        return distance_to(parts_[i].inside, places_, between(empty, parts_[i]).vec(), centre);
      };
      const auto best =
          std::min_element(around.begin(), around.end(),
                           [&](std::uint32_t a, std::uint32_t b) { return away(a) < away(b); });
      return number[static_cast<std::size_t>(best - around.begin())];
    });
    std::vector<Part> parts(hosts.size(), empty);
    for (std::size_t i = 0; i < hosts.size(); ++i) {
      parts[i].host = hosts[i];
      parts[i].quarters = quarters[i];
    }
    return parts;
  }

  // ---- what hangs together ----------------------------------------------------------------------

  // Parts of neighbouring cells, with samples.
  bool touch(const Part& a, const Part& b) const {
    if (a.inside == kFull && b.inside == kFull) return true;
    return (reached(a.inside, near_[between(a, b).index()]) & b.inside) != 0;
  }

  // The parts with samples in the 27 cells around one, and which of them hang together there.
  struct Block {
    std::vector<std::uint32_t> part, set;
  };

  Block block_around(std::uint32_t cell) const {
    Block block;
    for (int n = 0; n < 27; ++n) {
      each_part(place_of(cell), step_of(n), [&](std::uint32_t i) {
        if (parts_[i].inside != 0) block.part.push_back(i);
      });
    }
    block.set = each_by_itself(block.part.size());
    for (std::uint32_t i = 0; i < block.part.size(); ++i) {
      for (std::uint32_t j = 0; j < i; ++j) {
        const Part &a = parts_[block.part[i]], &b = parts_[block.part[j]];
        if (a.cell != b.cell && between(a, b).is_small() && touch(a, b)) join(block.set, i, j);
      }
    }
    for (std::uint32_t i = 0; i < block.set.size(); ++i) block.set[i] = root_of(block.set, i);
    return block;
  }

  static std::uint32_t set_of(const Block& block, std::uint32_t part) {
    const auto found = std::find(block.part.begin(), block.part.end(), part);
    if (found == block.part.end()) return kNone;
    return block.set[static_cast<std::size_t>(found - block.part.begin())];
  }

  // Of two parts in neighbouring cells. Where samples are few, what hangs together around does,
  // too; parts without samples go with their hosts, and as before where these are too far apart.
  bool linked(std::uint32_t i, std::uint32_t j) const {
    if (i > j) std::swap(i, j);
    const Part &a = parts_[i], &b = parts_[j];
    if (a.cell == b.cell) return i == j;
    const int samples = std::min(std::popcount(a.inside), std::popcount(b.inside));
    const bool touching = samples > 0 && touch(a, b);
    if (touching || samples >= kLeastNeighbour) return touching;
    const std::uint32_t k = a.inside != 0 ? i : a.host, l = b.inside != 0 ? j : b.host;
    if (k == kNone || l == kNone || k == l) return true;
    const Block block = block_around(a.inside == 0 || b.inside != 0 ? a.cell : b.cell);
    const std::uint32_t one = set_of(block, k), other = set_of(block, l);
    return one == other || other == kNone;  // only a host of the other cell may lie beyond
  }

  bool find_crowded() {
    bool any = false;
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      for (int n = 0; n < 27 && !parts_[i].crowded; ++n) {
        each_part(place_of(parts_[i].cell), step_of(n), [&](std::uint32_t j) {
          if (linked(i, j)) return;
          parts_[i].crowded = parts_[j].crowded = any = true;
        });
      }
    }
    return any;
  }

  // ---- nodes ------------------------------------------------------------------------------------

  struct AtNode {
    std::uint32_t part;
    std::uint32_t corner;  // of the part's cell: bits x, y, z
  };

  std::vector<AtNode> around_node(const Cell& node) const {
    std::vector<AtNode> around;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      const auto back = [&](std::uint32_t bit) { return (corner >> bit & 1U) != 0 ? -1 : 0; };
      each_part(node, {back(0), back(1), back(2)}, [&](std::uint32_t i) {
        around.push_back({i, corner});
      });
    }
    return around;
  }

  // Calls visit(node) once for each corner of the parts that `wanted` takes, in the order of z, y,
  // x.
  template <typename Wanted, typename Visit>
  void each_node(Wanted wanted, Visit visit) const {
    std::vector<std::uint64_t> nodes;
    for (const Part& part : parts_) {
      if (!wanted(part)) continue;
      const Cell at = place_of(part.cell);
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const std::uint64_t x = at.x + (corner & 1U), y = at.y + (corner >> 1U & 1U);
        nodes.push_back((std::uint64_t{at.z + (corner >> 2U)} << 40U) | (y << 20U) | x);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    constexpr std::uint64_t kBits = (1U << 20U) - 1;
    for (const std::uint64_t node : nodes) {
      visit(Cell{static_cast<std::uint32_t>(node & kBits),
                 static_cast<std::uint32_t>(node >> 20U & kBits),
                 static_cast<std::uint32_t>(node >> 40U)});
    }
  }

  void find_groups() {
    const auto is_crowded = [](const Part& part) { return part.crowded; };
    each_node(is_crowded, [&](const Cell& node) {
      const std::vector<AtNode> around = around_node(node);
      std::vector<std::uint32_t> parent = each_by_itself(around.size());
      for (std::uint32_t i = 0; i < around.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
          if (linked(around[i].part, around[j].part)) join(parent, i, j);
        }
      }
      for (std::uint32_t i = 0; i < around.size(); ++i) {
        parts_[around[i].part].group[around[i].corner] =
            static_cast<std::uint8_t>(root_of(parent, i));
      }
    });
  }

  // Parts of a cell that share all their particles are one voxel after all.
  void merge_parts() {
    std::vector<Part> parts;
    std::vector<std::uint32_t> first;
    for (std::size_t voxel = 0; voxel + 1 < first_.size(); ++voxel) {
      first.push_back(static_cast<std::uint32_t>(parts.size()));
      for (std::uint32_t i = first_[voxel]; i < first_[voxel + 1]; ++i) {
        const auto same =
            std::find_if(parts.begin() + first.back(), parts.end(),
                         [&](const Part& before) { return before.group == parts_[i].group; });
        if (same == parts.end()) {
          parts.push_back(parts_[i]);
        } else {
          same->inside |= parts_[i].inside;
          same->quarters |= parts_[i].quarters;
        }
      }
    }
    first.push_back(static_cast<std::uint32_t>(parts.size()));
    parts_ = std::move(parts);
    first_ = std::move(first);
  }

  // ---- sheets -----------------------------------------------------------------------------------

  // In one sheet, parts would share all their nodes.
  bool may_share_sheet(const Part& a, const Part& b) const {
    const Step step = between(a, b);
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

  // Each to the sheet where most of its neighbours are, of those where it may be.
  void choose_sheets() {
    for (Part& part : parts_) part.sheet = part.crowded ? kNone : 0;
    std::uint32_t sheets = 1;
    for (Part& part : parts_) {
      if (part.sheet != kNone) continue;
      std::vector<int> votes(sheets + 1, 0);
      votes[sheets] = -1;  // a new one only where it must be
      for (int n = 0; n < 27; ++n) {
        each_part(place_of(part.cell), step_of(n), [&](std::uint32_t j) {
          const Part& other = parts_[j];
          if (&other == &part || other.sheet == kNone || votes[other.sheet] == kRefused) return;
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
          "--split-gaps: {} sheets of {} x {} rows: expected {} sheets and {} rows at most: choose "
          "another voxel edge",
          sheets, rows, lattice_.grid.size[2], kMaxSheets, kMaxRows);
    }
    lattice_.sheets = sheets;
    lattice_.sheet_rows = sheets == 1 ? lattice_.grid.size[1] : static_cast<std::uint32_t>(rows);
  }

  // ---- the lattice ------------------------------------------------------------------------------

  std::uint16_t row_of(const Cell& at, std::uint32_t sheet) const {
    return static_cast<std::uint16_t>(at.y + sheet * lattice_.sheet_rows);
  }

  void number_voxels() {
    std::vector<std::uint32_t> order(parts_.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) {
      const Cell at = place_of(parts_[i].cell);
      return std::make_tuple(at.z, row_of(at, parts_[i].sheet), at.x);
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    if (order.size() > kMaxVoxels) {
      refuse<TooFine>("--split-gaps: {} voxels: expected at most {}: choose a larger voxel edge",
                      order.size(), kMaxVoxels);
    }
    std::vector<std::uint32_t> parts_in_cell;
    for (std::size_t voxel = 0; voxel + 1 < first_.size(); ++voxel) {
      for (std::uint32_t i = first_[voxel]; i < first_[voxel + 1]; ++i) {
        parts_in_cell.push_back(first_[voxel + 1] - first_[voxel]);
      }
    }
    lattice_.runs.clear();
    lattice_.fill.clear();
    lattice_.cell_of_voxel.clear();
    for (const std::uint32_t i : order) {
      const Part& part = parts_[i];
      const auto voxel = static_cast<std::uint32_t>(lattice_.cell_of_voxel.size());
      add_voxel(lattice_.runs, place_of(part.cell), row_of(place_of(part.cell), part.sheet));
      lattice_.fill.push_back(fill_of(part.inside));
      lattice_.cell_of_voxel.push_back(part.cell);
      lattice_.voxel_of_cell[part.cell] = voxel;
      if (parts_in_cell[i] == 1) continue;
      const Cell at = place_of(part.cell);
      lattice_.parts.push_back({static_cast<std::uint16_t>(at.x), row_of(at, part.sheet),
                                static_cast<std::uint16_t>(at.z), 0, part.quarters});
      lattice_.shared.push_back({part.cell, voxel, part.quarters, part.inside});
    }
    std::sort(lattice_.shared.begin(), lattice_.shared.end(),
              [](const SharedCell& a, const SharedCell& b) {
                return std::tie(a.cell, a.voxel) < std::tie(b.cell, b.voxel);
              });
  }

  static void add_voxel(std::vector<OrganRun>& runs, const Cell& at, std::uint16_t row) {
    const bool goes_on = !runs.empty() && runs.back().z == at.z && runs.back().y == row &&
                         std::uint32_t{runs.back().x} + runs.back().count == at.x;
    if (!goes_on) {
      runs.push_back({static_cast<std::uint16_t>(at.x), row, static_cast<std::uint16_t>(at.z), 0});
    }
    ++runs.back().count;
  }

  void tie_nodes() {
    const auto is_beside = [](const Part& part) { return part.sheet > 0; };
    each_node(is_beside, [&](const Cell& node) {
      std::vector<std::tuple<std::uint8_t, std::uint32_t>> seen;  // group, sheet
      for (const AtNode& each : around_node(node)) {
        seen.emplace_back(parts_[each.part].group[each.corner], parts_[each.part].sheet);
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

  const Claims& claims_;
  const SamplePlaces& places_;
  Lattice lattice_;
  std::array<Near, 27> near_{};
  std::vector<Part> parts_;
  std::vector<std::uint32_t> first_;  // part of each voxel of the lattice as it came
};

}  // namespace

Lattice split_parts(const Claims& claims, const SamplePlaces& places, Lattice lattice) {
  return Splitter(claims, places, std::move(lattice)).split();
}

}  // namespace stylet::bake
