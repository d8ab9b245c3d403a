// SPDX-License-Identifier: Apache-2.0
#include "lattice/shadow_sheets.h"

#include <algorithm>
#include <bit>

namespace stylet {
namespace {

std::uint32_t sheets_of(const Organ& organ) {
  return organ.size_y / organ.sheet_rows;
}

// The first node of a level that a shadow of a coarser one moves, along an axis, and the end.
struct Moved {
  std::uint32_t begin, end;
};
Moved moved_by(std::uint32_t at, std::uint32_t ratio) {
  return {at > 0 ? (at - 1) * ratio + 1 : 0, (at + 1) * ratio};
}

// Whether one of the nodes that a shadow moves is in sheet `from` and tied to sheet `to`.
bool are_tied(const Organ& organ, const LevelPlace& at, std::uint32_t level, std::uint32_t from,
              std::uint32_t to) {
  const std::uint32_t ratio = 1U << (level - at.level);
  const Moved x = moved_by(at.x, ratio), y = moved_by(at.y, ratio), z = moved_by(at.z, ratio);
  const auto before = [](const OrganTie& tie, std::uint64_t place) {
    return order_of(tie) < place;
  };
  for (std::uint32_t k = z.begin; k < z.end; ++k) {
    const LatticePlace first = place_in_lattice(organ, {level, from, x.begin, y.begin, k});
    const std::uint64_t end = order_of(x.end, first.y + (y.end - 1 - y.begin), first.z);
    const auto ties_end = organ.ties.end();
    auto tie = std::lower_bound(organ.ties.begin(), ties_end, order_of(first), before);
    for (; tie != ties_end && order_of(*tie) < end; ++tie) {
      const bool is_moved = tie->x >= x.begin && tie->x < x.end;
      if (is_moved && tie->to_y / organ.sheet_rows == to) return true;
    }
  }
  return false;
}

bool are_tied(const Organ& organ, const LevelPlace& at, std::uint32_t a, std::uint32_t b) {
  for (std::uint32_t level = at.level + 1; level < organ.levels; ++level) {
    if (are_tied(organ, at, level, std::max(a, b), std::min(a, b))) return true;
  }
  return false;
}

}  // namespace

std::uint32_t shadow_sheet(const Organ& organ, const LevelPlace& at) {
  const std::uint32_t sheets = sheets_of(organ);
  if (organ.ties.empty()) return at.sheet;
  std::uint32_t joined = 1U << at.sheet, found = joined;      // as bits
  for (std::uint32_t i = 0; i < sheets && found != 0; ++i) {  // each is found once at most
    const auto one = static_cast<std::uint32_t>(std::countr_zero(found));
    found &= found - 1;
    for (std::uint32_t other = 0; other < sheets; ++other) {
      const std::uint32_t bit = 1U << other;
      if ((joined & bit) != 0 || !are_tied(organ, at, one, other)) continue;
      joined |= bit;
      found |= bit;
    }
  }
  return static_cast<std::uint32_t>(std::countr_zero(joined));
}

bool find_level_node(const Organ& organ, const LevelPlace& at, LatticePlace& node_out) {
  node_out = place_in_lattice(organ, at);
  if (sheets_of(organ) == 1) return has_node(organ, node_out.x, node_out.y, node_out.z);
  const LatticePlace finer =
      place_in_lattice(organ, {at.level + 1, at.sheet, 2 * at.x, 2 * at.y, 2 * at.z});
  const auto before = [](const OrganHanging& h, std::uint64_t place) {
    return order_of(h) < place;
  };
  const std::uint64_t place = order_of(finer);
  const auto h = std::lower_bound(organ.hanging.begin(), organ.hanging.end(), place, before);
  if (h == organ.hanging.end() || order_of(*h) != place) return false;
  const std::uint32_t sheet = place_in_level(organ, {h->voxel_x, h->voxel_y, h->voxel_z}).sheet;
  node_out = place_in_lattice(organ, {at.level, sheet, at.x, at.y, at.z});
  return true;
}

}  // namespace stylet
